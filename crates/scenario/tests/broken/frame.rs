//! Broken plane frames.

use crate::{FRAME, case, try_all};

const LISTED: &str = "the deck's members must be listed along the track, each beginning where the one before ended";
const HOLD: &str = "bearings must hold the structure";
const PART: &str = "every part of the frame must be held by a bearing";

#[test]
fn faults_in_a_frame_are_all_found() {
    try_all(
        FRAME,
        &[
            case("unknown frame", &[("%", "\"cable-stayed\"")], &[("%", "must be one of cable-stayed-224")]),
            case(
                "unknown node and section",
                &[
                    ("%/members/3/nodes/1", "\"tip\""),
                    ("%/members/5/section", "\"ropes\""),
                    ("/bridge/points/1/node", "\"tops\""),
                ],
                &[
                    ("%.members[3].nodes[1]", "unknown node"),
                    ("%.members[5].section", "unknown section"),
                    ("$.bridge.points[1].node", "unknown node"),
                ],
            ),
            case(
                "names given twice and not at all",
                &[
                    ("%/nodes/-", "{ \"name\": \"top\", \"x\": 1, \"z\": 1 }"),
                    ("%/sections/-", "{ \"name\": \"rope\", \"modulus\": 1, \"area\": 1, \"mass\": 1 }"),
                    ("%/sections/-", "{ \"name\": \"\", \"modulus\": 1, \"area\": 1, \"mass\": 1 }"),
                ],
                &[
                    ("%.nodes[5].name", "names of nodes must differ"),
                    ("%.sections[2].name", "names of sections must differ"),
                    ("%.sections[3].name", "a name must not be empty"),
                ],
            ),
            case(
                "members that lack something or have too much",
                &[
                    ("%/members/3/section", "\"rope\""),
                    ("%/members/3/tension", "1e6"),
                    ("%/members/4/tension", ""),
                    ("%/members/5/elements", "3"),
                ],
                &[
                    ("%.members[3].section", "a beam's section needs an inertia"),
                    ("%.members[3].tension", "only cables have a tension"),
                    ("%.members[4].tension", "a cable needs a tension"),
                    ("%.members[5].elements", "only beams have several elements"),
                ],
            ),
            case(
                "a deck of rope without mass",
                &[("%/members/2/kind", "\"truss\""), ("%/members/2/elements", "1"), ("%/sections/0/mass", "0")],
                &[
                    ("%.members[2].kind", "a member of the deck must be a beam"),
                    ("%.members[0].section", "a section of the deck needs a mass"),
                    ("%.members[1].section", "a section of the deck needs a mass"),
                    ("%.members[2].section", "a section of the deck needs a mass"),
                ],
            ),
            case("deck not from 0", &[("%/nodes/0/x", "1")], &[("%.members[0].nodes", "the deck must begin at x = 0")]),
            case("deck with a gap", &[("%/members/1/deck", "false")], &[("%.members[2].nodes", LISTED)]),
            case(
                "deck going back",
                &[("%/nodes/1/x", "25")],
                &[("%.members[1].nodes", "x must increase along the deck")],
            ),
            case(
                "no deck",
                &[("%/members/0/deck", ""), ("%/members/1/deck", ""), ("%/members/2/deck", "")],
                &[("%.members", "some members must be the deck")],
            ),
            case(
                "a node apart, and a part apart",
                &[
                    ("%/nodes/-", "{ \"name\": \"lost\", \"x\": 1, \"z\": 1 }"),
                    ("%/nodes/-", "{ \"name\": \"this\", \"x\": 2, \"z\": 1 }"),
                    ("%/nodes/-", "{ \"name\": \"that\", \"x\": 3, \"z\": 1 }"),
                    ("%/members/-", "{ \"nodes\": [\"this\", \"that\"], \"section\": \"girder\" }"),
                ],
                &[("%.nodes[5]", "a node must belong to a member"), ("%.members", PART)],
            ),
            case("sliding away", &[("%/nodes/0/fixed", "[\"z\"]")], &[("%.nodes", HOLD)]),
            case(
                "turning about its only bearing",
                &[("%/nodes/2/fixed", ""), ("%/nodes/3/fixed", "[]")],
                &[("%.nodes", HOLD)],
            ),
            case(
                "held by nothing",
                &[("%/nodes/0/fixed", ""), ("%/nodes/2/fixed", ""), ("%/nodes/3/fixed", "")],
                &[("%.nodes", HOLD), ("%.members", PART)],
            ),
            case(
                "a node between two hinges",
                &[("%/members/0/hinged", "[false, true]"), ("%/members/1/hinged", "[true, false]")],
                &[(
                    "%.nodes[1]",
                    "one beam at a node must not be hinged there, or the node spins: leave one hinge out",
                )],
            ),
            case(
                "member from a node to itself",
                &[("%/members/5/nodes/1", "\"top\"")],
                &[("%.members[5].nodes", "a member must connect two different places")],
            ),
            case(
                "direction fixed twice",
                &[("%/nodes/2/fixed", "[\"z\", \"z\"]")],
                &[("%.nodes[2].fixed", "a direction is fixed once")],
            ),
            case(
                "unknown direction",
                &[("%/nodes/2/fixed", "[\"y\"]")],
                &[("%.nodes[2].fixed[0]", "must be one of x, z, rotation")],
            ),
            case(
                "point beyond the deck",
                &[("/bridge/points/0/x", "36.5")],
                &[("$.bridge.points[0].x", "a point must lie on the bridge")],
            ),
            case(
                "bridge beyond the track",
                &[("/bridge/at", "100")],
                &[("$.bridge.at", "the bridge must lie within the track")],
            ),
        ],
    );
}
