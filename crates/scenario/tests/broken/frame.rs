//! Broken plane frames.

use crate::{FRAME, case, try_all};

const PATH: &str = "/bridge/structure/frame";
const LISTED: &str = "the deck's members must be listed along the track, each beginning where the one before ended";
const SPINS: &str = "one beam at a node must not be hinged there, or the node spins: leave one hinge out";

#[test]
fn faults_in_a_frame_are_all_found() {
    assert!(FRAME.contains("\"frame\": {"), "{PATH}");
    try_all(
        FRAME,
        &[
            case("unknown bundled frame", &[("/bridge/structure/frame", "\"cable-stayed\""), ("/bridge/points", "[]")], &[(
                "$.bridge.structure.frame",
                "must be one of cable-stayed-224",
            )]),
            case("unknown node and section", &[
                ("/bridge/structure/frame/members/3/nodes/1", "\"tip\""),
                ("/bridge/structure/frame/members/5/section", "\"ropes\""),
                ("/bridge/points/1/node", "\"tops\""),
            ], &[
                ("$.bridge.structure.frame.members[3].nodes[1]", "unknown node"),
                ("$.bridge.structure.frame.members[5].section", "unknown section"),
                ("$.bridge.points[1].node", "unknown node"),
                ("$.bridge.structure.frame.members", "every part of the frame must be held by a bearing"),
            ]),
        ],
    );
}
