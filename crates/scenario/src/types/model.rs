//! A finite-element model of a bridge in space: its own file, or inside a scenario.
//!
//! x along the track from the bridge's begin, y to the right, z down (right-handed); rotations follow the right-hand rule
//! about these axes. A node moves by [x, y, z, rx, ry, rz]. SI units.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A direction of a node's motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Freedom {
    /// Along the track.
    X,
    /// To the right.
    Y,
    /// Down.
    Z,
    /// Rotation about x.
    Rx,
    /// Rotation about y.
    Ry,
    /// Rotation about z.
    Rz,
}

impl Freedom {
    /// All six, in order.
    pub const ALL: [Self; 6] = [Self::X, Self::Y, Self::Z, Self::Rx, Self::Ry, Self::Rz];

    /// Its position among the six.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }

    /// As the file writes it.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["x", "y", "z", "rx", "ry", "rz"][self.index()]
    }

    /// In words, for messages.
    #[must_use]
    pub fn describe(self) -> &'static str {
        [
            "displacement along x",
            "displacement along y",
            "displacement along z",
            "rotation about x",
            "rotation about y",
            "rotation about z",
        ][self.index()]
    }
}

/// A linear elastic material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Name.
    pub name: String,
    /// E, N/m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub modulus: f64,
    /// ν.
    #[serde(default)]
    #[schemars(range(min = 0, max = 0.499))]
    pub poisson: f64,
    /// ρ, kg/m³.
    #[schemars(range(min = 0))]
    pub density: f64,
}

/// Cross-section of beams, trusses and cables. The local axis 1 runs along the element, 2 and 3 across it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LineSection {
    /// Name.
    pub name: String,
    /// Name of its material.
    pub material: String,
    /// A, m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub area: f64,
    /// Second moment of area about the local axis 2 (bending in the plane 1–3), m⁴; beams only.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub inertia_2: f64,
    /// Second moment of area about the local axis 3 (bending in the plane 1–2), m⁴; beams only.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub inertia_3: f64,
    /// Torsion constant, m⁴; beams only.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub torsion: f64,
    /// Shear area along axis 2, m²; absent: Euler–Bernoulli in the plane 1–2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_area_2: Option<f64>,
    /// Shear area along axis 3, m²; absent: Euler–Bernoulli in the plane 1–3.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_area_3: Option<f64>,
    /// Non-structural mass, kg/m.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub added_mass: f64,
}

/// Thickness and material of shells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShellSection {
    /// Name.
    pub name: String,
    /// Name of its material.
    pub material: String,
    /// t, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub thickness: f64,
    /// Non-structural mass, kg/m².
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub added_mass: f64,
}

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

/// Masses at nodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Masses {
    /// Node numbers.
    pub nodes: Vec<u32>,
    /// kg at each of them.
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

/// A finite-element model in space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Model {
    /// JSON Schema of this file, for editors; ignored.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Where the data come from.
    #[serde(default)]
    pub source: String,
    /// Materials.
    #[serde(default)]
    pub materials: Vec<Material>,
    /// Sections of beams, trusses and cables.
    #[serde(default)]
    pub line_sections: Vec<LineSection>,
    /// Sections of shells.
    #[serde(default)]
    pub shell_sections: Vec<ShellSection>,
    /// Nodes: (number, x, y, z), numbers unique, in any order.
    #[schemars(length(min = 1))]
    pub nodes: Vec<(u32, f64, f64, f64)>,
    /// Beams.
    #[serde(default)]
    pub beams: Vec<Beams>,
    /// Trusses and cables.
    #[serde(default)]
    pub trusses: Vec<Trusses>,
    /// Shells.
    #[serde(default)]
    pub shells: Vec<Shells>,
    /// Springs and dashpots.
    #[serde(default)]
    pub springs: Vec<Springs>,
    /// Masses.
    #[serde(default)]
    pub masses: Vec<Masses>,
    /// Rigid links.
    #[serde(default)]
    pub rigid_links: Vec<RigidLink>,
    /// Multi-point constraints.
    #[serde(default)]
    pub constraints: Vec<Constraint>,
    /// Bearings.
    #[serde(default)]
    pub bearings: Vec<Bearings>,
    /// The track's way over the model.
    pub deck: DeckLine,
}
