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
//! Deck and track never part; G − λ, the force that is missing, is the error estimate. The scheme is stable as long as ρ,
//! the contraction of the iteration it stands for, is small. ρ is measured before the first step: by the bridge's
//! directional derivatives, or by other instances of it that are thrown away. A residual that grows tells in any case.

use crate::dense::{dot, norm};
use crate::exchange::Sides;
use crate::iteration::Coupling;
use crate::report::{IterationError, Outcome, StepInfo};
use crate::settings::Method;

/// Largest ρ at the start for which the steps are taken. Without a train they are stable up to .25 at least; a train on
/// the bridge raises ρ.
pub const STABLE: f64 = 0.1;
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
}

impl Coupling {
    /// One step without roll-back of the bridge.
    pub(crate) fn explicit_step(&mut self, sides: &mut Sides) -> Result<StepInfo, IterationError> {
        let n = self.lambda.len();
        let half = self.exchange.now.len() / 2;
        if !self.explicit.begun {
            self.explicit.prediction.resize(n, 0.0);
            self.explicit.error.resize(n, 0.0);
            self.explicit.velocity.extend_from_slice(&self.exchange.now[half..]);
            (self.explicit.h, self.explicit.begun) = (sides.h, true);
            self.refuse_strong(sides)?;
        }
        sides.train_track.save()?;
        sides.train_track.restore()?;
        self.extrapolate(sides.h);
        let mut prediction = std::mem::take(&mut self.explicit.prediction);
        let predicted = self.exchange.train_track(sides, &mut prediction, true);
        self.explicit.prediction = prediction;
        predicted?;
        for ((l, p), e) in self.lambda.iter_mut().zip(&self.explicit.prediction).zip(&self.explicit.error) {
            *l = p + e;
        }
        self.exchange.bridge(sides, self.forces.now(), &self.lambda, false)?;
        sides.train_track.restore()?;
        self.exchange.train_track(sides, &mut self.answer, false)?;
        let residual = self.residual();
        if residual.is_nan() || residual > BLOWN {
            return Err(IterationError::Unstable { t: sides.t, h: sides.h, rho: self.report.contraction, residual });
        }
        let most = self.report.explicit.get_or_insert_default();
        *most = most.max(residual);
        let work = self.account(sides)?;
        let explicit = &mut self.explicit;
        for ((e, g), p) in explicit.error.iter_mut().zip(&self.answer).zip(&explicit.prediction) {
            *e = g - p;
        }
        explicit.velocity.copy_from_slice(&self.exchange.now[half..]);
        explicit.h = sides.h;
        self.forces.accept(&self.lambda, sides.h);
        self.exchange.accept();
        let (outcome, method) = (Outcome::Explicit, Method::Explicit);
        let trials = StepInfo { iterations: 1, train_track_trials: 2, ..StepInfo::default() };
        Ok(StepInfo { outcome, method, residual, work, ..trials })
    }

    /// The deck's motion at the end of the step, with the mean acceleration of the step before.
    fn extrapolate(&mut self, h: f64) {
        let half = self.exchange.now.len() / 2;
        let (d, v) = self.exchange.now.split_at(half);
        let (to_d, to_v) = self.exchange.motion.split_at_mut(half);
        for (i, (d, v)) in d.iter().zip(v).enumerate() {
            let a = (v - self.explicit.velocity[i]) / self.explicit.h;
            to_d[i] = d + h * (v + 0.5 * h * a);
            to_v[i] = v + h * a;
        }
    }

    /// Refuses a ρ above [`STABLE`], if ρ can be known before the first step.
    fn refuse_strong(&mut self, sides: &mut Sides) -> Result<(), IterationError> {
        let rho = if sides.bridge.can_roll_back() {
            sides.save()?;
            self.lambda.copy_from_slice(self.forces.now());
            let rho = self.contraction(sides)?;
            sides.restore()?;
            Some(rho)
        } else {
            self.contraction_apart(sides)?
        };
        self.report.contraction = rho;
        match rho {
            Some(rho) if rho > STABLE => {
                Err(IterationError::Unstable { t: sides.t, h: sides.h, rho: Some(rho), residual: 0.0 })
            }
            _ => Ok(()),
        }
    }

    /// ρ as in [`Coupling::contraction`], without a step of the bridge: by its directional derivatives or by trial instances,
    /// and the train–track subsystem's trials. None if it has neither, or refuses them before its first step.
    fn contraction_apart(&mut self, sides: &mut Sides) -> Result<Option<f64>, IterationError> {
        let n = self.lambda.len();
        let scale = crate::identify::PROBE * self.settings.force_scale;
        let share = self.exchange.share_of_force(sides.bridge);
        let (mut v, mut base, mut change) = (vec![0.0; n], vec![0.0; n], vec![0.0; self.exchange.now.len()]);
        sides.train_track.save()?;
        self.exchange.motion.clone_from(&self.exchange.now);
        self.exchange.train_track(sides, &mut base, true)?;
        // Derivatives are those for inputs as they will be given.
        self.exchange.announce(sides, self.forces.now(), self.forces.now())?;
        v.iter_mut().enumerate().for_each(|(i, v)| *v = crate::identify::shape(i));
        let (mut rho, mut at_rest) = (None, None);
        for _ in 0..crate::identify::POWER {
            let size = norm(&v);
            if !(size > 0.0 && size.is_finite()) {
                break;
            }
            let factor = scale * (n as f64).sqrt() / size;
            v.iter_mut().for_each(|v| *v *= factor);
            let known = if sides.bridge.can_derive() {
                v.iter_mut().for_each(|v| *v *= share);
                sides.bridge.derivative(&v, &mut change).is_ok()
            } else {
                self.change_apart(sides, &v, &mut at_rest, &mut change)?
            };
            if !known {
                break;
            }
            let moved = self.exchange.motion.iter_mut().zip(&self.exchange.now).zip(&change);
            moved.for_each(|((m, now), c)| *m = now + c);
            sides.train_track.restore()?;
            self.exchange.train_track(sides, &mut self.answer, true)?;
            v.iter_mut().zip(&self.answer).zip(&base).for_each(|((v, g), base)| *v = (g - base) / factor);
            rho = Some(dot(&v, &v).sqrt() / size);
        }
        sides.train_track.restore()?;
        Ok(rho)
    }

    /// What a change of the forces changes of the motion after a step, seen on trial instances; `at_rest` keeps the motion
    /// without it.
    fn change_apart(
        &mut self,
        sides: &mut Sides,
        force: &[f64],
        at_rest: &mut Option<Vec<f64>>,
        change: &mut [f64],
    ) -> Result<bool, IterationError> {
        if at_rest.is_none() {
            *at_rest = self.step_apart(sides, &vec![0.0; force.len()])?;
        }
        let (Some(base), Some(motion)) = (at_rest, self.step_apart(sides, force)?) else { return Ok(false) };
        change.iter_mut().zip(&motion).zip(base).for_each(|((c, m), b)| *c = m - *b);
        Ok(true)
    }

    /// The motion after a step of an trial_instance under the forces at hand and `force`.
    fn step_apart(&mut self, sides: &mut Sides, force: &[f64]) -> Result<Option<Vec<f64>>, IterationError> {
        let now = self.forces.now();
        let Some(mut bridge) = sides.bridge.trial_instance(now)? else { return Ok(None) };
        let after: Vec<f64> = now.iter().zip(force).map(|(now, force)| now + force).collect();
        let (train_track, bridge, t, h) = (&mut *sides.train_track, &mut *bridge, sides.t, sides.h);
        self.exchange.bridge(&mut Sides { train_track, bridge, t, h }, now, &after, false)?;
        Ok(Some(self.exchange.motion.clone()))
    }
}
