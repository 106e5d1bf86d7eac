//! What a row of results belongs to: which train ran how fast over which rail.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::amplification::phi_dyn;
use crate::filter::RAW;
use crate::load_case::Statics;
use crate::peak::quantity::{DECK_DISPLACEMENT, PHI_DYN};
use crate::peak::{Peak, Statistic};

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
    /// What static load models do to the bridge.
    pub statics: Statics,
}

impl Results {
    /// With φ′_dyn = max|y_dyn|/max|y_stat| − 1 of every run that has static values of its displacements, at the place of its
    /// greatest displacement.
    #[must_use]
    pub fn with_amplification(mut self) -> Self {
        let mut greatest: BTreeMap<usize, &Peak> = BTreeMap::new();
        for (run, peak) in &self.rows {
            let known = peak.static_value.is_some_and(|value| value != 0.0);
            if peak.quantity == DECK_DISPLACEMENT && peak.filter == RAW && known {
                let best = greatest.entry(*run).or_insert(peak);
                if peak.value.abs() > best.value.abs() {
                    *best = peak;
                }
            }
        }
        let has = |run: usize| self.rows.iter().any(|(of, peak)| *of == run && peak.quantity == PHI_DYN);
        let phi = |(run, peak): (usize, &Peak)| {
            let value = phi_dyn(peak.value, peak.static_value?)?;
            let row = Peak { unit: "1".into(), static_value: None, ..peak.clone() };
            Some((run, Peak { quantity: PHI_DYN.into(), statistic: Statistic::Max, value, ..row }))
        };
        let rows: Vec<(usize, Peak)> = if greatest.keys().any(|run| has(*run)) {
            Vec::new()
        } else {
            greatest.into_iter().filter_map(phi).collect()
        };
        self.rows.extend(rows);
        self
    }
}

/// A value that could not be made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Missing {
    /// Quantity.
    pub quantity: String,
    /// Label of the filter.
    pub filter: String,
    /// Name of the statistic; `None`: none can be made.
    #[serde(default)]
    pub statistic: Option<String>,
    /// Why, a sentence without its full stop.
    pub reason: String,
}
