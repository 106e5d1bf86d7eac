//! The hybrid solution algorithm: track–bridge force compatibility, iterated at every macro step.
//!
//! λ are the support forces, d and ḋ the deck's motion under the supports. One step [t_n, t_n + h]:
//!
//! ```text
//! 0  save both states
//! 1  λ⁰ ← predict(λ_n, λ_{n−1}, …)
//! 2  for k = 1 … k_max
//!      bridge      ← λ_n, (λ^{k−1} − λ_n)/h;                  step;   d, ḋ ← bridge
//!      train–track ← d_n, ḋ_n, (d − d_n)/h, (ḋ − ḋ_n)/h;      step;   G ← train–track
//!      r = G − λ^{k−1};   |r| ≤ tolerance · max(|G|, one axle load) → leave, converged
//!      λ^k ← accelerate(λ^{k−1}, r);   restore both
//! 3  not converged: once more by quasi-Newton with an empty memory; then in two halves, or stop
//! ```
//!
//! A subsystem that cannot interpolate its inputs gets the mean over the step, held: (λ_n + λ^{k−1})/2. Both ways the
//! converged step *is* the monolithic one, to the tolerance, for subsystems that integrate by the trapezoidal rule; a
//! held end value would be first order only. Nothing here is allocated in a step.

use crate::exchange::{Exchange, Sides};
use crate::explicit::Explicit;
use crate::predictor::History;
pub use crate::report::{IterationError, Outcome, Report, StepInfo};
use crate::settings::Method;
pub use crate::settings::{OnFailure, Settings};
use crate::strategy::Strategy;
use crate::trials::Mode;
use crate::work::{self, Displacements, Work};
use ttb_contract::Subsystem;

/// Halvings of a step at most, under [`OnFailure::Halve`].
const HALVINGS: usize = 4;

/// Trials of the static iteration at least: it needs no roll-back, and a one-pass run must start from equilibrium too.
const STATIC_TRIALS: usize = 30;

/// The coupling of one train–track subsystem with one bridge.
pub struct Coupling {
    pub(crate) settings: Settings,
    pub(crate) forces: History,
    pub(crate) exchange: Exchange,
    /// λ, the trial sent to the bridge.
    pub(crate) lambda: Vec<f64>,
    /// G(λ), the answer of the train–track subsystem.
    pub(crate) answer: Vec<f64>,
    /// G_n, what it answered at last in the step before.
    answer_before: Vec<f64>,
    /// Where in the motion each force finds its displacement.
    displacements: Displacements,
    /// Its change over a step; empty: no work is counted.
    moved: Vec<f64>,
    pub(crate) residual: Vec<f64>,
    /// Trials begun in the iteration at hand.
    pub(crate) made: usize,
    pub(crate) strategy: Strategy,
    pub(crate) report: Report,
    pub(crate) explicit: Explicit,
    /// Steps that have converged.
    pub(crate) converged: usize,
    /// A motion to compare with.
    pub(crate) repeated: Vec<f64>,
}

impl Coupling {
    /// For `forces` support forces and `motions` deck motions (displacements, then velocities).
    pub fn new(forces: usize, motions: usize, settings: Settings) -> Self {
        let zero = || vec![0.0; forces];
        Self {
            settings,
            forces: History::new(forces, settings.mean_forces),
            exchange: Exchange::new(forces, motions, &settings),
            lambda: zero(),
            answer: zero(),
            answer_before: zero(),
            displacements: Displacements::First,
            moved: if motions == 2 * forces { zero() } else { Vec::new() },
            residual: zero(),
            made: 0,
            strategy: Strategy::new(forces, &settings),
            report: Report::default(),
            explicit: Explicit::default(),
            converged: 0,
            repeated: vec![0.0; motions],
        }
    }

    /// Where in the motion each force finds its displacement; none: no work is counted.
    #[must_use]
    pub fn with_displacements(mut self, displacements: Vec<usize>) -> Self {
        (self.moved, self.displacements) = (vec![0.0; displacements.len()], displacements.into());
        self
    }

    /// Accepted support forces at t_n, or means over the step that ended there, N.
    pub fn forces(&self) -> &[f64] {
        self.forces.now()
    }

    /// What was found out besides the steps.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// The method in force from step to step, never `Auto`.
    pub fn method(&self) -> Method {
        self.strategy.method()
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
        let mut sides = Sides { train_track, bridge, t, h: 0.0 };
        self.strategy.begin_static();
        let info = self.iterate(&mut sides, Mode::Equilibrium, self.settings.max_iterations.max(STATIC_TRIALS))?;
        self.strategy.end_static();
        if info.outcome == Outcome::IterationLimit && self.settings.on_failure != OnFailure::Accept {
            return Err(IterationError::NotConverged { t, h: 0.0, info: Box::new(info), rho: None });
        }
        sides.train_track.exit_initialization()?;
        sides.bridge.exit_initialization()?;
        sides.bridge.get_outputs(&mut self.exchange.now)?;
        self.forces.start(&self.lambda);
        self.answer_before.copy_from_slice(&self.answer);
        Ok(info)
    }

    /// One macro step [t, t + h].
    ///
    /// # Errors
    /// A subsystem fails or answers NaN, the step does not converge and the policy says stop, or a bridge that cannot
    /// roll back makes the coupling unstable.
    pub fn step(
        &mut self,
        train_track: &mut dyn Subsystem,
        bridge: &mut dyn Subsystem,
        t: f64,
        h: f64,
    ) -> Result<StepInfo, IterationError> {
        let mut sides = Sides { train_track, bridge, t, h };
        if self.settings.max_iterations == 1 {
            self.one_pass(&mut sides)
        } else if self.settings.method == Method::Explicit || !sides.bridge.can_roll_back() {
            self.explicit_step(&mut sides)
        } else {
            self.step_or_halve(&mut sides, 0)
        }
    }

    /// Bridge first under the extrapolated forces, once; nothing but the answer carries the train's forces on.
    fn one_pass(&mut self, sides: &mut Sides) -> Result<StepInfo, IterationError> {
        self.forces.predict(self.settings.predictor, sides.h, &mut self.lambda);
        self.strategy.begin_step(sides.h);
        let info = self.iterate(sides, Mode::OnePass, 1)?;
        if info.outcome != Outcome::Converged && self.settings.on_failure != OnFailure::Accept {
            return Err(IterationError::NotConverged { t: sides.t, h: sides.h, info: Box::new(info), rho: None });
        }
        let work = self.account(sides)?;
        self.forces.accept(&self.answer, sides.h);
        self.exchange.accept();
        Ok(StepInfo { work, ..info })
    }

    fn step_or_halve(&mut self, sides: &mut Sides, depth: usize) -> Result<StepInfo, IterationError> {
        let info = self.try_step(sides)?;
        let (policy, t, h) = (self.settings.on_failure, sides.t, sides.h);
        if info.outcome == Outcome::Converged && self.audit_is_due() {
            self.repeated.copy_from_slice(&self.exchange.motion);
            self.audit(sides)?;
        }
        if info.outcome == Outcome::Converged || policy == OnFailure::Accept {
            let work = self.account(sides)?;
            self.forces.accept(&self.lambda, h);
            self.exchange.accept();
            if self.strategy.observe(info.iterations).is_some() {
                self.note(t);
            }
            return Ok(StepInfo { work, ..info });
        }
        if policy == OnFailure::Stop || depth == HALVINGS {
            self.forces.predict(self.settings.predictor, h, &mut self.lambda);
            let rho = self.diagnose(sides);
            sides.restore()?;
            if let Err(lie @ IterationError::NoReturn { .. }) = rho {
                return Err(lie);
            }
            let rho = rho.ok();
            return Err(IterationError::NotConverged { t, h, info: Box::new(info), rho });
        }
        sides.restore()?;
        let first = self.step_or_halve(&mut sides.over(t, 0.5 * h), depth + 1)?;
        let second = self.step_or_halve(&mut sides.over(t + 0.5 * h, 0.5 * h), depth + 1)?;
        let mut work = first.work;
        work += second.work;
        Ok(StepInfo {
            work,
            iterations: info.iterations + first.iterations + second.iterations,
            train_track_trials: info.train_track_trials + first.train_track_trials + second.train_track_trials,
            roll_backs: info.roll_backs + 1 + first.roll_backs + second.roll_backs,
            halvings: 1 + first.halvings + second.halvings,
            rescues: info.rescues + first.rescues + second.rescues,
            ..second
        })
    }

    fn try_step(&mut self, sides: &mut Sides) -> Result<StepInfo, IterationError> {
        sides.save()?;
        self.forces.predict(self.settings.predictor, sides.h, &mut self.lambda);
        if self.report.contraction.is_none() {
            self.report.contraction = Some(self.contraction(sides)?);
        }
        if self.strategy.wants_model() {
            let model = self.identify(sides)?;
            self.strategy.take(model, sides.h);
            self.note(sides.t);
        }
        self.strategy.begin_step(sides.h);
        let limit = self.settings.max_iterations;
        let plain = self.settings.method == Method::FixedPoint;
        let (info, wild) = match self.iterate(sides, Mode::RollBack, limit) {
            Ok(info) if info.outcome == Outcome::Converged || plain => return Ok(info),
            Ok(info) => (info, None),
            // Not the step is impossible, but forces that were tried on the way.
            Err(wild @ (IterationError::Subsystem(_) | IterationError::NotFinite { .. }))
                if self.made > 1 && !plain =>
            {
                let (iterations, roll_backs) = (self.made, self.made - 1);
                (StepInfo { iterations, roll_backs, train_track_trials: iterations, ..StepInfo::default() }, Some(wild))
            }
            Err(error) => return Err(error),
        };
        self.forces.predict(self.settings.predictor, sides.h, &mut self.lambda);
        self.strategy.begin_rescue(self.report.contraction);
        let rescued = self.iterate(sides, Mode::RollBack, limit).map_err(|error| wild.unwrap_or(error))?;
        Ok(StepInfo {
            iterations: info.iterations + rescued.iterations,
            train_track_trials: info.train_track_trials + rescued.train_track_trials,
            roll_backs: info.roll_backs + 1 + rescued.roll_backs,
            rescues: 1,
            ..rescued
        })
    }

    /// ρ of a step that does not converge; or that the bridge does not come back to its state, which may be why.
    fn diagnose(&mut self, sides: &mut Sides) -> Result<f64, IterationError> {
        self.trial(sides)?;
        self.repeated.copy_from_slice(&self.exchange.motion);
        let rho = self.contraction(sides)?;
        self.audit(sides)?;
        Ok(rho)
    }

    /// Counts the work of a step that is about to be accepted.
    pub(crate) fn account(&mut self, sides: &mut Sides) -> Result<Work, IterationError> {
        let Exchange { now, motion, .. } = &self.exchange;
        self.displacements.moved(now, motion, &mut self.moved);
        let ends = |before, after| if self.settings.mean_forces { [after, after] } else { [before, after] };
        let step = work::Step {
            sent: ends(self.forces.now(), &self.lambda[..]),
            answered: ends(&self.answer_before[..], &self.answer[..]),
            moved: &self.moved,
            given: sides.train_track.work()?,
        };
        let work = step.work();
        self.answer_before.copy_from_slice(&self.answer);
        self.report.work += work;
        Ok(work)
    }

    /// Notes the method in force from `t` on.
    fn note(&mut self, t: f64) {
        self.report.switches.push((t, self.strategy.method()));
    }
}
