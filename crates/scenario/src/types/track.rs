//! Rail and its supports.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bridge::NAME_PATTERN;
use crate::data::track_names;

/// Both rails as one beam.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Rail {
    /// Bending stiffness EI of both rails, N m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bending_stiffness: f64,
    /// Mass of both rails, kg/m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: f64,
    /// Shear stiffness κGA of both rails, N; absent: Euler–Bernoulli, present: Timoshenko.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_stiffness: Option<f64>,
    /// Rotary inertia ρI of both rails, kg m; Timoshenko only.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub rotary_inertia: f64,
}

/// A spring with a dashpot beside it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Spring {
    /// Stiffness, N/m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub stiffness: f64,
    /// Damping, N s/m.
    #[schemars(range(min = 0))]
    pub damping: f64,
}

/// What stands between rail and deck or ground, per support, both rails together. The lowest spring carries the deck's
/// motion and gives the support force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "kebab-case")]
#[schemars(deny_unknown_fields)]
pub enum Support {
    /// Rail – fastener – deck: slab track.
    SingleLayer {
        /// The fastener.
        fastener: Spring,
    },
    /// Rail – pad – sleeper – ballast – deck.
    TwoLayer {
        /// Rail pad.
        pad: Spring,
        /// Mass of the sleeper, kg.
        #[schemars(extend("exclusiveMinimum" = 0))]
        sleeper_mass: f64,
        /// Ballast under the sleeper.
        ballast: Spring,
    },
    /// Rail – pad – sleeper – ballast – ballast mass (shear links to its neighbours) – sub-ballast – deck.
    ThreeLayer {
        /// Rail pad.
        pad: Spring,
        /// Mass of the sleeper, kg.
        #[schemars(extend("exclusiveMinimum" = 0))]
        sleeper_mass: f64,
        /// Ballast between sleeper and ballast mass.
        ballast: Spring,
        /// Mass of the ballast that moves with a sleeper, kg.
        #[schemars(extend("exclusiveMinimum" = 0))]
        ballast_mass: f64,
        /// Link between neighbouring ballast masses; absent: none.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        shear: Option<Spring>,
        /// Sub-ballast between ballast mass and deck.
        sub_ballast: Spring,
    },
}

/// A track's cross-section: rail, supports, spacing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct TrackType {
    /// The rails.
    pub rail: Rail,
    /// The supports.
    pub support: Support,
    /// Support spacing, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub spacing: f64,
    /// Where the data come from.
    #[serde(default)]
    pub source: String,
}

/// A bundled track type by name, or its data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum TrackChoice {
    /// Name of a bundled track type, such as `slab` or `ballast-zhai`.
    Bundled(#[schemars(extend("enum" = track_names().collect::<Vec<_>>()))] String),
    /// The data.
    Data(Box<TrackType>),
}

/// The track: where it lies. Supports stand at `from`, `from + spacing`, …, one more than there are bays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Track {
    /// Rail, supports, spacing; absent: `slab`.
    #[serde(rename = "type", default)]
    pub kind: TrackChoice,
    /// Abscissa of the first support, m; absent: 0 where `bays` and `front_wheel` are given, else so that the whole train
    /// stands on the rail at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<f64>,
    /// Number of support bays; absent: so that the rail bears the train until the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 2, max = 1000000))]
    pub bays: Option<usize>,
    /// Rail elements per bay.
    #[serde(default = "two")]
    #[schemars(range(min = 1, max = 20))]
    pub elements_per_bay: usize,
    /// Local flexibility of the rail under a load inside an element, c_loc(ξ): on by default.
    #[serde(default = "yes")]
    pub local_compliance: bool,
    /// Monitored points of the rail.
    #[serde(default)]
    pub points: Vec<RailPoint>,
}

/// A monitored point of the rail.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct RailPoint {
    /// Name, unique: it becomes the outputs `rail[NAME].displacement` and so on.
    #[schemars(regex(pattern = NAME_PATTERN))]
    pub name: String,
    /// Abscissa, m.
    pub x: f64,
}

impl Default for TrackChoice {
    fn default() -> Self {
        Self::Bundled("slab".into())
    }
}

impl Default for Track {
    fn default() -> Self {
        Self {
            kind: TrackChoice::default(),
            from: None,
            bays: None,
            elements_per_bay: two(),
            local_compliance: yes(),
            points: Vec::new(),
        }
    }
}

fn two() -> usize {
    2
}
fn yes() -> bool {
    true
}
