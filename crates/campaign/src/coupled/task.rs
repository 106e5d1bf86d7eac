//! What a run of a plan is made of and reduced with, whoever takes its steps.

use std::path::Path;

use ttb_assessment::{Criteria, Facts, Filter, Histories};

use super::{Source, rows};
use crate::plan::{Plan, Run};
use crate::record::Record;

/// What all runs share.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// Its scenario.
    pub source: &'a Source,
    /// Criteria whose values are made.
    pub criteria: &'a Criteria,
    /// What is known of bridge and track.
    pub facts: &'a Facts,
    /// The filter behind which acceleration is judged.
    pub judged: Filter,
    /// The campaign's folder, if the history of every run is kept there.
    pub keep: Option<&'a Path>,
}

impl Task<'_> {
    /// What the tables have of a run with these histories.
    pub fn record(&self, run: &Run, histories: &Histories) -> Record {
        Record {
            peaks: rows::peaks(histories, self.criteria, self.facts),
            envelopes: rows::envelopes(histories, &self.judged),
            ..Record::of(&run.id)
        }
    }
}
