//! The work at the interface, counted step by step.

use ttb_contract::Ports;

use crate::algebra::each;
use crate::error::IterationError;
use crate::trial::{Sides, Trials};
use crate::work::{Step, Work};

/// What is needed to count the work of a step.
pub(crate) struct Account {
    /// G_n, what the train–track side answered at last in the step before.
    answer_before: Vec<f64>,
    /// Δd over a step; empty: it is not known along which motion every force does work, and none is counted.
    moved: Vec<f64>,
    /// Forces are means over the step.
    means: bool,
}

impl Account {
    pub fn new(ports: &Ports, means: bool) -> Self {
        let n = ports.forces();
        let moved = if ports.count_work() { vec![0.0; n] } else { Vec::new() };
        Self { answer_before: vec![0.0; n], moved, means }
    }

    /// Begins with the answer in static equilibrium.
    pub fn start(&mut self, answer: &[f64]) {
        self.answer_before.copy_from_slice(answer);
    }

    /// The work of a step that is about to be accepted.
    pub fn count(&mut self, trials: &mut Trials, sides: &mut Sides) -> Result<Work, IterationError> {
        let (before, after) = trials.exchange.parts();
        each(&mut self.moved, [before.positions, after.positions], |[before, after]| after - before);
        let ends = |before, after| if self.means { [after, after] } else { [before, after] };
        let step = Step {
            sent: ends(trials.forces.now(), &trials.lambda[..]),
            answered: ends(&self.answer_before[..], &trials.answer[..]),
            moved: &self.moved,
            given: sides.train_track.work()?,
        };
        let work = step.work();
        self.answer_before.copy_from_slice(&trials.answer);
        Ok(work)
    }
}
