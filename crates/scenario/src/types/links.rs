//! Masses, rigid links, constraints and bearings of a finite-element model, and the line of the track on it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::freedom::Freedom;

/// Masses at nodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Masses {
    /// Node numbers.
    pub nodes: Vec<u32>,
    /// Mass at each of them, kg.
    #[schemars(range(min = 0))]
    pub mass: f64,
    /// Rotary inertia about x, y, z, kg m², at each.
    #[serde(default)]
    pub inertia: [f64; 3],
}

/// Nodes that follow another as parts of one rigid body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RigidLink {
    /// Number of the node that leads.
    pub leader: u32,
    /// Numbers of the nodes that follow.
    pub followers: Vec<u32>,
    /// Which motions follow; absent: all six.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub freedoms: Option<Vec<Freedom>>,
}

/// Σ factor · motion = 0; the first term's motion is eliminated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Constraint {
    /// (node number, freedom, factor).
    #[schemars(length(min = 1))]
    pub terms: Vec<(u32, Freedom, f64)>,
}

/// Nodes held.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bearings {
    /// Node numbers.
    pub nodes: Vec<u32>,
    /// Which motions are held.
    #[schemars(length(min = 1))]
    pub fixed: Vec<Freedom>,
}

/// How the track's supports rest on the model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DeckLine {
    /// Length of the bridge along the track, m: supports with 0 < x < length rest on it.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: f64,
    /// y of the track's axis, m; not on the carrying elements' axis: the deck twists.
    #[serde(default)]
    pub y: f64,
    /// z of the reference point at the level of the rails' foot, m, for runs in space; absent: the top of carrying shells, the
    /// axis of beams, the height of nodes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub z: Option<f64>,
    /// What carries.
    pub on: DeckCarrier,
}

/// What carries the track.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DeckCarrier {
    /// The shells of these sections: interpolated in the element over which the support stands, seen from above.
    Shells(Vec<String>),
    /// The beams of these sections: interpolated along the element, rigidly offset across it.
    Beams(Vec<String>),
    /// These nodes: the nearest along x, of those the nearest along y, rigidly offset; `[]` stands for all nodes.
    Nodes(Vec<u32>),
}
