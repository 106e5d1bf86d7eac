//! What computes the runs of a plan: one of the ways, by the plan and the train.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use ttb_assessment::filter::RAW;
use ttb_assessment::peak::quantity::{DECK_ACCELERATION, DECK_DISPLACEMENT};
use ttb_assessment::{Criteria, Facts, Filter};
use ttb_bridge::lanes::RUNS;
use ttb_scenario::spec::StructureSpec;
use ttb_trains::Signature;

use crate::compute::{Compute, Computed};
use crate::coupled::{Bridges, Loads, Master, OverFmu, Shared, Source, Task, Vehicles};
use crate::error::Error;
use crate::expand::Expanded;
use crate::governing::Governing;
use crate::history::History;
use crate::limits::Limits;
use crate::modal::{self, Modal, force_train};
use crate::one_axle::{self, OneAxle};
use crate::plan::{Load, Plan, Run, Way};
use crate::record::Record;
use crate::refine::Refined;

/// Range of wavelengths in which resonances are sought, m.
const WAVELENGTHS: [f64; 2] = [4.5, 40.0];
/// Damping ratio with which they are sought: it moves them little.
const DAMPING: f64 = 0.01;

/// A run once more: its history, and of axle loads its record. `None` if it was asked to stop; why it failed, a sentence.
pub type Again = Result<Option<(Option<Record>, History)>, String>;

/// The ways over one plan.
pub struct Runner<'a> {
    plan: &'a Plan,
    source: &'a Source,
    facts: &'a Facts,
    criteria: Criteria,
    judged: Filter,
    modal: Modal<'a>,
    one_axle: OneAxle<'a>,
    kept: Kept,
    abreast: usize,
    keep: Option<&'a Path>,
    master: Option<&'a dyn Master>,
}

/// Tracks and bridges that were prepared for a plan; a clone is the same.
#[derive(Clone, Default)]
pub struct Kept {
    modal: modal::Kept,
    one_axle: one_axle::Kept,
    shared: Arc<Shared>,
    bridges: Arc<Bridges>,
}

impl<'a> Runner<'a> {
    /// Of a plan.
    ///
    /// # Errors
    /// The limits cannot be read.
    pub fn new(expanded: &'a Expanded) -> Result<Self, Error> {
        Self::with(expanded, Kept::default())
    }

    /// Of a plan for which something may have been prepared before.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with(expanded: &'a Expanded, kept: Kept) -> Result<Self, Error> {
        let Expanded { plan, source, facts, .. } = expanded;
        let criteria = Limits { texts: plan.limits.clone() }.criteria()?;
        let filters = criteria.filters(DECK_ACCELERATION, facts);
        let judged = filters.first().copied().unwrap_or(Filter::Raw);
        let one_axle = OneAxle::new(plan, source, facts, filters.clone()).with(kept.one_axle.clone());
        let modal = Modal::new(plan, source, filters).with(kept.modal.clone());
        let abreast = abreast(&expanded.checked.bridge.structure);
        Ok(Self { plan, source, facts, criteria, judged, modal, one_axle, kept, abreast, keep: None, master: None })
    }

    /// With a master that takes the steps of runs over the FMUs of the plan.
    #[must_use]
    pub fn over(self, master: &'a dyn Master) -> Self {
        Self { master: Some(master), ..self }
    }

    /// With the history of every run kept in this folder.
    #[must_use]
    pub fn keeping(self, folder: &'a Path) -> Self {
        let Self { modal, one_axle, .. } = self;
        let keep = Some(folder);
        Self { modal: modal.keeping(folder), one_axle: one_axle.keeping(folder), keep, ..self }
    }

    /// Quantities, each behind its filter, whose largest values govern and are refined.
    pub fn keys(&self) -> Vec<(String, String)> {
        let keys = [(DECK_ACCELERATION, self.judged.label()), (DECK_DISPLACEMENT, RAW.into())];
        keys.map(|(quantity, filter)| (quantity.to_string(), filter)).to_vec()
    }

    /// What is refined, and where: the resonances of all trains are sought.
    pub fn refined(&self) -> Refined {
        let resonances = self.plan.trains.iter().map(|train| {
            let (train, frequency) = (force_train(train), self.facts.n0_hz);
            let found = train.map(|train| Signature::new(&train, DAMPING).resonances(WAVELENGTHS));
            found.into_iter().flatten().filter_map(|one| Some(3.6 * frequency? * one.length)).collect()
        });
        Refined { keys: self.keys(), resonances: resonances.collect() }
    }

    /// A governing run once more with its histories: vehicles as they are, axle loads step by step on a rigid track.
    ///
    /// # Errors
    /// Why it failed, a sentence.
    pub fn again(&self, run: &Run, step: Option<f64>, stop: &AtomicBool) -> Again {
        if let Some(over) = self.over_fmu() {
            return Ok(over.run(run, stop)?.map(|(_, history)| (None, history)));
        }
        match self.plan.trains[run.train].load {
            Load::Axles(_) => {
                let again = self.loads(step).run(run, stop)?;
                Ok(again.map(|(record, history)| (Some(record), history)))
            }
            Load::Cars(_) | Load::Scenario => Ok(self.vehicles().history(run, stop)?.map(|history| (None, history))),
        }
    }

    /// Every governing run once more, those that govern several quantities once, at the same time if there is more than one
    /// worker; their ids beside them. Behind one that was asked to stop no other begins.
    pub fn again_each(&self, governing: &[Governing], workers: usize, stop: &AtomicBool) -> Vec<(String, Again)> {
        let mut once: Vec<&Governing> = Vec::new();
        for one in governing {
            if !once.iter().any(|other| other.run.id == one.run.id) {
                once.push(one);
            }
        }
        let again = |one: &Governing| (one.run.id.clone(), self.again(&one.run, one.step, stop));
        if workers > 1 {
            return std::thread::scope(|scope| {
                let threads: Vec<_> = once.iter().map(|one| (one, scope.spawn(|| again(one)))).collect();
                let died = |one: &Governing| (one.run.id.clone(), Err("it ended by a panic".into()));
                threads.into_iter().map(|(one, thread)| thread.join().unwrap_or_else(|_| died(one))).collect()
            });
        }
        let mut all = Vec::with_capacity(once.len());
        for one in once {
            all.push(again(one));
            if matches!(all.last(), Some((_, Ok(None)))) {
                break;
            }
        }
        all
    }

    fn task(&self) -> Task<'_> {
        let Self { plan, source, facts, ref criteria, judged, keep, .. } = *self;
        Task { plan, source, criteria, facts, judged, keep }
    }

    /// Runs of axle loads step by step, with another step than the scenario's.
    pub fn loads(&self, step: Option<f64>) -> Loads<'_> {
        Loads { task: self.task(), step, bridges: &self.kept.bridges }
    }

    /// Runs of vehicles.
    pub fn vehicles(&self) -> Vehicles<'_> {
        Vehicles { task: self.task(), shared: &self.kept.shared, abreast: self.abreast }
    }

    /// Runs over the FMUs of the plan; `None`: the bridge is the scenario's own.
    fn over_fmu(&self) -> Option<OverFmu<'_>> {
        (!self.plan.bridges.is_empty()).then(|| OverFmu { task: self.task(), master: self.master })
    }

    fn coupled(&self, runs: &[Run], of_axles: bool, stop: &AtomicBool) -> Vec<Computed> {
        if of_axles { self.loads(None).compute(runs, stop) } else { self.vehicles().compute(runs, stop) }
    }
}

impl Compute for Runner<'_> {
    fn batch(&self, runs: usize, workers: usize) -> usize {
        match self.plan.way {
            Way::Modal => self.modal.batch(runs, workers),
            Way::OneAxle => self.one_axle.batch(runs, workers),
            Way::Coupled if !self.plan.bridges.is_empty() => 1,
            Way::Coupled => self.vehicles().batch(runs, workers),
        }
    }

    fn share(&self, a: &Run, b: &Run) -> bool {
        match self.plan.way {
            Way::Modal => self.modal.share(a, b),
            Way::OneAxle => self.one_axle.share(a, b),
            Way::Coupled => false,
        }
    }

    fn arrange(&self, runs: &mut [Run]) {
        if self.plan.way == Way::OneAxle {
            self.one_axle.arrange(runs);
        }
    }

    fn compute(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed> {
        if let Some(over) = self.over_fmu() {
            return over.compute(runs, stop);
        }
        match self.plan.way {
            Way::Modal => self.modal.compute(runs, stop),
            Way::OneAxle => self.one_axle.compute(runs, stop),
            Way::Coupled => {
                let of_axles = |run: &Run| matches!(self.plan.trains[run.train].load, Load::Axles(_));
                let alike = runs.chunk_by(|a, b| of_axles(a) == of_axles(b));
                alike.flat_map(|runs| self.coupled(runs, of_axles(&runs[0]), stop)).collect()
            }
        }
    }
}

/// How many runs go side by side: beams and frames share nothing that a step reads.
fn abreast(structure: &StructureSpec) -> usize {
    if matches!(structure, StructureSpec::Beams { .. } | StructureSpec::Frame(_)) { 1 } else { RUNS }
}
