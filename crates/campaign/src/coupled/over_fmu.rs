//! Any train over FMUs in the place of the scenario's bridge: a run has the bits of `ttb run --bridge` of the same scenario.
//!
//! FMUs are loaded and stepped by a [`Master`], which this crate does not know; what their histories are reduced to follows here.
//! No points are added along the deck: what an FMU does not show is not judged, and said to be missing.

use std::sync::atomic::AtomicBool;

use ttb_assessment::{Histories, reduce};
use ttb_scenario::Checked;

use super::{Task, rows};
use crate::clock::Since;
use crate::compute::{Compute, Computed};
use crate::history::History;
use crate::kept;
use crate::plan::Run;
use crate::record::Record;

/// Takes the steps of runs over FMUs.
pub trait Master: Sync {
    /// A whole run of a scenario; `None` if it was asked to stop.
    ///
    /// # Errors
    /// Why it failed, a sentence: also of an FMU that crashes or does not answer.
    fn run(&self, checked: Checked, stop: &AtomicBool) -> Result<Option<Stepped>, String>;
}

/// What a run over FMUs leaves.
pub struct Stepped {
    /// What criteria judge.
    pub histories: Histories,
    /// What is kept whole of a governing run.
    pub history: History,
    /// Step, s.
    pub step: f64,
    /// What was noticed, a sentence each.
    pub remarks: Vec<String>,
}

/// Runs of a plan over its FMUs.
pub struct OverFmu<'a> {
    /// The plan, its scenario, and what runs are reduced with.
    pub task: Task<'a>,
    /// Takes the steps; without one every run fails with a message.
    pub master: Option<&'a dyn Master>,
}

impl Compute for OverFmu<'_> {
    fn compute(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed> {
        runs.iter().map(|run| kept::ended(run, self.task.keep, || self.run(run, stop))).collect()
    }
}

impl OverFmu<'_> {
    /// A run with the history that is kept of it; `None` if it was asked to stop.
    ///
    /// # Errors
    /// Why it failed, a sentence.
    pub fn run(&self, run: &Run, stop: &AtomicBool) -> Result<Option<(Record, History)>, String> {
        let begin = Since::now();
        let Task { plan, source, criteria, facts, judged, .. } = self.task;
        let master = self.master.ok_or("the bridge is an FMU, and the program ttb alone runs FMUs")?;
        let checked = source.of_run(plan, run).map_err(|problems| problems.to_string())?;
        let Some(stepped) = master.run(checked, stop)? else { return Ok(None) };
        let reduced = reduce(&stepped.histories, criteria, facts);
        let record = Record {
            step: Some(stepped.step),
            peaks: rows::worst(reduced.peaks),
            envelopes: rows::envelopes(&stepped.histories, &judged),
            missing: reduced.missing,
            remarks: stepped.remarks,
            seconds: begin.seconds(),
            ..Record::of(&run.id)
        };
        Ok(Some((record, stepped.history)))
    }
}
