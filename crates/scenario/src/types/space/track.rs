//! Rails, fasteners and sleepers in space.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::data::rail_section_names;
use crate::types::Spring;

/// What the plane track does not say. Values are those of one rail at one support.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct TrackInSpace {
    /// The rail's section.
    pub rail: RailSectionChoice,
    /// Lateral spring and dashpot of a rail's fastener, N/m, N s/m; absent: from the track's type, see the guide.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lateral: Option<Spring>,
    /// Spring and dashpot of a fastener about the rail's axis, N m/rad, N m s/rad; absent: a pad of 0.15 m width, with as much
    /// again from the clips' share, see the guide.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rolling: Option<Spring>,
    /// The sleeper, where the track's type has one; absent: 2.5 m long.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sleeper: Option<Sleeper>,
    /// Distance of the rails' inner faces 14 mm below their top, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub gauge: f64,
    /// Half the distance of the rails' axes, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub half_distance: f64,
    /// Inclination of the rails towards each other: 1:40 is 0.025.
    #[schemars(range(min = 0.0, max = 0.2))]
    pub inclination: f64,
}

impl Default for TrackInSpace {
    fn default() -> Self {
        Self {
            rail: RailSectionChoice::Named("60e1".into()),
            lateral: None,
            rolling: None,
            sleeper: None,
            gauge: 1.435,
            half_distance: 0.75,
            inclination: 0.025,
        }
    }
}

/// A rail section by name, or its data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum RailSectionChoice {
    /// Name of a bundled section.
    Named(#[schemars(extend("enum" = rail_section_names().collect::<Vec<_>>()))] String),
    /// The data.
    Data(RailSection),
}

/// A rail's section: lateral bending, torsion and places; vertical bending and mass stand in `track.type.rail`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct RailSection {
    /// Lateral bending stiffness EI_z, N m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub lateral_bending_stiffness: f64,
    /// Torsional stiffness GJ (St. Venant), N m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub torsional_stiffness: f64,
    /// Polar mass inertia ρ(I_y + I_z), kg m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub polar_inertia: f64,
    /// Running surface above the axis through the centroid, m.
    #[schemars(range(min = 0.0, max = 0.5))]
    pub head_height: f64,
    /// Foot below the axis, m.
    #[schemars(range(min = 0.0, max = 0.5))]
    pub foot_height: f64,
    /// Where the data come from.
    #[serde(default)]
    pub source: String,
}

/// A sleeper as a rigid body; its mass stands in `track.type.support`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct Sleeper {
    /// Length, m: roll inertia m l²/12.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: f64,
    /// Half the distance of the two springs that stand for the vertical ballast, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub half_distance: f64,
    /// Lateral ballast of a sleeper, N/m, N s/m.
    pub lateral: Spring,
}

impl Default for Sleeper {
    fn default() -> Self {
        Self { length: 2.5, half_distance: 0.5, lateral: Spring { stiffness: 5e7, damping: 8e4 } }
    }
}
