//! A plane frame with trusses and cables.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::data::frame_names;

/// A material and cross-section of a frame member (both cable planes, both girders … summed into the plane).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Section {
    /// Name, by which members refer to it.
    pub name: String,
    /// Modulus of elasticity E, N/m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub modulus: f64,
    /// Cross-sectional area A, m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub area: f64,
    /// Second moment of area I, m⁴; not needed for trusses.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub inertia: f64,
    /// Shear stiffness κGA, N; absent: Euler–Bernoulli, present: Timoshenko.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_stiffness: Option<f64>,
    /// Mass per length, dead loads included, kg/m.
    #[schemars(range(min = 0))]
    pub mass: f64,
}

/// A named node.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Node {
    /// Name, by which members and points refer to it.
    pub name: String,
    /// Place along the track, from the bridge's begin, m.
    pub x: f64,
    /// Place downwards, from the deck's axis, m.
    pub z: f64,
    /// Fixed directions, a list of `x`, `z`, `rotation`; absent: free.
    #[serde(default)]
    pub fixed: Vec<Fixity>,
}

/// A direction held by a bearing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Fixity {
    /// Along the track.
    X,
    /// Vertical displacement.
    Z,
    /// Rotation in the plane.
    Rotation,
}

/// A straight member between two named nodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Member {
    /// Its two nodes.
    pub nodes: [String; 2],
    /// Name of its section.
    pub section: String,
    /// Beam, truss or cable.
    #[serde(default)]
    pub kind: MemberKind,
    /// Number of elements (beams only).
    #[serde(default = "one")]
    #[schemars(range(min = 1, max = 10000))]
    pub elements: usize,
    /// Cables: tension in N for Ernst's equivalent modulus; weight from the section's mass.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tension: Option<f64>,
    /// The member is part of the deck that carries the track.
    #[serde(default)]
    pub deck: bool,
    /// Hinges at its begin and end.
    #[serde(default)]
    pub hinged: [bool; 2],
}

/// Kind of a member.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MemberKind {
    /// Bending and axial force.
    #[default]
    Beam,
    /// Axial force only.
    Truss,
    /// Axial force only, Ernst's equivalent modulus from tension and horizontal length.
    Cable,
}

/// A plane frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Frame {
    /// Sections by name.
    #[schemars(length(min = 1))]
    pub sections: Vec<Section>,
    /// Nodes by name.
    #[schemars(length(min = 2))]
    pub nodes: Vec<Node>,
    /// Members between the nodes.
    #[schemars(length(min = 1))]
    pub members: Vec<Member>,
    /// Where the data come from.
    #[serde(default)]
    pub source: String,
}

/// A bundled frame by name, or its data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum FrameChoice {
    /// Name of a bundled frame, such as `cable-stayed-224`.
    Bundled(#[schemars(extend("enum" = frame_names().collect::<Vec<_>>()))] String),
    /// The frame.
    Data(Box<Frame>),
}

fn one() -> usize {
    1
}
