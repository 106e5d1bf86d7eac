//! Whether the bridge comes back to its state, looked at now and then: a step that has converged is repeated from the saved
//! state under the same forces, and the bridge must answer the same. What it answered itself is compared, never what a model
//! said for it, so that a bridge that is not linear passes.

use crate::error::IterationError;
use crate::probe::{difference, returns};
use crate::report::Side;
use crate::scheme::step::Iteration;
use crate::trial::{Sides, Trials};

pub(crate) struct Audit {
    /// Steps that have converged.
    converged: usize,
    /// The bridge's first answer.
    answered: Vec<f64>,
    /// What the trial ended with, which may be the model's motion.
    motion: Vec<f64>,
}

impl Audit {
    pub fn new(motions: usize) -> Self {
        Self { converged: 0, answered: vec![0.0; motions], motion: vec![0.0; motions] }
    }

    /// A step has converged; whether it is to be repeated: the 1st, the 2nd, the 4th and so on.
    pub fn is_due(&mut self) -> bool {
        self.converged += 1;
        self.converged.is_power_of_two()
    }

    /// Keeps the bridge's answer to the last trial.
    pub fn remember(&mut self, iteration: &Iteration) {
        self.answered.copy_from_slice(iteration.answered());
    }

    /// Repeats the bridge's part of the trial that was remembered, under the same forces. The motion that the last trial
    /// ended with stays.
    pub fn repeat(&mut self, trials: &mut Trials, sides: &mut Sides) -> Result<(), IterationError> {
        self.motion.copy_from_slice(&trials.exchange.motion);
        sides.bridge.restore()?;
        trials.run_bridge(sides, true)?;
        let exchange = &mut trials.exchange;
        let off = difference(exchange.ports(), &self.answered, &exchange.motion, &exchange.now);
        exchange.motion.copy_from_slice(&self.motion);
        if returns(off) {
            return Ok(());
        }
        Err(IterationError::NoReturn { t: sides.t, side: Side::Bridge, difference: off })
    }
}
