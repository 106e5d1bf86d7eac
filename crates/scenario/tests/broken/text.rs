//! What is wrong with the text itself: syntax, repeated keys, numbers that are none, files that are not there.

use std::path::Path;

use ttb_scenario::{from_str, load};

use crate::{BEAMS, folder};

/// All problems of the good scenario after replacing `old` by `new`, one a line.
fn found(old: &str, new: &str) -> String {
    assert!(BEAMS.contains(old), "{old}");
    from_str(&BEAMS.replacen(old, new, 1), &folder(), "broken.json").unwrap_err().to_string()
}

#[test]
fn numbers_that_are_none_are_reported_with_their_path_and_hide_nothing() {
    let rule = "must be a finite number";
    assert_eq!(found("60,", "NaN,"), format!("broken.json: $.train.front_wheel: {rule}: NaN"));
    assert_eq!(found("\"km_h\": 180", "\"km_h\": 1e999"), format!("broken.json: $.train.speed.km_h: {rule}: 1e999"));
    assert_eq!(
        found("[3, 80]", "[3, Infinity]"),
        format!("broken.json: $.irregularity.wavelengths[1]: {rule}: Infinity")
    );
    assert_eq!(
        found("\"step\": 1e-3, \"end\": 2.4", "\"step\": -Infinity, \"end\": -2"),
        format!("broken.json: $.time.step: {rule}: -Infinity\nbroken.json: $.time.end: must be greater than 0: -2")
    );
}

#[test]
fn repeated_keys_are_reported() {
    let expected = "broken.json: $.train.front_wheel: duplicate key: `front_wheel`";
    assert_eq!(found("\"front_wheel\": 60,", "\"front_wheel\": 60, \"front_wheel\": 70,"), expected);
}

#[test]
fn syntax_errors_tell_place_and_what_was_expected() {
    assert_eq!(
        found("{ \"name\": \"second\", \"x\": 40 }]", "]"),
        "broken.json: $.bridge.points[1]: not JSON: expected a value: found `]` in line 37, column 44"
    );
    assert_eq!(
        found("\"front_wheel\": 60,", "\"front_wheel\": 60"),
        "broken.json: $.train: not JSON: expected a comma or }: found `\"` in line 13, column 5"
    );
    assert_eq!(
        found("\"contact\"", "// a comment\n  \"contact\""),
        "broken.json: $: not JSON: expected a key in double quotes: found `/` in line 16, column 3"
    );
    let text = |text: &str| from_str(text, &folder(), "f").unwrap_err().to_string();
    assert_eq!(text(""), "f: $: not JSON: expected a value: found the end of the file in line 1, column 1");
    assert_eq!(text("{} {}"), "f: not JSON: expected the end of the file: found `{` in line 1, column 4");
    assert_eq!(
        text("{\"title\": \"open"),
        "f: $.title: not JSON: expected a text in double quotes: found `\"` in line 1, column 11"
    );
    assert_eq!(text("3"), "f: $: must be an object: 3");
    assert!(text(&"[".repeat(10_000)).contains("expected less nesting"));
}

#[test]
fn a_byte_order_mark_is_no_problem() {
    assert!(from_str(&format!("\u{feff}{BEAMS}"), &folder(), "f").is_ok());
}

#[test]
fn a_missing_file_is_a_problem_like_any_other() {
    let problems = load(Path::new("no/such/scenario.json")).unwrap_err();
    assert_eq!(problems.0.len(), 1);
    assert_eq!(problems.0[0].rule, "the scenario file cannot be read");
    assert!(problems.to_string().starts_with("no/such/scenario.json: the scenario file cannot be read: "));
}

#[test]
fn suggestions_name_what_may_have_been_meant() {
    assert!(found("\"body_mass\"", "\"body_mas\"").contains("unknown key: `body_mas` (did you mean `body_mass`?)"));
    assert!(found("ice3-trailer", "ice3-trailor").contains(": \"ice3-trailor\" (did you mean `ice3-trailer`?)"));
    assert!(found("\"km_h\"", "\"kmh\"").contains("`kmh` (did you mean `km_h`?)"));
    assert!(found("rayleigh", "Raleigh").contains("(did you mean `rayleigh`?)"));
    assert!(!found("ice3-trailer", "wagon 7").contains("did you mean"));
}
