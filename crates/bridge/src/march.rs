//! From one state to the next: sub-steps, what inputs mean over a step, and the bases kept for repetitions.
//!
//! Over a macro step [t, t + h] of m sub-steps of τ = h/m, i = 1 … m, with f_n the end force of the step before:
//!
//! ```text
//! with rates    f(t + iτ) = v + iτ v̇                        the polynomial at the sub-step's end
//! held, mean    f(t + iτ) = 2v − f(t + (i−1)τ),  f(t) = f_n   v is the sub-step's mean
//! held, end     f(t + iτ) = f_n + (v − f_n) i/m               v is the value at the end
//! ```
//!
//! For γ = 1/2, β = 1/4 the line of the mean is the trapezoidal rule in (u, u̇) under the mean force v: u and u̇ are second
//! order whatever f_n was. ü then rings about its mean and is no output; (u̇(t + h) − u̇(t))/h is.

use std::sync::Arc;

use ttb_contract::ModelError;
use ttb_dynamics::newmark::Motion;
use ttb_dynamics::pool::Pool;
use ttb_scenario::limits::MOST_SUBSTEPS;

use crate::interface::Held;
use crate::law::Law;
use crate::prepared::Prepared;
use crate::state::{Data, Pending, State};
use crate::steps::Steps;
use crate::structure::Structure;
use crate::system::{Base, Step, Work};

/// Bases kept: that of the step being repeated, and that of the state of rest where directional derivatives start.
const KEPT: usize = 2;

/// Support forces over a macro step.
#[derive(Clone, Copy, Debug)]
pub struct Forces<'a> {
    /// The value v of every support force, N.
    pub values: &'a [f64],
    /// v̇, N/s; `None`: held.
    pub rates: Option<&'a [f64]>,
    /// What a held value means.
    pub held: Held,
}

impl Forces<'_> {
    /// Whether the forces at the end of the step are known ones, not those that a mean asks for: then the acceleration there
    /// is an output.
    pub fn end_is_known(&self) -> bool {
        self.rates.is_some() || self.held == Held::End
    }
}

/// What the outside sees of a macro step.
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// R u, R u̇, R ü at its end; of the supports' ü nothing is asked.
    pub end: Motion,
    /// R u̇ at its begin; of the supports' nothing is asked.
    pub velocity_before: Vec<f64>,
}

/// A kept base: the state and step size that it belongs to. Holding the state keeps its buffer from being reused, so the
/// pointer identifies it.
struct Kept {
    state: State,
    size: f64,
    base: Arc<Base>,
}

/// The end of a step and the begin of the next, to be computed.
pub struct Owed {
    /// The state at that moment; a step is pending.
    pub state: State,
    /// Size of the next step, s.
    pub size: f64,
    /// Its base, with no other holder.
    pub next: Arc<Base>,
}

/// Steps a structure under a law.
pub struct March {
    law: Law,
    /// How macro steps divide, and the factorised sizes in use.
    pub steps: Steps,
    kept: Vec<Kept>,
    bases: Pool<Base>,
    work: Work,
    /// What the outside sees of the last step.
    pub seen: Seen,
}

impl March {
    /// Nothing factorised yet.
    pub fn new(law: Law) -> Self {
        let (kept, bases) = (Vec::with_capacity(KEPT), Pool::default());
        Self { law, steps: Steps::default(), kept, bases, work: Work::default(), seen: Seen::default() }
    }

    /// The law in force.
    pub fn law(&self) -> &Law {
        &self.law
    }

    /// Changes law, nominal step and Newmark parameters, and factorises for the nominal step.
    ///
    /// # Errors
    /// K̂ is not positive definite; everything is then as before.
    pub fn set(&mut self, prepared: &Prepared, law: Law, [nominal, gamma, beta]: [f64; 3]) -> Result<(), ModelError> {
        let mut steps = Steps::new(nominal, gamma, beta);
        steps.get(nominal, prepared, &law)?;
        (self.law, self.steps) = (law, steps);
        self.kept.clear();
        Ok(())
    }

    /// The base of a step of `size` from `state`.
    fn base(&mut self, step: &Arc<dyn Step>, state: &State, size: f64) -> Arc<Base> {
        if let Some(at) = self.kept.iter().position(|k| Arc::ptr_eq(&k.state, state) && k.size == size) {
            self.kept[..=at].rotate_right(1);
            return Arc::clone(&self.kept[0].base);
        }
        let base = self.new_base(|base, work| match &state.pending {
            Some(before) if Arc::ptr_eq(&before.step, step) => step.proceed(&before.base, &state.force, base, work),
            _ => {
                state.complete(&mut base.motion, work);
                step.begin(base, work);
            }
        });
        self.remember(Kept { state: Arc::clone(state), size, base: Arc::clone(&base) });
        base
    }

    /// What is left of the step that led to `state`, if its end and the begin of the next one are still to be computed.
    pub fn owed(&mut self, state: &State) -> Option<Owed> {
        let Pending { step, .. } = state.pending.as_ref()?;
        let size = self.steps.size(step)?;
        let begun = |kept: &Kept| Arc::ptr_eq(&kept.state, state) && kept.size == size;
        if self.kept.iter().any(begun) {
            return None;
        }
        let next = self.bases.take(Base::default);
        Some(Owed { state: Arc::clone(state), size, next })
    }

    /// Keeps what was owed, once somebody has computed it.
    pub fn keep(&mut self, Owed { state, size, next: base }: Owed) {
        self.bases.give(&base);
        self.remember(Kept { state, size, base });
    }

    fn remember(&mut self, kept: Kept) {
        self.kept.truncate(KEPT - 1);
        self.kept.insert(0, kept);
    }

    fn new_base(&mut self, fill: impl FnOnce(&mut Base, &mut Work)) -> Arc<Base> {
        let mut base = self.bases.take(Base::default);
        if let Some(own) = Arc::get_mut(&mut base) {
            fill(own, &mut self.work);
        }
        self.bases.give(&base);
        base
    }

    /// From `old` over `h` seconds; `new` is overwritten.
    ///
    /// # Errors
    /// Far too many sub-steps, or a new size cannot be factorised.
    pub fn run(
        &mut self,
        prepared: &Prepared,
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
        let structure = &prepared.structure;
        let step = self.steps.get(size, prepared, &self.law)?;
        new.force.clone_from(&old.force);
        new.pending = None;
        let mut base = self.base(&step, old, size);
        self.seen.velocity_before(structure, &*step, &base);
        for i in 1..=count {
            if i > 1 {
                base = self.new_base(|base, work| {
                    std::mem::swap(&mut base.motion, &mut new.motion);
                    step.begin(base, work);
                });
            }
            match forces.rates {
                Some(rates) => {
                    let time = if i == count { h } else { i as f64 * size };
                    let ends = forces.values.iter().zip(rates).map(|(v, rate)| v + time * rate);
                    new.force.iter_mut().zip(ends).for_each(|(f, end)| *f = end);
                }
                None if forces.held == Held::End => {
                    let part = i as f64 / count as f64;
                    let ends = old.force.iter().zip(forces.values).map(|(begin, v)| begin + part * (v - begin));
                    new.force.iter_mut().zip(ends).for_each(|(f, end)| *f = end);
                    if i == count {
                        new.force.copy_from_slice(forces.values);
                    }
                }
                None => new.force.iter_mut().zip(forces.values).for_each(|(f, v)| *f = 2.0 * v - *f),
            }
            match step.compliance() {
                Some(compliance) if i == count => {
                    base.answer(compliance, step.newmark(), &new.force, &mut self.seen.end);
                    new.pending = Some(Pending { base: Arc::clone(&base), step: Arc::clone(&step) });
                }
                _ => step.finish(&base, &new.force, &mut new.motion, &mut self.work),
            }
        }
        if new.pending.is_none() {
            self.seen.read(structure, &new.motion);
        }
        Ok(())
    }
}

impl Seen {
    /// Reads a motion of all unknowns.
    pub fn read(&mut self, structure: &Structure, motion: &Motion) {
        let rows = &structure.rows;
        [&mut self.end.u, &mut self.end.v, &mut self.end.a].into_iter().for_each(|x| x.resize(rows.len(), 0.0));
        rows.multiply(&motion.u, &mut self.end.u);
        rows.multiply(&motion.v, &mut self.end.v);
        for i in structure.supports..rows.len() {
            self.end.a[i] = rows.dot(i, &motion.a);
        }
    }

    fn velocity_before(&mut self, structure: &Structure, step: &dyn Step, base: &Base) {
        let rows = &structure.rows;
        self.velocity_before.resize(rows.len(), 0.0);
        if step.compliance().is_some() {
            self.velocity_before[structure.supports..].copy_from_slice(&base.before);
        } else {
            for i in structure.supports..rows.len() {
                self.velocity_before[i] = rows.dot(i, &base.motion.v);
            }
        }
    }
}
