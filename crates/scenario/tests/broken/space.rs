//! Broken finite-element models, inside the scenario and in files of their own.

use std::path::{Path, PathBuf};

use serde_json::Value;
use ttb_scenario::{from_str, model};

use crate::{SPACE, case, folder, try_all};

const UNKNOWN: &str = "unknown node";
const HELD: &str = "every part of the model must be held by bearings or springs to the ground";
const TIED: &str = "what follows another motion must not be held by a bearing: hold what it follows";
const CYCLE: &str = "a motion must not follow itself over other ties";
const ONCE: &str = "a motion is eliminated once";

#[test]
fn faults_in_names_and_numbers_are_all_found() {
    try_all(
        SPACE,
        &[
            case(
                "nodes given twice and nowhere",
                &[
                    ("%/nodes/1/0", "1"),
                    ("%/masses/0/nodes/0", "32"),
                    ("%/bearings/0/nodes/0", "210"),
                    ("/bridge/points/1/node", "\"3l\""),
                ],
                &[
                    ("%.nodes[1][0]", "node numbers must differ"),
                    ("%.shells[0].elements[0][1]", UNKNOWN),
                    ("%.shells[0].elements[1][0]", UNKNOWN),
                    ("%.shells[0].elements[2][0]", UNKNOWN),
                    ("%.rigid_links[0].followers[0]", UNKNOWN),
                    ("%.masses[0].nodes[0]", UNKNOWN),
                    ("%.bearings[0].nodes[0]", UNKNOWN),
                    ("$.bridge.points[1].node", UNKNOWN),
                ],
            ),
            case(
                "names given twice, not at all, and unknown",
                &[
                    ("%/materials/1/name", "\"concrete\""),
                    ("%/line_sections/0/name", "\"\""),
                    ("%/shell_sections/0/material", "\"concret\""),
                    ("%/deck/on/shells/0", "\"dek\""),
                ],
                &[
                    ("%.materials[1].name", "names of materials must differ"),
                    ("%.line_sections[1].material", "unknown material"),
                    ("%.line_sections[0].name", "a name must not be empty"),
                    ("%.shell_sections[0].material", "unknown material"),
                    ("%.beams[0].section", "unknown section"),
                    ("%.beams[1].section", "unknown section"),
                    ("%.deck.on.shells[0]", "no shells have this section"),
                ],
            ),
            case(
                "what does not fit the schema",
                &[
                    ("%/materials/0/poisson", "0.5"),
                    ("%/nodes/0", "[1, 0, 0]"),
                    ("%/nodes/2/0", "4294967296"),
                    ("%/beams/0/offset", "[]"),
                    ("%/constraints/0/terms/1/1", "\"w\""),
                    ("%/deck/on", "{\"shell\": [\"deck\"]}"),
                ],
                &[
                    ("%.materials[0].poisson", "must be at most 0.499"),
                    ("%.nodes[0]", "must have 4 entries"),
                    ("%.nodes[2][0]", "must be at most 4294967295"),
                    ("%.beams[0].offset", "unknown key"),
                    ("%.constraints[0].terms[1][1]", "must be one of x, y, z, rx, ry, rz"),
                    ("%.deck.on", "must have exactly one of the keys shells, beams, nodes"),
                ],
            ),
        ],
    );
}

#[test]
fn faults_in_elements_are_all_found() {
    try_all(
        SPACE,
        &[
            case(
                "beams that cannot be",
                &[
                    ("%/beams/0/section", "\"rope\""),
                    ("%/beams/0/orientation", "[0, 0, 0]"),
                    ("%/beams/1/orientation", "[0, 0, 2]"),
                    ("%/beams/0/elements/1/1", "22"),
                    ("%/beams/1/releases/1", "[\"z\", \"rz\", \"rz\"]"),
                ],
                &[
                    ("%.beams[0].section", "a beam's section needs inertia_2"),
                    ("%.beams[0].section", "a beam's section needs inertia_3"),
                    ("%.beams[0].section", "a beam's section needs torsion"),
                    ("%.beams[0].orientation", "the orientation must not be zero"),
                    ("%.beams[0].elements[1]", "the nodes of an element must differ"),
                    ("%.beams[1].elements[0]", "the orientation must not run along the beam"),
                    ("%.beams[1].releases[1][0]", "only the rotations rx, ry, rz can be released"),
                    ("%.beams[1].releases[1][2]", "a freedom is named once"),
                ],
            ),
            case(
                "a beam that turns about itself",
                &[("%/beams/0/releases", "[[\"rx\"], [\"rx\", \"rz\"]]")],
                &[(
                    "%.beams[0].releases",
                    "rx must not be released at both ends, or the beam turns about its own axis",
                )],
            ),
            case(
                "trusses that cannot be",
                &[("%/trusses/0/tensions", "[0]"), ("%/nodes/-", "[50, 6, 0, -8]"), ("%/trusses/1/elements/0/0", "50")],
                &[
                    ("%.trusses[0].tensions", "every cable needs its tension"),
                    ("%.trusses[0].tensions[0]", "a tension must be greater than 0"),
                    ("%.trusses[1].elements[0]", "an element must connect two different places"),
                ],
            ),
            case(
                "shells that cannot be",
                &[
                    ("%/shells/0/elements/0", "[1, 2]"),
                    ("%/shells/0/elements/1", "[2, 3, 3]"),
                    ("%/shells/0/elements/2", "[1, 2, 3]"),
                ],
                &[
                    ("%.shells[0].elements[0]", "a shell has 3 or 4 nodes"),
                    ("%.shells[0].elements[1]", "the nodes of an element must differ"),
                    ("%.shells[0].elements[2]", "the nodes of a shell must span an area"),
                ],
            ),
            case(
                "springs and masses that cannot be",
                &[
                    ("%/springs/-", "{\"elements\": [[1, 2, 3], [31, 31]]}"),
                    ("%/springs/0/damping/2", "-1"),
                    ("%/masses/0/inertia/1", "-1"),
                ],
                &[
                    ("%.springs[0]", "stiffness and damping must not be negative"),
                    ("%.springs[1]", "a spring needs a stiffness or a damping"),
                    ("%.springs[1].elements[0]", "a spring has 1 or 2 nodes"),
                    ("%.springs[1].elements[1]", "the nodes of an element must differ"),
                    ("%.masses[0].inertia[1]", "must be at least 0"),
                ],
            ),
            case("a part of its own", &[("%/nodes/-", "[50, 6, 0, -9]"), PART], &[("%.bearings", HELD)]),
            case(
                "a deck on nothing",
                &[("%/deck/on", "{\"beams\": []}")],
                &[("%.deck.on.beams", "the deck needs at least one section of beams")],
            ),
            case(
                "a point beyond the deck",
                &[("/bridge/points/0/x", "13")],
                &[("$.bridge.points[0].x", "a point must lie on the bridge")],
            ),
            case(
                "a point on the deck that moves along it",
                &[("/bridge/points/0/direction", "\"x\"")],
                &[("$.bridge.points[0].direction", "motion along the track is known at nodes only")],
            ),
        ],
    );
}
const PART: (&str, &str) = ("%/masses/0/nodes", "[50]");

#[test]
fn faults_in_links_and_constraints_are_all_found() {
    try_all(
        SPACE,
        &[
            case(
                "links that cannot be",
                &[("%/rigid_links/0/followers/1", "22"), ("%/rigid_links/1/freedoms", "[]")],
                &[
                    ("%.rigid_links[0].followers[1]", "a node cannot follow itself"),
                    ("%.rigid_links[1].freedoms", "a rigid link needs at least one freedom"),
                ],
            ),
            case(
                "eliminated twice, and held",
                &[
                    ("%/constraints/0/terms/0", "[41, \"z\", 1]"),
                    ("%/constraints/-", "{\"terms\": [[21, \"rx\", 1], [22, \"rx\", 1]]}"),
                ],
                &[("%.constraints[0]", ONCE), ("%.constraints[1]", TIED)],
            ),
            case(
                "led by its follower",
                &[("%/rigid_links/-", "{\"leader\": 12, \"followers\": [22], \"freedoms\": [\"rz\"]}")],
                // x and y of both followers turn with the leader; so does rz of one of them
                &[
                    ("%.rigid_links[0].followers[0]", CYCLE),
                    ("%.rigid_links[0].followers[1]", CYCLE),
                    ("%.rigid_links[2].followers[0]", CYCLE),
                ],
            ),
            case(
                "constraints that cannot be",
                &[("%/constraints/0/terms/0/2", "0"), ("%/constraints/0/terms/2/1", "\"z\"")],
                &[
                    ("%.constraints[0].terms[0][2]", "the first factor must not be 0: its motion is eliminated"),
                    ("%.constraints[0].terms[2]", "a motion stands once in a constraint"),
                ],
            ),
        ],
    );
}

/// The model of the scenario after replacing `old` by `new`, in a file of its own.
fn file(name: &str, old: &str, new: &str) -> PathBuf {
    let scenario: Value = serde_json::from_str(SPACE).unwrap();
    let text = scenario["bridge"]["structure"]["model"].to_string();
    assert!(text.contains(old), "{old}");
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, text.replacen(old, new, 1)).unwrap();
    path
}

/// The scenario with the model in the file of this name.
fn naming(file: &str) -> String {
    let mut scenario: Value = serde_json::from_str(SPACE).unwrap();
    scenario["bridge"]["structure"]["model"] = file.into();
    scenario.to_string()
}

#[test]
fn a_model_in_its_own_file_is_the_same_scenario() {
    let inside = from_str(SPACE, &folder(), "inside").unwrap();
    let path = file("whole.json", "{", "{\"$schema\": \"bridge.schema.json\",");
    let outside = from_str(&naming("whole.json"), path.parent().unwrap(), "outside").unwrap();
    assert_eq!((&outside.bridge, outside.hash), (&inside.bridge, inside.hash));
    let text = serde_json::to_string(&inside.bridge).unwrap();
    assert_eq!(serde_json::from_str::<ttb_scenario::spec::BridgeSpec>(&text).unwrap(), inside.bridge);
}

#[test]
fn problems_of_a_model_name_its_own_file() {
    let problems = |name: &str, old: &str, new: &str| {
        let path = file(name, old, new);
        let found = from_str(&naming(name), path.parent().unwrap(), "scenario.json").unwrap_err().to_string();
        assert_eq!(model::load(&path).unwrap_err().to_string(), found);
        found.replace(&format!("{}/", path.parent().unwrap().display()), "")
    };
    assert_eq!(
        problems("unknown.json", "[2,3,13]", "[2,3,113]"),
        "unknown.json: $.shells[0].elements[1][2]: unknown node: 113 (did you mean `13`?)"
    );
    assert_eq!(
        problems("key.json", "\"poisson\"", "\"poison\""),
        "key.json: $.materials[0].poison: unknown key: `poison` (did you mean `poisson`?)"
    );
    assert_eq!(
        problems("range.json", "\"thickness\":0.3", "\"thickness\":0"),
        "range.json: $.shell_sections[0].thickness: must be greater than 0: 0.0"
    );
    assert_eq!(
        problems("none.json", "\"thickness\":0.3", "\"thickness\":NaN"),
        "none.json: $.shell_sections[0].thickness: must be a finite number: NaN"
    );
    assert_eq!(
        problems("twice.json", "\"thickness\":0.3", "\"thickness\":0.3,\"thickness\":0.3"),
        "twice.json: $.shell_sections[0].thickness: duplicate key: `thickness`"
    );
    let lost = from_str(&naming("nowhere.json"), &folder(), "scenario.json").unwrap_err().0.remove(0);
    assert_eq!((&*lost.file, &*lost.path), ("scenario.json", "$.bridge.structure.model"));
    assert_eq!(lost.rule, "the model file cannot be read");
}

#[test]
fn of_many_problems_of_a_kind_the_first_are_told_and_the_rest_counted() {
    let many: Vec<String> = (1..=1254).map(|i| format!("[{i}999,31]")).collect();
    let path = file("many.json", "[31,3]", &many.join(","));
    let text = model::load(&path).unwrap_err().to_string();
    assert_eq!(text.matches(UNKNOWN).count(), 21);
    assert!(text.ends_with("many.json: unknown node: and 1,234 more"), "{text}");
}
