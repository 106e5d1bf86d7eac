//! Whether both sides come back to their states, looked at now and then, in two ways.
//!
//! ```text
//! fresh     save;  step under λ⁰;  back;  step under λ⁰       a restored state is the one that was saved
//! repeated  back;  step under λ of the last trial             trials leave nothing behind
//! ```
//!
//! The same step must give the same. How far it is off is told relative to what other forces, or another motion of the
//! deck, change of it. What a side answered itself is compared, never what a model said for it, so that a bridge that is
//! not linear passes.
//!
//! A repeated step has to be the same to rounding, because the iteration lives on it. A fresh one may differ for other
//! reasons, too: the solver of some FMUs begins anew at a restored state, and others are disturbed by being saved. Where
//! the outputs of the restored state are not those of the end of the last step either, it is the restored state that is
//! wrong; that is told, and refused where it is large. Else a large difference is told.

use crate::error::IterationError;
use crate::probe::{FORCE, MOTION, alike, difference, returns, shape};
use crate::report::{Report, Returned, Side};
use crate::scheme::step::Iteration;
use crate::trial::{Sides, Trials};

/// Looked at are the 1st, 2nd, 4th … step, and every one of so many.
const EVERY: usize = 64;
/// A fresh step that is off by more than this is told: where outputs show it, and where they do not.
const TOLD: [f64; 2] = [1e-6, 1e-3];
/// Where outputs show it, by more than this it is refused.
const REFUSED: f64 = 1e-2;

pub(crate) struct Audit {
    /// Steps begun.
    begun: usize,
    /// The first answers: the bridge's motion, the train–track side's forces.
    answered: Vec<f64>,
    forces: Vec<f64>,
    /// What is put back afterwards: the motion of the last trial, which may be a model's, the forces and the answer.
    motion: Vec<f64>,
    lambda: Vec<f64>,
    answer: Vec<f64>,
    /// Outputs of a restored state.
    outputs: Vec<f64>,
}

impl Audit {
    pub fn new(forces: usize, motions: usize) -> Self {
        let [of_forces, of_motions] = [forces, motions].map(|n| move || vec![0.0; n]);
        let (answered, motion, outputs) = (of_motions(), of_motions(), vec![0.0; motions.max(forces)]);
        Self { begun: 0, answered, forces: of_forces(), motion, lambda: of_forces(), answer: of_forces(), outputs }
    }

    /// A step begins; whether it is to be looked at.
    pub fn is_due(&mut self) -> bool {
        self.begun += 1;
        self.begun.is_power_of_two() || self.begun.is_multiple_of(EVERY)
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

    /// The first trial of a step twice: as both sides are, just saved, and from their restored states. Forces, motion and
    /// answer stay, both sides are back at the beginning of the step.
    pub fn look(&mut self, trials: &mut Trials, sides: &mut Sides, report: &mut Report) -> Result<(), IterationError> {
        self.motion.copy_from_slice(&trials.exchange.motion);
        self.lambda.copy_from_slice(&trials.lambda);
        self.answer.copy_from_slice(&trials.answer);
        trials.run_bridge(sides, true)?;
        self.answered.copy_from_slice(&trials.exchange.motion);
        trials.run_train_track(sides, true)?;
        self.forces.copy_from_slice(&trials.answer);
        sides.restore()?;
        let motion = &mut self.outputs[..self.motion.len()];
        sides.bridge.get_outputs(motion)?;
        let ports = trials.exchange.ports();
        let shown_by_bridge = difference(ports, &trials.exchange.now, motion, &self.answered) != 0.0;
        let forces = &mut self.outputs[..self.answer.len()];
        sides.train_track.get_outputs(forces)?;
        let shown_by_track = alike(&self.answer, forces, &self.forces) != 0.0;
        let bridge = self.bridge(trials, sides)?;
        let train_track = self.train_track(trials, sides)?;
        sides.restore()?;
        trials.exchange.motion.copy_from_slice(&self.motion);
        trials.answer.copy_from_slice(&self.answer);
        let found = [(Side::Bridge, bridge, shown_by_bridge), (Side::TrainTrack, train_track, shown_by_track)];
        for (side, difference, shown) in found {
            if shown && (difference.is_nan() || difference > REFUSED) {
                return Err(IterationError::NoReturn { t: sides.t, side, difference });
            }
            let told = TOLD[usize::from(!shown)];
            if difference > report.returned.map_or(told, |known| known.difference.max(told)) {
                report.returned = Some(Returned { t: sides.t, side, difference });
            }
        }
        Ok(())
    }

    /// By how much the bridge's restored step is off, of what a part of an axle load changes.
    fn bridge(&self, trials: &mut Trials, sides: &mut Sides) -> Result<f64, IterationError> {
        trials.run_bridge(sides, true)?;
        let same = |trials: &Trials| {
            let exchange = &trials.exchange;
            difference(exchange.ports(), &self.answered, &exchange.motion, &exchange.now) == 0.0
        };
        if same(trials) {
            return Ok(0.0);
        }
        let restored = trials.exchange.motion.clone();
        let load = FORCE * trials.scale;
        trials.lambda.iter_mut().enumerate().for_each(|(i, force)| *force += load * shape(i));
        sides.bridge.restore()?;
        trials.run_bridge(sides, true)?;
        trials.lambda.copy_from_slice(&self.lambda);
        let exchange = &trials.exchange;
        Ok(difference(exchange.ports(), &self.answered, &restored, &exchange.motion))
    }

    /// The same of the train–track side, over the motion that the bridge answered at first.
    fn train_track(&self, trials: &mut Trials, sides: &mut Sides) -> Result<f64, IterationError> {
        trials.exchange.motion.copy_from_slice(&self.answered);
        trials.run_train_track(sides, true)?;
        if alike(&self.forces, &trials.answer, &self.motion) == 0.0 {
            return Ok(0.0);
        }
        let restored = trials.answer.clone();
        let (_, moved) = trials.exchange.parts();
        moved.positions.iter_mut().enumerate().for_each(|(i, d)| *d += MOTION * shape(i));
        sides.train_track.restore()?;
        trials.run_train_track(sides, true)?;
        Ok(alike(&self.forces, &restored, &trials.answer))
    }
}
