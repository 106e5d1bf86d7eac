//! What only the fields together tell: train, track, bridge, time, irregularity.

use crate::{BEAMS, case, try_all};

const AT_START: &str = "the whole train must stand on the rail at the start";
const X_OR_NODE: &str = "a point has either x or node";

#[test]
fn faults_between_fields_are_all_found() {
    try_all(
        BEAMS,
        &[
            case(
                "train longer than the track",
                &[("/track/bays", "40"), ("/bridge/at", "-1"), ("/time/end", "0.5")],
                &[
                    ("$.track.bays", "the train must not be longer than the track"),
                    ("$.bridge.at", "the bridge must lie within the track"),
                ],
            ),
            case("last wheel before the rail", &[("/train/front_wheel", "30")], &[("$.train.front_wheel", AT_START)]),
            case(
                "leading wheel behind the rail",
                &[("/train/front_wheel", "210")],
                &[("$.train.front_wheel", AT_START)],
            ),
            case(
                "train leaves the rail",
                &[("/time/end", "3")],
                &[("$.time.end", "the whole train must be on the rail until the end of the run")],
            ),
            case(
                "train leaves the rail, accelerating",
                &[("/train/speed", "{\"profile\": [[0, 50], [1, 50], [2, 200]]}")],
                &[("$.time.end", "the whole train must be on the rail until the end of the run")],
            ),
            case(
                "bridge beyond the track",
                &[("/bridge/at", "160")],
                &[("$.bridge.at", "the bridge must lie within the track")],
            ),
            case(
                "no support on the bridge",
                &[("/bridge/at", "80.1"), ("/bridge/structure/spans", SHORT), ("/bridge/points", "[]")],
                &[("$.bridge", "at least one support of the track must rest on the bridge")],
            ),
            case(
                "point off the bridge",
                &[("/bridge/points/0/x", "-0.1"), ("/bridge/points/1/x", "50.1")],
                &[
                    ("$.bridge.points[0].x", "a point must lie on the bridge"),
                    ("$.bridge.points[1].x", "a point must lie on the bridge"),
                ],
            ),
            case(
                "points with both, neither, and a node",
                &[
                    ("/bridge/points/0/node", "\"top\""),
                    ("/bridge/points/1/x", ""),
                    ("/bridge/points/-", "{\"name\": \"third\", \"node\": \"top\"}"),
                    ("/bridge/points/-", "{\"name\": \"mid\", \"x\": 3, \"direction\": \"x\"}"),
                ],
                &[
                    ("$.bridge.points[0]", X_OR_NODE),
                    ("$.bridge.points[1]", X_OR_NODE),
                    ("$.bridge.points[2].node", "only frames and models in space have named nodes: give x"),
                    ("$.bridge.points[3].name", "names of points must differ"),
                    ("$.bridge.points[3].direction", "motion along the track is known at nodes only"),
                ],
            ),
            case(
                "speed profile out of order",
                &[("/train/speed", "{\"profile\": [[0, 50], [1, -1], [1, 50]]}")],
                &[
                    ("$.train.speed.profile[1][1]", "speeds must lie between 0 and 300 m/s"),
                    ("$.train.speed.profile[2][0]", "times must increase"),
                ],
            ),
            case(
                "step longer than the run",
                &[("/time/step", "3")],
                &[("$.time.step", "the step must not be longer than the run")],
            ),
            case(
                "too many steps",
                &[("/time/step", "1e-9"), ("/time/end", "1e4"), ("/train/speed", "{\"m_s\": 0.001}")],
                &[
                    ("$.time.step", "the run must have at most 1e12 steps"),
                    ("$.train.pre_roll", "a pre-roll must have at most 1e7 steps"),
                ],
            ),
            case(
                "steps that no double resolves",
                &[("/time/step", "1e-8"), ("/time/substeps", "1000")],
                &[
                    ("$.time.step", "steps and sub-steps must lie between 1e-9 and 1000 s"),
                    ("$.train.pre_roll", "a pre-roll must have at most 1e7 steps"),
                ],
            ),
            case(
                "too many steps of a size that is chosen",
                &[
                    ("/time/step", "\"auto\""),
                    ("/time/end", "1e11"),
                    ("/train/speed", "{\"m_s\": 0}"),
                    ("/train/pre_roll", "0"),
                ],
                &[("$.time.end", "the run must have at most 1e12 steps")],
            ),
            case(
                "a pre-roll at a crawl",
                &[("/train/speed", "{\"m_s\": 1e-6}")],
                &[("$.train.pre_roll", "a pre-roll must have at most 1e7 steps")],
            ),
            case(
                "sub-steps with damping, with rates, and an error for a step that is given",
                &[
                    ("/time/substeps", "10"),
                    ("/time/newmark", "{\"gamma\": 0.6, \"beta\": 0.3025}"),
                    ("/coupling", "{\"send\": \"rate\"}"),
                    ("/time/error", "0.01"),
                ],
                &[
                    ("$.time.newmark", "sub-steps need γ = 0.5, β = 0.25: the force on the bridge is a mean"),
                    ("$.coupling.send", "with sub-steps the force on the bridge is a mean and sent as such"),
                    ("$.time.error", "belongs to a step that is chosen: \"step\": \"auto\""),
                ],
            ),
            case(
                "a chosen step has sub-steps",
                &[("/time/step", "\"auto\""), ("/time/newmark", "{\"gamma\": 0.6, \"beta\": 0.3025}")],
                &[("$.time.newmark", "sub-steps need γ = 0.5, β = 0.25: the force on the bridge is a mean")],
            ),
            case(
                "points beside the rail, twice the same name",
                &[("/track/points", "[{\"name\": \"a\", \"x\": -9}, {\"name\": \"a\", \"x\": 10}]")],
                &[
                    ("$.track.points[0].x", "a point must lie on the rail"),
                    ("$.track.points[1].name", "names of points must differ"),
                ],
            ),
            case(
                "unstable Newmark",
                &[("/time/newmark", "{\"gamma\": 0.6, \"beta\": 0.25}")],
                &[("$.time.newmark.beta", "β must be at least γ/2 = 0.3 (unconditional stability)")],
            ),
            case(
                "equal Rayleigh frequencies",
                &[("/bridge/damping/at/hz", "[3, 3]")],
                &[("$.bridge.damping.at.hz", "the two frequencies must be positive and different")],
            ),
            case(
                "Rayleigh frequency zero",
                &[("/bridge/damping/at/hz", "[0, 3]")],
                &[("$.bridge.damping.at.hz", "the two frequencies must be positive and different")],
            ),
            case(
                "equal Rayleigh modes",
                &[("/bridge/damping/at", "{\"modes\": [2, 2]}")],
                &[("$.bridge.damping.at.modes", "the two modes must be different and count from 1")],
            ),
            case(
                "more modes than the beams have",
                &[
                    ("/bridge/modes", "41"),
                    ("/bridge/damping", "{\"type\": \"modal\", \"ratio\": 0.02, \"modes\": 50}"),
                ],
                &[
                    ("$.bridge.modes", "the structure has only 40 modes"),
                    ("$.bridge.damping.modes", "the structure has only 40 modes"),
                ],
            ),
            case(
                "car shorter than its wheels, bogies crossing",
                &[("/train/cars/0/length", "19"), ("/train/cars/0/wheelbase", "18")],
                &[
                    ("$.train.cars[0].length", "the car must be at least as long as from its first to its last wheel"),
                    ("$.train.cars[0].wheelbase", "the wheelbase must be shorter than bogie_distance"),
                ],
            ),
            case(
                "rotary inertia without shear",
                &[("/track/type/rail/rotary_inertia", "0.5")],
                &[("$.track.type.rail.rotary_inertia", "rotary inertia needs a shear_stiffness (Timoshenko rail)")],
            ),
            case(
                "pre-roll of a standing train",
                &[("/train/speed", "{\"m_s\": 0}")],
                &[("$.train.pre_roll", "a pre-roll needs a speed above 0 at the start")],
            ),
            case(
                "waves too short for any table",
                &[("/irregularity/wavelengths", "[1e-6, 80]")],
                &[(
                    "$.irregularity.wavelengths",
                    "the shortest wavelength must be at least 0.008 m on a passage of this length",
                )],
            ),
            case(
                "measured profile missing",
                &[("/irregularity", "{\"type\": \"measured\", \"file\": \"nowhere.csv\"}")],
                &[("$.irregularity.file", "the file cannot be read")],
            ),
            case(
                "measured profile without columns",
                &[("/irregularity", "{\"type\": \"measured\", \"file\": \"columns.csv\"}")],
                &[("$.irregularity.file", "the measured profile must have columns x and r")],
            ),
            case(
                "measured profile full of faults",
                &[("/irregularity", "{\"type\": \"measured\", \"file\": \"faults.csv\"}")],
                &[
                    ("$.irregularity.file", "x must be a finite number"),
                    ("$.irregularity.file", "r must be a finite number"),
                    ("$.irregularity.file", "x must increase"),
                ],
            ),
        ],
    );
}

/// A culvert between two supports.
const SHORT: &str = "[{\"length\": 0.3, \"bending_stiffness\": 1e9, \"mass\": 9000, \"elements\": 2}]";
