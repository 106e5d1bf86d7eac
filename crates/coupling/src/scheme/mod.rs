//! The hybrid solution algorithm: track–bridge force compatibility, iterated at every macro step.
//!
//! λ are the support forces, d and ḋ the deck's motion under the supports. One step [t_n, t_n + h]:
//!
//! ```text
//! 0  save both states
//! 1  λ⁰ ← predict(λ_n, λ_{n−1}, …)
//! 2  trials until both sides agree                                        step.rs
//! 3  not converged: once more by quasi-Newton with an empty memory;
//!    then in two halves, or stop                                          halving.rs
//! ```
//!
//! A subsystem that cannot interpolate its inputs gets the mean over the step, held: (λ_n + λ^{k−1})/2. Both ways the
//! converged step *is* the monolithic one, to the tolerance, for subsystems that integrate by the trapezoidal rule; a
//! held end value would be first order only. Nothing here is allocated in a step.
//!
//! A bridge that cannot roll back is stepped once ([`explicit`]); with `max_iterations = 1` so are both sides.

mod account;
mod audit;
pub mod explicit;
mod halving;
mod shared;
mod step;

use std::ops::Range;

use ttb_contract::{Ports, Subsystem};

use crate::error::IterationError;
use crate::probe::{Probe, rehearse};
use crate::report::{Outcome, Report, StepInfo};
use crate::settings::{Method, OnFailure, Settings};
use crate::trial::{Factors, Scaled, Sides};
use explicit::Explicit;
use shared::Shared;
use step::Mode;

/// Trials of the static iteration at least: it needs no roll-back, and a one-pass run must start from equilibrium too.
const STATIC_TRIALS: usize = 30;

/// The coupling of one train–track subsystem with one bridge.
pub struct Coupling {
    shared: Shared,
    explicit: Explicit,
    /// Of ports in several units.
    factors: Option<[Factors; 2]>,
}

impl Coupling {
    /// Over some ports, which also say in which order forces and motions stand.
    pub fn new(ports: Ports, settings: Settings) -> Self {
        let factors = Factors::of(&ports);
        Self { shared: Shared::new(ports, settings), explicit: Explicit::default(), factors }
    }

    /// Where the two sides touch.
    pub fn ports(&self) -> &Ports {
        self.shared.iteration.trials.exchange.ports()
    }

    /// Accepted forces at t_n, or means over the step that ended there, all in the unit of the first port.
    pub fn forces(&self) -> &[f64] {
        self.shared.iteration.trials.forces.now()
    }

    /// What was found out besides the steps.
    pub fn report(&self) -> &Report {
        &self.shared.report
    }

    /// The method in force from step to step, never `Auto`.
    pub fn method(&self) -> Method {
        self.shared.iteration.strategy.method()
    }

    /// Static force compatibility in initialization mode, then the end of initialization. The run begins with what both
    /// sides answer after it.
    ///
    /// # Errors
    /// A subsystem fails, or the static iteration does not converge under the policy `Stop` or `Halve`.
    pub fn initialise(
        &mut self,
        train_track: &mut dyn Subsystem,
        bridge: &mut dyn Subsystem,
        t: f64,
    ) -> Result<StepInfo, IterationError> {
        self.between(train_track, bridge, [t, 0.0], |own, sides| {
            let iteration = &mut own.shared.iteration;
            let settings = iteration.settings;
            iteration.strategy.begin_static();
            let info = iteration.iterate(sides, Mode::Equilibrium, settings.max_iterations.max(STATIC_TRIALS))?;
            iteration.strategy.end_static();
            if info.outcome == Outcome::IterationLimit && settings.on_failure != OnFailure::Accept {
                return Err(IterationError::NotConverged { t, h: 0.0, info: Box::new(info), rho: None });
            }
            sides.train_track.exit_initialization()?;
            sides.bridge.exit_initialization()?;
            iteration.trials.start(sides)?;
            own.shared.account.start(&iteration.trials.answer);
            Ok(info)
        })
    }

    /// Tries both sides between initialization and the first step: `steps` steps of `h` seconds from `t`. Afterwards they are
    /// where they were. `groups` are the ports, by position, that act on a deck of their own each.
    ///
    /// # Errors
    /// A subsystem fails or answers NaN.
    pub fn probe(
        &mut self,
        train_track: &mut dyn Subsystem,
        bridge: &mut dyn Subsystem,
        groups: &[Range<usize>],
        [t, h]: [f64; 2],
        steps: usize,
    ) -> Result<Probe, IterationError> {
        self.between(train_track, bridge, [t, h], |own, sides| {
            rehearse(&mut own.shared.iteration.trials, sides, groups, steps)
        })
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
        self.between(train_track, bridge, [t, h], |own, sides| {
            let Settings { max_iterations, method, .. } = own.shared.iteration.settings;
            if max_iterations == 1 {
                one_pass(&mut own.shared, sides)
            } else if method == Method::Explicit || !sides.bridge.can_roll_back() {
                own.explicit.step(&mut own.shared, sides)
            } else {
                halving::step(&mut own.shared, sides, 0)
            }
        })
    }

    /// Calls with both sides, behind their factors where ports have several units.
    fn between<T>(
        &mut self,
        train_track: &mut dyn Subsystem,
        bridge: &mut dyn Subsystem,
        [t, h]: [f64; 2],
        call: impl FnOnce(&mut Self, &mut Sides) -> T,
    ) -> T {
        let Some([of_track, of_bridge]) = self.factors.take() else {
            return call(self, &mut Sides { train_track, bridge, t, h });
        };
        let (mut train_track, mut bridge) = (Scaled::new(train_track, of_track), Scaled::new(bridge, of_bridge));
        let answer = call(self, &mut Sides { train_track: &mut train_track, bridge: &mut bridge, t, h });
        self.factors = Some([train_track.into_factors(), bridge.into_factors()]);
        answer
    }
}

/// Bridge first under the extrapolated forces, once; nothing but the answer carries the train's forces on.
fn one_pass(shared: &mut Shared, sides: &mut Sides) -> Result<StepInfo, IterationError> {
    let iteration = &mut shared.iteration;
    iteration.begin(sides.h);
    let info = iteration.iterate(sides, Mode::OnePass, 1)?;
    if info.outcome != Outcome::Converged && iteration.settings.on_failure != OnFailure::Accept {
        return Err(IterationError::NotConverged { t: sides.t, h: sides.h, info: Box::new(info), rho: None });
    }
    let work = shared.accept(sides, true)?;
    Ok(StepInfo { work, ..info })
}
