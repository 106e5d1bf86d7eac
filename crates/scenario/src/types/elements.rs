//! Elements of a finite-element model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::freedom::Freedom;

/// Beams of one section.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Beams {
    /// Name of their line section.
    pub section: String,
    /// A vector (x, y, z) that, with the element's own axis, spans the plane 1–2: axis 3 is axis 1 × this vector.
    pub orientation: [f64; 3],
    /// Pairs of node numbers.
    pub elements: Vec<[u32; 2]>,
    /// From the node to the element's end, (x, y, z) in m, for first and second ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub offsets: Option<[[f64; 3]; 2]>,
    /// Rotations about the local axes 1, 2, 3 (`rx`, `ry`, `rz`) that are free at first and second ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub releases: Option<[Vec<Freedom>; 2]>,
}

/// Trusses or cables of one section.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Trusses {
    /// Name of their line section.
    pub section: String,
    /// Pairs of node numbers.
    pub elements: Vec<[u32; 2]>,
    /// Cables: tension of each in N, in the elements' order, for Ernst's equivalent modulus; absent: trusses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tensions: Option<Vec<f64>>,
}

/// Flat shells of one section: quadrilaterals and triangles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Shells {
    /// Name of their shell section.
    pub section: String,
    /// Three or four node numbers each, in order around the element.
    pub elements: Vec<Vec<u32>>,
}

/// Springs and dashpots between two nodes, or from a node to the ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Springs {
    /// One or two node numbers each.
    pub elements: Vec<Vec<u32>>,
    /// Along x, y, z (N/m) and about them (N m/rad), global axes.
    #[serde(default)]
    pub stiffness: [f64; 6],
    /// Along x, y, z (N s/m) and about them (N m s/rad), global axes.
    #[serde(default)]
    pub damping: [f64; 6],
}
