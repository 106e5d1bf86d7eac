//! Steps of a bridge that cannot roll back: each is taken once, the train–track subsystem twice.
//!
//! ```text
//! a  = (ḋ_n − ḋ_{n−1})/h_{n−1}
//! λ̂  = G_T(d_n + h ḋ_n + ½h² a,  ḋ_n + h a)          train–track, on the deck's motion extrapolated
//! λ  = λ̂ + (G_n − λ̂_n)                               what the last prediction was off by
//! d, ḋ ← bridge under λ                              its only step
//! G  = G_T(d, ḋ)                                     train–track again, on the motion that came out
//! ```
//!
//! Deck and track never part; G − λ, the force that is missing, is the error estimate, two ways:
//!
//! ```text
//! ε  = |G − λ|/max(|G|, one axle load)               about the relative error that a step makes in displacements
//! ε_a = α max_i |G_i − λ_i|                          about the error of the deck's accelerations, m/s²
//! ```
//!
//! with α, 1/kg, how far forces accelerate the deck (module `contraction`). Neither is a bound: errors of many steps add up.
//!
//! The scheme is stable as long as ρ, the contraction of the iteration it stands for, is small. ρ and α are measured before
//! the first step: by the bridge's directional derivatives, or by other instances of it that are thrown away. A residual
//! that grows tells in any case.

use ttb_contract::finite::largest;

use crate::error::IterationError;
use crate::probe::apart;
use crate::report::{Outcome, STABLE, StepInfo};
use crate::scheme::shared::Shared;
use crate::settings::Method;
use crate::trial::Sides;

/// A relative residual at which a run is stopped: displacements are off by a percent then, or nothing holds any more.
const BLOWN: f64 = 0.2;

/// What a step hands to the next, and the error estimate.
#[derive(Debug, Default)]
pub(crate) struct Explicit {
    /// λ̂ and what it was off by.
    prediction: Vec<f64>,
    error: Vec<f64>,
    /// ḋ at the beginning of the step before, and its size.
    velocity: Vec<f64>,
    h: f64,
    begun: bool,
    /// α.
    acceleration: Option<f64>,
}

impl Explicit {
    /// One step without roll-back of the bridge.
    pub fn step(&mut self, shared: &mut Shared, sides: &mut Sides) -> Result<StepInfo, IterationError> {
        if !self.begun {
            self.begin(shared, sides)?;
        }
        sides.train_track.save()?;
        sides.train_track.restore()?;
        self.extrapolate(shared, sides.h);
        let trials = &mut shared.iteration.trials;
        trials.exchange.train_track(sides, &mut self.prediction, true)?;
        for ((l, p), e) in trials.lambda.iter_mut().zip(&self.prediction).zip(&self.error) {
            *l = p + e;
        }
        trials.run_bridge(sides, false)?;
        sides.train_track.restore()?;
        trials.run_train_track(sides, false)?;
        let residual = trials.measure();
        if residual.is_nan() || residual > BLOWN {
            let rho = shared.report.contraction;
            return Err(IterationError::Unstable { t: sides.t, h: sides.h, rho, residual });
        }
        for ((e, g), p) in self.error.iter_mut().zip(&trials.answer).zip(&self.prediction) {
            *e = g - p;
        }
        let (now, _) = trials.exchange.parts();
        self.velocity.copy_from_slice(now.rates);
        self.h = sides.h;
        let most = shared.report.explicit.get_or_insert_default();
        *most = most.max(residual);
        if let Some(alpha) = self.acceleration {
            let missing = alpha * largest(trials.residual.iter().map(|force| force.abs()));
            let most = shared.report.explicit_acceleration.get_or_insert_default();
            *most = most.max(missing);
        }
        let work = shared.accept(sides, false)?;
        let (outcome, method) = (Outcome::Explicit, Method::Explicit);
        let trials = StepInfo { iterations: 1, train_track_trials: 2, ..StepInfo::default() };
        Ok(StepInfo { outcome, method, residual, work, ..trials })
    }

    /// Before the first step: room, and a ρ above [`STABLE`] is refused, if ρ can be known.
    fn begin(&mut self, shared: &mut Shared, sides: &mut Sides) -> Result<(), IterationError> {
        let trials = &mut shared.iteration.trials;
        let n = trials.lambda.len();
        self.prediction.resize(n, 0.0);
        self.error.resize(n, 0.0);
        let (now, _) = trials.exchange.parts();
        self.velocity.extend_from_slice(now.rates);
        (self.h, self.begun) = (sides.h, true);
        let strength = if sides.bridge.can_roll_back() {
            sides.save()?;
            trials.lambda.copy_from_slice(trials.forces.now());
            let strength = shared.contraction(sides)?;
            sides.restore()?;
            Some(strength)
        } else {
            apart(trials, sides)?
        };
        let rho = strength.map(|strength| strength.rho);
        self.acceleration = strength.map(|strength| strength.acceleration);
        shared.report.contraction = rho;
        match rho {
            Some(rho) if rho.is_nan() || rho > STABLE => {
                Err(IterationError::Unstable { t: sides.t, h: sides.h, rho: Some(rho), residual: 0.0 })
            }
            _ => Ok(()),
        }
    }

    /// The deck's motion at the end of the step, with the mean acceleration of the step before. What has no rate stays.
    fn extrapolate(&mut self, shared: &mut Shared, h: f64) {
        let (now, motion) = shared.iteration.trials.exchange.parts();
        let with_rate = now.rates.len();
        for (i, (d, v)) in now.positions.iter().zip(now.rates).enumerate() {
            let a = (v - self.velocity[i]) / self.h;
            motion.positions[i] = d + h * (v + 0.5 * h * a);
            motion.rates[i] = v + h * a;
        }
        motion.positions[with_rate..].copy_from_slice(&now.positions[with_rate..]);
        motion.others.copy_from_slice(now.others);
    }
}
