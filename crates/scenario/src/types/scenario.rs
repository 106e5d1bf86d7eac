//! The scenario as a whole, and what it leaves.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bridge::Bridge;
use super::coupling::CouplingSettings;
use super::csv::Csv;
use super::fmus::Fmus;
use super::irregularity::Irregularity;
use super::space::Space;
use super::time::Time;
use super::track::Track;
use super::train::{Contact, Train};

/// What goes into results.csv, and how.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct Output {
    /// Every how many steps a row is written.
    #[schemars(range(min = 1))]
    pub every: usize,
    /// Also the force, displacement and velocity of every support.
    pub supports: bool,
    /// From when on peaks count: `bridge` (default), `start`, or a time in s.
    pub peaks_from: PeaksFrom,
    /// Only these columns of results.csv, by name; `*` stands for anything: `car[*].acceleration`. Peaks are kept of all.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub columns: Vec<String>,
    /// How numbers are written.
    pub csv: Csv,
}

/// From when on peaks count.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum PeaksFrom {
    /// As the word says.
    Word(PeaksWord),
    /// From this time to the end of the run, s.
    Seconds(f64),
}

/// A moment by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PeaksWord {
    /// From the first wheel on the bridge until the free vibration after the last one has ended.
    Bridge,
    /// The whole run.
    Start,
}

impl JsonSchema for PeaksFrom {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "PeaksFrom".into()
    }
    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "description": "From when on peaks count.", "anyOf": [
            { "type": "string", "const": "bridge",
              "description": "From the first wheel on the bridge until time.free_vibration after the last has left it." },
            { "type": "string", "const": "start", "description": "The whole run." },
            { "type": "number", "minimum": 0, "description": "From this time to the end of the run, s." },
        ] })
    }
}

impl Default for Output {
    fn default() -> Self {
        let peaks_from = PeaksFrom::Word(PeaksWord::Bridge);
        Self { every: 1, supports: false, peaks_from, columns: Vec::new(), csv: Csv::default() }
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
    /// The track; absent: a slab track as long as the run needs.
    #[serde(default)]
    pub track: Track,
    /// Track irregularity.
    #[serde(default)]
    pub irregularity: Irregularity,
    /// The bridge.
    pub bridge: Bridge,
    /// Time axis; absent: steps of 1 ms until the free vibration after the passage has ended.
    #[serde(default)]
    pub time: Time,
    /// The iteration.
    #[serde(default)]
    pub coupling: CouplingSettings,
    /// What the results hold.
    #[serde(default)]
    pub output: Output,
    /// The run in space: lateral motion, two rails, creep and flanges; absent: a plane run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub space: Option<Space>,
    /// Parameters of the FMUs.
    #[serde(default, skip_serializing_if = "Fmus::is_empty")]
    pub fmus: Fmus,
}
