//! What a row of results belongs to: which train ran how fast over which rail.

use serde::{Deserialize, Serialize};

use crate::peak::Peak;

/// What loads the bridge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Loads {
    /// Moving forces.
    Forces,
    /// Vehicles with mass, springs and contact.
    Vehicles,
}

/// The rail.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rail {
    /// Without irregularity.
    Smooth,
    /// With irregularity.
    Rough,
}

/// What a result stands on. Results of different bases are never judged together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Basis {
    /// Forces or vehicles.
    pub loads: Loads,
    /// Smooth or rough.
    pub rail: Rail,
}

impl std::fmt::Display for Basis {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let loads = match self.loads {
            Loads::Forces => "forces",
            Loads::Vehicles => "vehicles",
        };
        let rail = match self.rail {
            Rail::Smooth => "smooth",
            Rail::Rough => "rough",
        };
        write!(f, "{loads}, {rail} rail")
    }
}

/// One run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Its id in every table.
    pub run_id: String,
    /// Name of the train.
    pub train: String,
    /// km/h; `None` where it is not known or not constant.
    pub speed_km_h: Option<f64>,
    /// Name of the variant of the scenario; empty for the scenario itself.
    pub variant: String,
    /// Seed of the irregularity, `smooth`, or empty for the scenario's own.
    pub seed: String,
    /// Forces or vehicles, smooth or rough.
    pub basis: Basis,
    /// Whether the refinement asked for it.
    pub refined: bool,
}

/// Runs and their reduced values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Results {
    /// All runs.
    pub runs: Vec<Run>,
    /// Index into `runs`, and the value.
    pub rows: Vec<(usize, Peak)>,
    /// Why a value that a criterion asks for could not be made.
    pub missing: Vec<Missing>,
}

/// A value that could not be made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Missing {
    /// Quantity.
    pub quantity: String,
    /// Label of the filter.
    pub filter: String,
    /// Why, a sentence without its full stop.
    pub reason: String,
}
