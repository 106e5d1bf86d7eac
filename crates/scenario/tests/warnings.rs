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
    let found = warnings(&[("\"front_wheel\": 60", "\"front_wheel\": 50"), ("\"end\": 2.4", "\"end\": 2.9")]);
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
    assert_eq!(found, "the measured profile covers 0 to 50 m, the wheels -84.8 to 180.0 m: constant outside");
}

#[test]
fn a_train_that_does_not_cross_the_bridge() {
    for (changes, expected) in [
        (
            ("\"end\": 2.4", "\"end\": 2"),
            "$.time.end: the run ends before the train has passed: its last wheel comes to 115.2 m, the bridge ends at 130 m; it leaves the bridge at t = 2.296 s",
        ),
        (
            ("\"end\": 2.4", "\"end\": 0.3"),
            "$.time.end: the train never reaches the bridge: its leading wheel comes to 75 m, the bridge begins at 80 m",
        ),
        (
            (
                "\"front_wheel\": 60,\n    \"speed\": { \"km_h\": 180 }",
                "\"front_wheel\": 180,\n    \"speed\": { \"km_h\": 1 }",
            ),
            "$.train.front_wheel: the train is already past at the start: its last wheel is at 135.2 m, the bridge ends at 130 m",
        ),
        // One that stands on the bridge is meant to.
        (
            (
                "\"front_wheel\": 60,\n    \"speed\": { \"km_h\": 180 },\n    \"pre_roll\": 100",
                "\"front_wheel\": 120,\n    \"speed\": { \"km_h\": 0 }",
            ),
            "",
        ),
    ] {
        let found = warnings(&[changes]);
        assert!(found.contains(expected) && found.contains("$.") != expected.is_empty(), "{found}");
    }
}

#[test]
fn a_finding_is_a_value_with_its_place_and_the_same_slip_in_two_cars_is_told_once() {
    let text = BEAMS.replace("\"body_mass\": 40000", "\"body_mass\": 40");
    let begin = text.find("      {\n        \"name\": \"car\"").unwrap();
    let car = &text[begin..begin + text[begin..].find('}').unwrap() + 1];
    let text = text.replace("\"ice3-trailer\"", car);
    let checked = from_str(&text, Path::new(""), "f").unwrap_or_else(|problems| panic!("{problems}"));
    let of_mass: Vec<_> = checked.findings.iter().filter(|found| found.name == "mass of the body").collect();
    let [found] = of_mass[..] else { panic!("{of_mass:?}") };
    assert_eq!(
        (found.path.as_str(), found.value, found.unit.as_str()),
        ("$.train.cars[0].body_mass", Some(40.0), "kg")
    );
    assert_eq!((found.usual, found.slip.as_deref()), ([Some(3e3), Some(1.5e5)], Some("given in t?")));
    assert!(checked.warnings.contains(&found.text) && !found.source.is_empty());
}
