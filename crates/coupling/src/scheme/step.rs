//! One macro step: trials from the saved states until both sides agree.
//!
//! ```text
//! λ⁰ ← predict(λ_n, λ_{n−1}, …)                                                   predict
//! for k = 1 … k_max
//!   bridge      ← λ_n, (λ^{k−1} − λ_n)/h;               step;   d, ḋ ← bridge     trial
//!   train–track ← d_n, ḋ_n, (d − d_n)/h, (ḋ − ḋ_n)/h;   step;   G ← train–track
//!   r = G − λ^{k−1};  |r| ≤ tolerance · max(|G|, one axle load) → converged       residual
//!   λ^k ← accelerate(λ^{k−1}, r)                                                  accelerate
//! λ_{n+1} ← λ, d_{n+1} ← d                                                        accept
//! ```
//!
//! With a model H of the bridge, λ^k solves λ = G_T(d^{k−1} + H (λ − λ^{k−1})), G_T the train–track side's answer to a deck
//! motion, by sub-iterations with that side alone: the next trial is the last one if H is exact.

use ttb_contract::Ports;

use crate::acceleration::{Acceleration, Strategy};
use crate::error::IterationError;
use crate::report::{Outcome, StepInfo};
use crate::settings::Settings;
use crate::trial::{Sides, Trials};

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

/// The iteration of a step.
pub(crate) struct Iteration {
    pub settings: Settings,
    pub trials: Trials,
    pub strategy: Strategy,
    /// Trials begun in the iteration at hand.
    pub made: usize,
    /// Whether the motion of the last trial is the model's; the bridge's own is then here.
    foreseen: bool,
    answered: Vec<f64>,
}

impl Iteration {
    pub fn new(ports: Ports, settings: Settings) -> Self {
        let (n, answered) = (ports.forces(), vec![0.0; ports.motions()]);
        let (trials, strategy) = (Trials::new(ports, &settings), Strategy::new(n, &settings));
        Self { settings, trials, strategy, made: 0, foreseen: false, answered }
    }

    /// What the bridge itself answered to the last trial.
    pub fn answered(&self) -> &[f64] {
        if self.foreseen { &self.answered } else { &self.trials.exchange.motion }
    }

    /// Predicts and chooses the acceleration for a step of `h` seconds.
    pub fn begin(&mut self, h: f64) {
        self.trials.predict(h);
        self.strategy.begin_step(h);
    }

    /// One trial, without anything that was learnt.
    pub fn run_plain(&mut self, sides: &mut Sides) -> Result<(), IterationError> {
        self.foreseen = false;
        self.trials.run(sides)
    }

    /// λ = G(λ) by at most `limit` trials.
    pub fn iterate(&mut self, sides: &mut Sides, mode: Mode, limit: usize) -> Result<StepInfo, IterationError> {
        let (mut k, mut alone, mut spared, mut first) = (0, 0, 0, 0.0);
        let (outcome, residual) = loop {
            self.made = k + 1;
            self.foreseen = false;
            match mode {
                Mode::Equilibrium => self.trials.run_statics(sides)?,
                Mode::OnePass => self.trials.run_once(sides)?,
                Mode::RollBack if alone == 0 => self.trials.run(sides)?,
                Mode::RollBack => spared += usize::from(self.trial_as_foreseen(sides)?),
            }
            k += 1;
            let residual = self.trials.measure();
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
            alone += self.accelerate(sides, residual)?;
        };
        if outcome == Outcome::Converged {
            self.strategy.end_step(&self.trials.lambda, &self.trials.residual);
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

    /// The next λ; how many trials of the train–track side alone it took.
    fn accelerate(&mut self, sides: &mut Sides, residual: f64) -> Result<usize, IterationError> {
        let Trials { exchange, lambda, residual: r, .. } = &mut self.trials;
        if let Some(newton) = self.strategy.newton() {
            newton.base(lambda, &exchange.motion);
        }
        self.strategy.update(lambda, r, residual);
        for alone in 1..=SUB_ITERATIONS {
            let Some(newton) = self.strategy.newton() else { return Ok(0) };
            newton.motion(&self.trials.lambda, &mut self.trials.exchange.motion);
            sides.train_track.restore()?;
            self.trials.run_train_track(sides, true)?;
            if self.trials.measure() <= CLOSER * self.settings.tolerance {
                return Ok(alone);
            }
            if let Some(newton) = self.strategy.newton() {
                newton.update(&mut self.trials.lambda, &self.trials.residual);
            }
        }
        Ok(SUB_ITERATIONS)
    }

    /// A trial after sub-iterations. If the bridge moves as its model did, the train–track side has just made its part, and
    /// is spared it.
    fn trial_as_foreseen(&mut self, sides: &mut Sides) -> Result<bool, IterationError> {
        sides.bridge.restore()?;
        self.trials.run_bridge(sides, true)?;
        let negligible = NEGLIGIBLE * self.settings.tolerance * self.trials.scale;
        let motion = &mut self.trials.exchange.motion;
        if let Some(newton) = self.strategy.newton()
            && newton.foresaw(motion, negligible)
        {
            // Both sides agree on the motion that the train–track side knows: its next step begins there.
            self.answered.copy_from_slice(motion);
            newton.foreseen(motion);
            self.foreseen = true;
            return Ok(true);
        }
        sides.train_track.restore()?;
        self.trials.run_train_track(sides, true)?;
        Ok(false)
    }
}
