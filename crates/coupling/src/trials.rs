//! Trials of one step until both sides agree, and the sub-iterations of Newton's method between them.

use crate::acceleration::Acceleration;
use crate::dense::{each, norm};
use crate::exchange::Sides;
use crate::iteration::Coupling;
use crate::report::{IterationError, Outcome, StepInfo};

/// A residual that has grown by this much will not come back.
const RUNAWAY: f64 = 1e6;

/// Sub-iterations at most.
const SUB_ITERATIONS: usize = 20;

/// Sub-iterations go on until the residual is this much below the tolerance: the bridge's model is not exact.
const CLOSER: f64 = 0.3;

/// What the model may be off by, relative to the tolerance, where it stands for the bridge.
const NEGLIGIBLE: f64 = 0.01;

/// What a trial is.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Mode {
    /// Static equilibrium, in initialization mode.
    Equilibrium,
    /// A step that cannot be repeated.
    OnePass,
    /// A step from the saved states.
    RollBack,
}

impl Coupling {
    /// One trial of the step from the saved states: G(λ).
    pub(crate) fn trial(&mut self, sides: &mut Sides) -> Result<(), IterationError> {
        self.exchange.trial(sides, self.forces.now(), &self.lambda, &mut self.answer)
    }

    /// A trial after sub-iterations. If the bridge moves as its model did, the train–track subsystem has just made its
    /// part, and is spared it.
    fn trial_as_foreseen(&mut self, sides: &mut Sides) -> Result<bool, IterationError> {
        sides.bridge.restore()?;
        self.exchange.bridge(sides, self.forces.now(), &self.lambda, true)?;
        let negligible = NEGLIGIBLE * self.settings.tolerance * self.settings.force_scale;
        if let Some(newton) = self.strategy.newton()
            && newton.foresaw(&self.exchange.motion, negligible)
        {
            // Both sides agree on the motion that the train–track subsystem knows: its next step begins there.
            newton.foreseen(&mut self.exchange.motion);
            return Ok(true);
        }
        sides.train_track.restore()?;
        self.exchange.train_track(sides, &mut self.answer, true)?;
        Ok(false)
    }

    /// λ = G(λ) by trials.
    pub(crate) fn iterate(&mut self, sides: &mut Sides, mode: Mode, limit: usize) -> Result<StepInfo, IterationError> {
        let (mut k, mut alone, mut spared, mut first) = (0, 0, 0, 0.0);
        let (outcome, residual) = loop {
            self.made = k + 1;
            match mode {
                Mode::Equilibrium => self.exchange.equilibrium(sides, &self.lambda, &mut self.answer)?,
                Mode::OnePass => {
                    self.exchange.bridge(sides, self.forces.now(), &self.lambda, false)?;
                    self.exchange.train_track(sides, &mut self.answer, false)?;
                }
                Mode::RollBack if alone == 0 => self.trial(sides)?,
                Mode::RollBack => spared += usize::from(self.trial_as_foreseen(sides)?),
            }
            k += 1;
            let residual = self.residual();
            if k == 1 {
                first = residual;
            }
            if residual <= self.settings.tolerance {
                break (Outcome::Converged, residual);
            }
            // Also where the residual is no number any more: a square that overflows.
            let lost = residual.is_nan() || residual > RUNAWAY * first.max(1.0);
            if k == limit || lost {
                break (Outcome::IterationLimit, residual);
            }
            alone += self.advance(sides, residual)?;
        };
        if outcome == Outcome::Converged {
            self.strategy.end_step(&self.lambda, &self.residual);
        }
        let contraction = if k > 1 && first > 0.0 { (residual / first).powf(1.0 / (k - 1) as f64) } else { 0.0 };
        Ok(StepInfo {
            outcome,
            iterations: k,
            train_track_trials: k + alone - spared,
            residual,
            contraction,
            roll_backs: k - 1,
            method: self.strategy.in_force(),
            ..StepInfo::default()
        })
    }

    /// r = G − λ; |r| relative to max(|G|, one axle load).
    pub(crate) fn residual(&mut self) -> f64 {
        each(&mut self.residual, [&self.answer, &self.lambda], |[answer, lambda]| answer - lambda);
        norm(&self.residual) / norm(&self.answer).max(self.settings.force_scale)
    }

    /// The next λ; trials of the train–track subsystem alone that it took. With a model of the bridge, λ solves
    ///
    /// ```text
    /// λ = G_T(d^{k−1} + H (λ − λ^{k−1}))        G_T: the train–track subsystem's answer to a deck motion
    /// ```
    ///
    /// by sub-iterations with the train–track subsystem: the next trial is the last one if H is exact.
    fn advance(&mut self, sides: &mut Sides, residual: f64) -> Result<usize, IterationError> {
        if let Some(newton) = self.strategy.newton() {
            newton.base(&self.lambda, &self.exchange.motion);
        }
        self.strategy.update(&mut self.lambda, &self.residual, residual);
        for alone in 1..=SUB_ITERATIONS {
            let Some(newton) = self.strategy.newton() else { return Ok(0) };
            newton.motion(&self.lambda, &mut self.exchange.motion);
            sides.train_track.restore()?;
            self.exchange.train_track(sides, &mut self.answer, true)?;
            if self.residual() <= CLOSER * self.settings.tolerance {
                return Ok(alone);
            }
            if let Some(newton) = self.strategy.newton() {
                newton.update(&mut self.lambda, &self.residual);
            }
        }
        Ok(SUB_ITERATIONS)
    }
}
