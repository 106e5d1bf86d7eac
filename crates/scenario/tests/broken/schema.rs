//! What the schema forbids: keys, types, ranges, names.

use crate::{BEAMS, case, try_all};

#[test]
fn faults_against_the_schema_are_all_found() {
    try_all(
        BEAMS,
        &[
            case("missing section", &[("/train", "")], &[("$.train", "missing key")]),
            case(
                "empty scenario",
                &[("/train", ""), ("/track", ""), ("/bridge", ""), ("/time", "")],
                &[("$.train", "missing key"), ("$.bridge", "missing key")],
            ),
            case(
                "misspelt key",
                &[("/train/cars/0/body_mass", ""), ("/train/cars/0/body_mas", "40000")],
                &[("$.train.cars[0].body_mas", "unknown key"), ("$.train.cars[0].body_mass", "missing key")],
            ),
            case("unknown section", &[("/brige", "{}")], &[("$.brige", "unknown key")]),
            case(
                "negative mass, negative stiffness, too much damping",
                &[
                    ("/train/cars/0/body_mass", "-40000"),
                    ("/bridge/structure/spans/1/bending_stiffness", "-1"),
                    ("/bridge/damping/ratio", "2"),
                ],
                &[
                    ("$.train.cars[0].body_mass", "must be greater than 0"),
                    ("$.bridge.structure.spans[1].bending_stiffness", "must be greater than 0"),
                    ("$.bridge.damping.ratio", "must be at most 1"),
                ],
            ),
            case(
                "negative damping",
                &[("/train/cars/0/primary_damping", "-1")],
                &[("$.train.cars[0].primary_damping", "must be at least 0")],
            ),
            case("text for a number", &[("/time/step", "\"1 ms\"")], &[("$.time.step", "must be auto or a number")]),
            case("a list for a step", &[("/time/step", "[]")], &[("$.time.step", "must be a text or a number")]),
            case("no sub-steps", &[("/time/substeps", "0")], &[("$.time.substeps", "must be at least 1")]),
            case("number for a text", &[("/title", "3")], &[("$.title", "must be a text")]),
            case("list for an object", &[("/contact", "[]")], &[("$.contact", "must be an object")]),
            case("object for a list", &[("/bridge/points", "{}")], &[("$.bridge.points", "must be a list")]),
            case("null", &[("/bridge/at", "null")], &[("$.bridge.at", "must be a number")]),
            case(
                "number for a switch",
                &[("/output/supports", "1")],
                &[("$.output.supports", "must be true or false")],
            ),
            case(
                "a decimal comma between commas",
                &[("/output", r#"{ "csv": { "decimal": "comma" } }"#)],
                &[("$.output.csv.separator", "a decimal comma needs another separator: \"semicolon\" or \"tab\"")],
            ),
            case("fraction for a count", &[("/track/bays", "400.5")], &[("$.track.bays", "must be a whole number")]),
            case("negative count", &[("/track/bays", "-400")], &[("$.track.bays", "must be at least 2")]),
            case("scenario is a list", &[("/train", "[]")], &[("$.train", "must be an object")]),
            case("zero step", &[("/time/step", "0")], &[("$.time.step", "must be greater than 0")]),
            case("negative step", &[("/time/step", "-0.001")], &[("$.time.step", "must be greater than 0")]),
            case("no cars", &[("/train/cars", "[]")], &[("$.train.cars", "must have at least 1 entries")]),
            case(
                "unknown car",
                &[("/train/cars/1", "\"ice-trailer\"")],
                &[(
                    "$.train.cars[1]",
                    "must be one of ice3-motor, ice3-trailer, velaro-e, manchester, shinkansen-s300, emu-a, emu-b, ice3",
                )],
            ),
            case("number for a car", &[("/train/cars/1", "3")], &[("$.train.cars[1]", "must be a text or an object")]),
            case(
                "unknown track",
                &[("/track/type", "\"slap\"")],
                &[("$.track.type", "must be one of slab, ballast-zhai, ballast-two-layer")],
            ),
            case(
                "unknown spectrum",
                &[("/irregularity/spectrum", "\"FRA\"")],
                &[(
                    "$.irregularity.spectrum",
                    "must be one of german-low, german-high, sncf-good, sncf-poor, china-ballastless, fra-4, fra-5, fra-6",
                )],
            ),
            case(
                "unknown contact law",
                &[("/contact/law", "\"herz\"")],
                &[("$.contact.law", "must be one of hertz, linear")],
            ),
            case(
                "unknown format of matrices",
                &[
                    ("/bridge/structure", MATRICES),
                    ("/bridge/points", "[]"),
                    ("/bridge/structure/files/format", "\"label\""),
                ],
                &[(
                    "$.bridge.structure.files.format",
                    "must be one of matrix-market, triplets, labels, harwell-boeing, dmig",
                )],
            ),
            case(
                "a number for a format",
                &[("/bridge/structure", MATRICES), ("/bridge/points", "[]"), ("/bridge/structure/files/format", "1")],
                &[("$.bridge.structure.files.format", "must be a text")],
            ),
            case(
                "unknown kind of irregularity",
                &[("/irregularity/type", "\"spektrum\"")],
                &[("$.irregularity.type", "must be one of none, harmonics, spectrum, measured")],
            ),
            case("kind missing", &[("/bridge/structure/type", "")], &[("$.bridge.structure.type", "missing key")]),
            case("key of another kind", &[("/irregularity/waves", "[]")], &[("$.irregularity.waves", "unknown key")]),
            case(
                "two speeds",
                &[("/train/speed/m_s", "50")],
                &[("$.train.speed", "must have exactly one of the keys km_h, m_s, profile")],
            ),
            case(
                "misspelt unit of speed",
                &[("/train/speed", "{\"kmh\": 180}")],
                &[("$.train.speed", "must have exactly one of the keys km_h, m_s, profile")],
            ),
            case("bare number for a speed", &[("/train/speed", "180")], &[("$.train.speed", "must be an object")]),
            case(
                "three wavelengths",
                &[("/irregularity/wavelengths", "[1, 2, 3]")],
                &[("$.irregularity.wavelengths", "must have 2 entries")],
            ),
            case("negative seed", &[("/irregularity/seed", "-1")], &[("$.irregularity.seed", "must be at least 0")]),
            case(
                "blank in a point's name",
                &[("/bridge/points/0/name", "\"mid span\"")],
                &[("$.bridge.points[0].name", "must be a name of letters, digits, - and _")],
            ),
            case(
                "too many wheels",
                &[("/contact/wheels_per_axle", "3")],
                &[("$.contact.wheels_per_axle", "must be at most 2")],
            ),
            case(
                "no trials",
                &[("/coupling/max_iterations", "0")],
                &[("$.coupling.max_iterations", "must be at least 1")],
            ),
            case(
                "five faults in five sections",
                &[
                    ("/train/cars/0/wheelbase", "\"2.5 m\""),
                    ("/contact/tred", "\"worn\""),
                    ("/track/type/support/fastener/stiffness", "0"),
                    ("/irregularity/wavelengths", "[80, 3]"),
                    ("/bridge/points/1/x", "60"),
                ],
                &[
                    ("$.train.cars[0].wheelbase", "must be a number"),
                    ("$.contact.tred", "unknown key"),
                    ("$.track.type.support.fastener.stiffness", "must be greater than 0"),
                    (
                        "$.irregularity.wavelengths",
                        "wavelengths must be [shortest, longest] with 0 < shortest < longest",
                    ),
                    ("$.bridge.points[1].x", "a point must lie on the bridge"),
                ],
            ),
        ],
    );
}

const MATRICES: &str =
    r#"{"type": "matrices", "length": 50, "files": {"stiffness": "K", "mass": "M", "supports": "S.csv"}}"#;

/// All four are documented.
#[test]
fn every_format_of_matrices_is_accepted() {
    for format in ["matrix-market", "triplets", "labels", "harwell-boeing"] {
        let mut scenario: serde_json::Value = serde_json::from_str(BEAMS).unwrap();
        scenario["bridge"]["structure"] = serde_json::from_str(MATRICES).unwrap();
        scenario["bridge"]["structure"]["files"]["format"] = format.into();
        scenario["bridge"]["points"] = serde_json::json!([]);
        let found = ttb_scenario::from_str(&scenario.to_string(), &crate::folder(), format);
        assert!(found.is_ok(), "{}", found.unwrap_err());
    }
}
