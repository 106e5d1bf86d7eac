//! What a run leaves: reduced values, or why it failed.

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use ttb_assessment::{Missing, Peak, Statistic};

use crate::error::Error;

/// Format of the journal's files; another one is not read.
pub const FORMAT: u32 = 1;

/// One run's file in the journal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// [`FORMAT`].
    pub format: u32,
    /// Id of the run.
    pub run_id: String,
    /// Why it failed; `None`: it is done.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// Step, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step: Option<f64>,
    /// Number of modes; `None`: in all degrees of freedom.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub modes: Option<usize>,
    /// Seconds that a worker spent on it. Not a result: the tables leave it out.
    pub seconds: f64,
    /// Reduced values.
    #[serde(default)]
    pub peaks: Vec<Peak>,
    /// Extremes along the deck.
    #[serde(default)]
    pub envelopes: Vec<Envelope>,
    /// Over an FMU: which values could not be made, and why.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub missing: Vec<Missing>,
    /// Over an FMU: what was noticed, a sentence each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<String>,
}

/// Where records are kept.
pub trait Records {
    /// The record of a run; `None` if there is none.
    ///
    /// # Errors
    /// It is there and cannot be read.
    fn of(&self, id: &str) -> Result<Option<Record>, Error>;
}

/// In memory, by the ids of the runs.
impl Records for BTreeMap<String, Record> {
    fn of(&self, id: &str) -> Result<Option<Record>, Error> {
        Ok(self.get(id).cloned())
    }
}

/// Least and greatest value of a quantity at every point of the deck.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Envelope {
    /// What: one of [`ttb_assessment::peak::quantity`].
    pub quantity: Cow<'static, str>,
    /// Label of its filter, `raw` without.
    pub filter: Cow<'static, str>,
    /// Unit as FMI writes it.
    pub unit: Cow<'static, str>,
    /// Where, m from the bridge's begin.
    pub x: Vec<f64>,
    /// Least values there.
    pub min: Vec<f64>,
    /// Greatest values there.
    pub max: Vec<f64>,
}

impl Record {
    /// Of a run of which nothing is known yet.
    pub fn of(run_id: &str) -> Self {
        Self {
            format: FORMAT,
            run_id: run_id.into(),
            error: None,
            step: None,
            modes: None,
            seconds: 0.0,
            peaks: Vec::new(),
            envelopes: Vec::new(),
            missing: Vec::new(),
            remarks: Vec::new(),
        }
    }

    /// Of a run that failed.
    pub fn failed(run_id: &str, error: impl Into<String>, seconds: f64) -> Self {
        Self { error: Some(error.into()), seconds, ..Self::of(run_id) }
    }

    /// Itself, or a failed run if a value is not finite: such a value would pass through no comparison.
    #[must_use]
    pub fn finite(self) -> Self {
        let bad = self.peaks.iter().find(|peak| {
            ![Some(peak.value), peak.x, peak.time, peak.static_value].into_iter().flatten().all(f64::is_finite)
        });
        if let Some(peak) = bad {
            let error = format!("{} ({}, {}) is {}", peak.quantity, peak.filter, peak.statistic, peak.value);
            return Self::failed(&self.run_id, error, self.seconds);
        }
        let all = |envelope: &Envelope| envelope.min.iter().chain(&envelope.max).all(|x| x.is_finite());
        match self.envelopes.iter().find(|envelope| !all(envelope)) {
            Some(envelope) => {
                let error = format!("{} ({}) is not finite along the deck", envelope.quantity, envelope.filter);
                Self::failed(&self.run_id, error, self.seconds)
            }
            None => self,
        }
    }

    /// The greatest amount of a quantity behind a filter, over places and extremes; `None` if the run has none.
    pub fn amount(&self, quantity: &str, filter: &str) -> Option<f64> {
        let extreme = |peak: &&Peak| matches!(peak.statistic, Statistic::AbsMax | Statistic::Max | Statistic::Min);
        let is = |peak: &&Peak| peak.quantity == quantity && peak.filter == filter;
        self.peaks.iter().filter(is).filter(extreme).map(|peak| peak.value.abs()).reduce(f64::max)
    }
}
