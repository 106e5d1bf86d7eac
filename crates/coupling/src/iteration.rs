//! The hybrid solution algorithm: track–bridge force compatibility, iterated at every macro step.
//!
//! λ are the support forces, d and ḋ the deck's motion under the supports. One step [t_n, t_n + h]:
//!
//! ```text
//! 0  save both states
//! 1  λ⁰ ← predict(λ_n, λ_{n−1})
//! 2  for k = 1 … k_max
//!      bridge      ← λ_n, (λ^{k−1} − λ_n)/h;                  step;   d, ḋ ← bridge
//!      train–track ← d_n, ḋ_n, (d − d_n)/h, (ḋ − ḋ_n)/h;      step;   G ← train–track
//!      r = G − λ^{k−1};   |r| ≤ tolerance · max(|G|, one axle load) → leave, converged
//!      λ^k ← accelerate(λ^{k−1}, r);   restore both
//! ```
//!
//! A subsystem that cannot interpolate its inputs gets the mean over the step, held: (λ_n + λ^{k−1})/2. Both ways the
//! converged step *is* the monolithic one, to the tolerance, for subsystems that integrate by the trapezoidal rule; a
//! held end value would be first order only. Nothing here is allocated in a step.

use crate::acceleration::{Acceleration, Aitken, FixedPoint};
use crate::predictor::History;
pub use crate::report::{IterationError, Outcome, StepInfo};
pub use crate::settings::{OnFailure, Settings};
use crate::subsystem::{Failure, Subsystem};

/// Halvings of a step at most, under [`OnFailure::Halve`].
const HALVINGS: usize = 4;

/// Trials of the static iteration at least: it needs no roll-back, and a one-pass run must start from equilibrium too.
const STATIC_TRIALS: usize = 30;

/// The coupling of one train–track subsystem with one bridge.
pub struct Coupling {
    settings: Settings,
    acceleration: Box<dyn Acceleration>,
    forces: History,
    /// λ, the trial sent to the bridge.
    lambda: Vec<f64>,
    /// G(λ), the answer of the train–track subsystem.
    answer: Vec<f64>,
    residual: Vec<f64>,
    /// (d, ḋ) at t_n and at the end of the trial step.
    motion_now: Vec<f64>,
    motion: Vec<f64>,
    /// What is sent: means, or rates.
    sent_force: Vec<f64>,
    sent_motion: Vec<f64>,
}

impl Coupling {
    /// For `forces` support forces and `motions` deck motions (displacements and velocities).
    pub fn new(forces: usize, motions: usize, settings: Settings) -> Self {
        let acceleration: Box<dyn Acceleration> =
            if settings.aitken { Box::new(Aitken::new(forces)) } else { Box::new(FixedPoint) };
        let (f, m) = (|| vec![0.0; forces], || vec![0.0; motions]);
        Self {
            settings,
            acceleration,
            forces: History::new(forces),
            lambda: f(),
            answer: f(),
            residual: f(),
            motion_now: m(),
            motion: m(),
            sent_force: f(),
            sent_motion: m(),
        }
    }

    /// Accepted support forces at t_n, N.
    pub fn forces(&self) -> &[f64] {
        self.forces.now()
    }

    /// Static force compatibility in initialization mode, then the end of initialization.
    ///
    /// # Errors
    /// A subsystem fails, or the static iteration does not converge under the policy `Stop` or `Halve`.
    pub fn initialise(
        &mut self,
        train_track: &mut dyn Subsystem,
        bridge: &mut dyn Subsystem,
        t: f64,
    ) -> Result<StepInfo, IterationError> {
        let info = self.iterate(t, self.settings.max_iterations.max(STATIC_TRIALS), |this| {
            bridge.set_inputs(&this.lambda, None)?;
            bridge.get_outputs(&mut this.motion)?;
            train_track.set_inputs(&this.motion, None)?;
            train_track.get_outputs(&mut this.answer)?;
            Ok(())
        })?;
        if info.outcome == Outcome::IterationLimit && self.settings.on_failure != OnFailure::Accept {
            return Err(IterationError::NotConverged { t, h: 0.0, info });
        }
        train_track.exit_initialization()?;
        bridge.exit_initialization()?;
        bridge.get_outputs(&mut self.motion_now)?;
        self.forces.start(&self.lambda);
        Ok(info)
    }

    /// One macro step [t, t + h].
    ///
    /// # Errors
    /// A subsystem fails, the residual is not finite, or the step does not converge and the policy says stop.
    pub fn step(
        &mut self,
        train_track: &mut dyn Subsystem,
        bridge: &mut dyn Subsystem,
        t: f64,
        h: f64,
    ) -> Result<StepInfo, IterationError> {
        self.step_or_halve(train_track, bridge, t, h, 0)
    }

    fn step_or_halve(
        &mut self,
        train_track: &mut dyn Subsystem,
        bridge: &mut dyn Subsystem,
        t: f64,
        h: f64,
        depth: usize,
    ) -> Result<StepInfo, IterationError> {
        let info = self.try_step(train_track, bridge, t, h)?;
        let policy = self.settings.on_failure;
        if info.outcome == Outcome::Converged || policy == OnFailure::Accept {
            // In one pass nothing but the answer carries the train's forces into the next step.
            let one_pass = self.settings.max_iterations == 1;
            self.forces.accept(if one_pass { &self.answer } else { &self.lambda }, h);
            std::mem::swap(&mut self.motion_now, &mut self.motion);
            return Ok(info);
        }
        if self.settings.max_iterations > 1 {
            train_track.restore()?;
            bridge.restore()?;
        }
        if policy == OnFailure::Stop || depth == HALVINGS || self.settings.max_iterations == 1 {
            return Err(IterationError::NotConverged { t, h, info });
        }
        let first = self.step_or_halve(train_track, bridge, t, 0.5 * h, depth + 1)?;
        let second = self.step_or_halve(train_track, bridge, t + 0.5 * h, 0.5 * h, depth + 1)?;
        Ok(StepInfo {
            iterations: info.iterations + first.iterations + second.iterations,
            roll_backs: info.roll_backs + 1 + first.roll_backs + second.roll_backs,
            halvings: 1 + first.halvings + second.halvings,
            ..second
        })
    }

    fn try_step(
        &mut self,
        train_track: &mut dyn Subsystem,
        bridge: &mut dyn Subsystem,
        t: f64,
        h: f64,
    ) -> Result<StepInfo, IterationError> {
        let interpolate_forces = bridge.can_interpolate() && !self.settings.hold_forces;
        let interpolate_motion = train_track.can_interpolate();
        let implicit = self.settings.max_iterations > 1;
        if implicit {
            train_track.save()?;
            bridge.save()?;
        }
        self.forces.predict(self.settings.predictor, h, &mut self.lambda);
        self.iterate(t, self.settings.max_iterations, |this| {
            // Also before the first trial: some FMUs step differently the first time than after a restored state.
            if implicit {
                train_track.restore()?;
                bridge.restore()?;
            }
            send(bridge, this.forces.now(), &this.lambda, h, interpolate_forces, &mut this.sent_force)?;
            bridge.step(t, h, implicit)?;
            bridge.get_outputs(&mut this.motion)?;
            send(train_track, &this.motion_now, &this.motion, h, interpolate_motion, &mut this.sent_motion)?;
            train_track.step(t, h, implicit)?;
            train_track.get_outputs(&mut this.answer)?;
            Ok(())
        })
    }

    /// λ = G(λ) by trials; `trial` computes the answer to `self.lambda`.
    fn iterate(
        &mut self,
        t: f64,
        limit: usize,
        mut trial: impl FnMut(&mut Self) -> Result<(), Failure>,
    ) -> Result<StepInfo, IterationError> {
        self.acceleration.begin_step();
        let (mut k, mut before, mut contraction) = (0, 0.0, 0.0);
        let (outcome, residual) = loop {
            trial(self)?;
            k += 1;
            let (mut squared_residual, mut squared_answer) = (0.0, 0.0);
            for ((r, answer), lambda) in self.residual.iter_mut().zip(&self.answer).zip(&self.lambda) {
                *r = answer - lambda;
                squared_residual += *r * *r;
                squared_answer += answer * answer;
            }
            let residual = squared_residual.sqrt() / squared_answer.sqrt().max(self.settings.force_scale);
            if !residual.is_finite() {
                return Err(IterationError::NotFinite { t });
            }
            if before > 0.0 {
                contraction = residual / before;
            }
            if residual <= self.settings.tolerance {
                break (Outcome::Converged, residual);
            }
            if k == limit {
                break (Outcome::IterationLimit, residual);
            }
            before = residual;
            self.acceleration.update(&mut self.lambda, &self.residual);
        };
        self.acceleration.end_step();
        Ok(StepInfo { outcome, iterations: k, residual, contraction, roll_backs: k - 1, halvings: 0 })
    }
}

/// Sends a straight line from `from` to `to` over a step of `h`: as value and rate, or as the held mean.
fn send(
    to_whom: &mut dyn Subsystem,
    from: &[f64],
    to: &[f64],
    h: f64,
    interpolate: bool,
    buffer: &mut [f64],
) -> Result<(), Failure> {
    for ((b, from), to) in buffer.iter_mut().zip(from).zip(to) {
        *b = if interpolate { (to - from) / h } else { 0.5 * (from + to) };
    }
    if interpolate { to_whom.set_inputs(from, Some(buffer)) } else { to_whom.set_inputs(buffer, None) }
}
