//! Extremes as the summary tells them.

use std::collections::HashMap;

use schemars::JsonSchema;
use serde::Serialize;
use ttb_contract::finite::larger;
use ttb_session::observe::{Extreme, Peaks};

use super::choice::Choice;

/// Both extremes of a variable.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Peak {
    /// FMI name; in summary.json it is the key.
    #[serde(skip)]
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Least value.
    pub min: Extreme,
    /// Greatest value.
    pub max: Extreme,
    /// How far both may be off for the steps' sake, in the variable's unit; an estimate and no
    /// bound, known where the steps were chosen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub estimated_error: Option<f64>,
    /// When the variable was NaN or infinite for the first time, s; the extremes are then those of its finite values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub not_finite_from: Option<f64>,
}

/// All extremes in column order; every peak's error follows from that of its kind, relative to the largest of the kind.
pub fn told(peaks: &Peaks, choice: Option<&Choice>) -> Vec<Peak> {
    let mut of_kind: HashMap<String, f64> = HashMap::new();
    for peak in peaks.all() {
        let most = of_kind.entry(peak.column.series()).or_default();
        *most = larger(*most, peak.amount());
    }
    let error = |series: &str| Some(choice?.error(series)? * of_kind[series]);
    let tell = |peak: &ttb_session::observe::Peak| Peak {
        name: peak.column.to_string(),
        unit: peak.column.unit.clone(),
        min: peak.min,
        max: peak.max,
        estimated_error: error(&peak.column.series()),
        not_finite_from: peak.not_finite_from,
    };
    peaks.all().iter().map(tell).collect()
}
