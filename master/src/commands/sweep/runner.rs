//! What computes the runs of a plan: one of the ways, by the plan and the train.

use std::sync::atomic::AtomicBool;

use ttb_assessment::criterion::DEFAULT;
use ttb_assessment::filter::RAW;
use ttb_assessment::peak::quantity::{DECK_ACCELERATION, DECK_DISPLACEMENT};
use ttb_assessment::{Criteria, Facts, Filter};
use ttb_campaign::coupled::{Bridges, Loads, Shared, Source, Vehicles};
use ttb_campaign::expand::Expanded;
use ttb_campaign::folder::Refined;
use ttb_campaign::history::History;
use ttb_campaign::modal::{Modal, force_train};
use ttb_campaign::one_axle::OneAxle;
use ttb_campaign::plan::Load;
use ttb_campaign::{Compute, Computed, Plan, Record, Run, Way};
use ttb_trains::Signature;

use crate::error::Error;

/// Range of wavelengths in which resonances are sought, m.
const WAVELENGTHS: [f64; 2] = [4.5, 40.0];
/// Damping ratio with which they are sought: it moves them little.
const DAMPING: f64 = 0.01;

/// The ways over one plan.
pub struct Runner<'a> {
    plan: &'a Plan,
    source: &'a Source,
    facts: &'a Facts,
    criteria: Criteria,
    judged: Filter,
    modal: Modal<'a>,
    one_axle: OneAxle<'a>,
    shared: Shared,
    bridges: Bridges,
}

impl<'a> Runner<'a> {
    /// Of a plan.
    ///
    /// # Errors
    /// The way is not known here.
    pub fn new(expanded: &'a Expanded) -> Result<Self, Error> {
        let Expanded { plan, source, facts, .. } = expanded;
        let criteria = Criteria::bundled(DEFAULT);
        let told = |problems: Vec<_>| problems.iter().map(ToString::to_string).collect::<Vec<String>>().join("\n");
        let criteria = criteria.map_err(|problems| Error::Input(told(problems)))?;
        let mut filters: Vec<Filter> = Vec::new();
        for wanted in criteria.wanted(facts) {
            if wanted.quantity == DECK_ACCELERATION && wanted.filter != Filter::Raw && !filters.contains(&wanted.filter)
            {
                filters.push(wanted.filter);
            }
        }
        let judged = filters.first().copied().unwrap_or(Filter::Raw);
        let one_axle = OneAxle::new(plan, source, facts, filters.clone());
        let modal = Modal::new(plan, source, filters);
        let (shared, bridges) = (Shared::default(), Bridges::default());
        Ok(Self { plan, source, facts, criteria, judged, modal, one_axle, shared, bridges })
    }

    /// What is refined.
    pub fn refined(&self) -> Refined {
        let keys = [(DECK_ACCELERATION, self.judged.label()), (DECK_DISPLACEMENT, RAW.into())];
        let resonances = self.plan.trains.iter().map(|train| {
            let (train, frequency) = (force_train(train), self.facts.n0_hz);
            let found = train.map(|train| Signature::new(&train, DAMPING).resonances(WAVELENGTHS));
            found.into_iter().flatten().filter_map(|one| Some(3.6 * frequency? * one.length)).collect()
        });
        Refined {
            keys: keys.map(|(quantity, filter)| (quantity.to_string(), filter)).to_vec(),
            resonances: resonances.collect(),
        }
    }

    /// A governing run once more with its histories: vehicles as they are, axle loads step by step on a rigid track.
    ///
    /// # Errors
    /// Why it failed, a sentence.
    pub fn again(
        &self,
        run: &Run,
        step: Option<f64>,
        stop: &AtomicBool,
    ) -> Result<Option<(Option<Record>, History)>, String> {
        match self.plan.trains[run.train].load {
            Load::Axles(_) => {
                let again = self.loads(step).run(run, stop)?;
                Ok(again.map(|(record, history)| (Some(record), history)))
            }
            Load::Cars(_) | Load::Scenario => Ok(self.vehicles().history(run, stop)?.map(|history| (None, history))),
        }
    }

    fn loads(&self, step: Option<f64>) -> Loads<'_> {
        let Self { plan, source, facts, criteria, judged, bridges, .. } = self;
        Loads { plan, source, criteria, facts, judged: *judged, step, bridges }
    }

    fn vehicles(&self) -> Vehicles<'_> {
        let Self { plan, source, facts, criteria, judged, shared, .. } = self;
        Vehicles { plan, source, criteria, facts, judged: *judged, shared }
    }

    fn one_by_one(&self, run: &Run, stop: &AtomicBool) -> Vec<Computed> {
        let run = std::slice::from_ref(run);
        match self.plan.trains[run[0].train].load {
            Load::Axles(_) => self.loads(None).compute(run, stop),
            Load::Cars(_) | Load::Scenario => self.vehicles().compute(run, stop),
        }
    }
}

impl Compute for Runner<'_> {
    fn batch(&self) -> usize {
        match self.plan.way {
            Way::Modal => self.modal.batch(),
            Way::OneAxle => self.one_axle.batch(),
            Way::Coupled => 1,
        }
    }

    fn arrange(&self, runs: &mut [Run]) {
        if self.plan.way == Way::OneAxle {
            self.one_axle.arrange(runs);
        }
    }

    fn compute(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed> {
        match self.plan.way {
            Way::Modal => self.modal.compute(runs, stop),
            Way::OneAxle => self.one_axle.compute(runs, stop),
            Way::Coupled => runs.iter().flat_map(|run| self.one_by_one(run, stop)).collect(),
        }
    }
}
