//! The scenario as a whole, and what it leaves.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bridge::Bridge;
use super::coupling::CouplingSettings;
use super::irregularity::Irregularity;
use super::time::Time;
use super::track::Track;
use super::train::{Contact, Train};

/// What goes into results.csv.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct Output {
    /// Every how many steps a row is written.
    #[schemars(range(min = 1))]
    pub every: usize,
    /// Also the force, displacement and velocity of every support.
    pub supports: bool,
}

impl Default for Output {
    fn default() -> Self {
        Self { every: 1, supports: false }
    }
}

/// A complete run: train, track, bridge, irregularity, time, coupling, output. SI units; z positive down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Scenario {
    /// JSON Schema of this file, for editors; ignored.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// One line for people.
    #[serde(default)]
    pub title: String,
    /// The train.
    pub train: Train,
    /// Wheel–rail contact.
    #[serde(default)]
    pub contact: Contact,
    /// The track.
    pub track: Track,
    /// Track irregularity.
    #[serde(default)]
    pub irregularity: Irregularity,
    /// The bridge.
    pub bridge: Bridge,
    /// Time axis.
    pub time: Time,
    /// The iteration.
    #[serde(default)]
    pub coupling: CouplingSettings,
    /// What the results hold.
    #[serde(default)]
    pub output: Output,
}
