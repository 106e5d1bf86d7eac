//! From one state to the next: sub-steps, what inputs mean over a step, and the history kept for repetitions.
//!
//! Over a macro step [t, t + h] of m sub-steps of τ = h/m, i = 1 … m, with f_n the end force of the step before:
//!
//! ```text
//! with rates    f(t + iτ) = v + iτ v̇                        the polynomial at the sub-step's end
//! held          f(t + iτ) = 2v − f(t + (i−1)τ),  f(t) = f_n   v is the sub-step's mean
//! ```
//!
//! For γ = 1/2, β = 1/4 the second line is the trapezoidal rule in (u, u̇) under the mean force v: u and u̇ are second
//! order whatever f_n was. ü then rings about its mean and is no output; (u̇(t + h) − u̇(t))/h is.

use std::sync::Arc;

use ttb_coupling::ModelError;
use ttb_dynamics::newmark::Motion;

use crate::state::{Data, State};
use crate::steps::Steps;
use crate::structure::Structure;
use crate::system::{History, Law};

/// More sub-steps than this in one macro step are a mistake.
const MOST_SUBSTEPS: usize = 1_000_000;

/// Support forces over a macro step.
#[derive(Clone, Copy, Debug)]
pub struct Forces<'a> {
    /// v, N.
    pub values: &'a [f64],
    /// v̇, N/s; `None`: held.
    pub rates: Option<&'a [f64]>,
}

/// Steps a structure under a law.
pub struct March {
    law: Law,
    /// Step sizes.
    pub steps: Steps,
    /// History of the first sub-step, and the state and size it belongs to. Holding the state keeps its buffer from
    /// being reused, so the pointer identifies it.
    first: History,
    first_of: Option<(State, f64)>,
    inner: History,
    between: Motion,
}

impl March {
    /// Nothing factorised yet.
    pub fn new(law: Law, unknowns: usize) -> Self {
        Self {
            law,
            steps: Steps::default(),
            first: History::new(unknowns),
            first_of: None,
            inner: History::new(unknowns),
            between: Motion::rest(unknowns),
        }
    }

    /// The law in force.
    pub fn law(&self) -> &Law {
        &self.law
    }

    /// Changes law, nominal step and Newmark parameters, and factorises for the nominal step.
    ///
    /// # Errors
    /// K̂ is not positive definite.
    pub fn set(&mut self, structure: &Structure, law: Law, [nominal, gamma, beta]: [f64; 3]) -> Result<(), ModelError> {
        self.law = law;
        self.first_of = None;
        self.steps.set(nominal, gamma, beta);
        self.steps.get(nominal, &structure.system, &self.law).map(|_| ())
    }

    /// From `old` over `h` seconds; `new` is overwritten.
    ///
    /// # Errors
    /// Far too many sub-steps, or a new size cannot be factorised.
    pub fn run(
        &mut self,
        structure: &Structure,
        old: &State,
        forces: Forces,
        h: f64,
        new: &mut Data,
    ) -> Result<(), ModelError> {
        let (count, size) = self.steps.divide(h);
        if count > MOST_SUBSTEPS {
            let nominal = self.steps.nominal();
            return Err(ModelError(format!(
                "a step of {h} s holds more than {MOST_SUBSTEPS} sub-steps of step_size = {nominal} s"
            )));
        }
        let step = self.steps.get(size, &structure.system, &self.law)?;
        new.force.clone_from(&old.force);
        for i in 1..=count {
            let (history, before) = if i == 1 {
                if !self.first_of.as_ref().is_some_and(|(state, of)| Arc::ptr_eq(state, old) && *of == size) {
                    step.history(&old.motion, &mut self.first);
                    self.first_of = Some((Arc::clone(old), size));
                }
                (&self.first, &old.motion)
            } else {
                std::mem::swap(&mut self.between, &mut new.motion);
                step.history(&self.between, &mut self.inner);
                (&self.inner, &self.between)
            };
            match forces.rates {
                Some(rates) => {
                    let time = if i == count { h } else { i as f64 * size };
                    let ends = forces.values.iter().zip(rates).map(|(v, rate)| v + time * rate);
                    new.force.iter_mut().zip(ends).for_each(|(f, end)| *f = end);
                }
                None => new.force.iter_mut().zip(forces.values).for_each(|(f, v)| *f = 2.0 * v - *f),
            }
            new.motion.u.copy_from_slice(&history.load);
            structure.supports.add_transposed(&new.force, &mut new.motion.u);
            step.solve(history, &mut new.motion.u);
            step.newmark().finish_all(before, &mut new.motion);
        }
        Ok(())
    }
}
