//! A finite-element model of a bridge in space: its own file, or inside a scenario.
//!
//! x along the track from the bridge's begin, y to the right, z down (right-handed); rotations follow the right-hand rule
//! about these axes. A node moves by [x, y, z, rx, ry, rz]. SI units.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::elements::{Beams, Shells, Springs, Trusses};
use super::links::{Bearings, Constraint, DeckLine, Masses, RigidLink};
use super::sections::{LineSection, Material, ShellSection};

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
    /// Beams, by section.
    #[serde(default)]
    pub beams: Vec<Beams>,
    /// Trusses and cables.
    #[serde(default)]
    pub trusses: Vec<Trusses>,
    /// Shells, by section.
    #[serde(default)]
    pub shells: Vec<Shells>,
    /// Springs and dashpots.
    #[serde(default)]
    pub springs: Vec<Springs>,
    /// Masses at nodes.
    #[serde(default)]
    pub masses: Vec<Masses>,
    /// Rigid links.
    #[serde(default)]
    pub rigid_links: Vec<RigidLink>,
    /// Multi-point constraints.
    #[serde(default)]
    pub constraints: Vec<Constraint>,
    /// Nodes held by bearings.
    #[serde(default)]
    pub bearings: Vec<Bearings>,
    /// Where the track lies on the model.
    pub deck: DeckLine,
}
