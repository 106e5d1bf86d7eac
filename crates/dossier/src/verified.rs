//! A governing run that was computed once more: what `ttb report --verify` leaves in a folder.

use serde::{Deserialize, Serialize};

use crate::folder::Opened;

/// Name of the file with the lines.
pub const FILE: &str = "verified.json";

/// What was found.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Verified {
    /// The run.
    pub run_id: String,
    /// Changes of governing values.
    pub changes: Vec<Line>,
    /// Values of car bodies over the bridge and without it.
    pub comfort: Vec<Beside>,
}

/// A governing value computed otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// What was changed.
    pub what: String,
    /// Id of the criterion.
    pub criterion: String,
    /// Label of its filter.
    pub filter: String,
    /// The value of the run.
    pub before: f64,
    /// The value then.
    pub after: f64,
    /// Unit of both.
    pub unit: String,
}

/// A value with and without the bridge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Beside {
    /// Quantity.
    pub quantity: String,
    /// Car, and place in it.
    pub place: String,
    /// Label of the filter.
    pub filter: String,
    /// Name of the statistic.
    pub statistic: String,
    /// Unit.
    pub unit: String,
    /// Over the bridge.
    pub with: f64,
    /// Over a deck that does not move.
    pub without: f64,
}

/// The lines of a folder, if they belong to its present runs.
#[must_use]
pub fn read(opened: &Opened) -> Option<Verified> {
    let text = opened.files.text(FILE).ok()??;
    let verified: Verified = serde_json::from_str(&text).ok()?;
    opened.results.runs.iter().any(|run| run.run_id == verified.run_id).then_some(verified)
}
