//! What is allowed but rarely meant is said, and stops nothing.

use std::path::Path;

use ttb_scenario::from_str;

const BEAMS: &str = include_str!("broken/beams.json");

/// Warnings of the good scenario after the replacements.
fn warnings(changes: &[(&str, &str)]) -> String {
    let mut text = BEAMS.to_owned();
    for (old, new) in changes {
        assert!(text.contains(old), "{old}");
        text = text.replacen(old, new, 1);
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken");
    from_str(&text, &folder, "f").unwrap_or_else(|problems| panic!("{problems}")).warnings.join("\n")
}

#[test]
fn a_rail_that_ends_close_to_a_wheel() {
    let found = warnings(&[("\"front_wheel\": 60", "\"front_wheel\": 50"), ("\"end\": 2", "\"end\": 2.9")]);
    let expected = "the rail begins 5.2 m behind the last wheel at the start: its free end is felt within 12 m\n\
        the rail ends 5.0 m ahead of the leading wheel at the end of the run: its free end is felt within 12 m";
    assert_eq!(found, expected);
}

#[test]
fn a_long_step() {
    assert_eq!(
        warnings(&[("\"step\": 1e-3", "\"step\": 5e-3")]),
        "step 0.005 s: more than 0.002 s costs accuracy in accelerations"
    );
}

#[test]
fn waves_that_the_rail_cannot_follow() {
    let found = warnings(&[("[3, 80]", "[0.5, 80]")]);
    assert_eq!(found, "irregularity of wavelength 0.5 m: shorter than 4 rail elements of 0.25 m");
}

#[test]
fn a_measured_profile_that_covers_a_part_of_the_passage() {
    let old = r#""spectrum", "spectrum": "german-low", "seed": 1, "wavelengths": [3, 80]"#;
    let found = warnings(&[(old, r#""measured", "file": "short.csv""#)]);
    assert_eq!(found, "the measured profile covers 0 to 50 m, the wheels -84.8 to 160.0 m: constant outside");
}
