//! The equations of motion M ü + C u̇ + K u = f, cut for Newmark's method so that the solver can be exchanged.
//!
//! ```text
//! K = k K₀,  M = m M₀              k, m: factors on stiffness and mass
//! C = αM + βK + C₀                 Rayleigh and dashpots, or MΦ diag(2ζω) ΦᵀM over the lowest modes
//! u₁ = K̂⁻¹ (p + Bᵀf₁) + g          p, g: what a step owes to the state it starts from
//! r₁ = R u₁ = r⁰ + S f₁            S = R K̂⁻¹ Bᵀ: the compliance between all that the outside sees
//! ṙ₁ = ṙ⁰ + a₁ S f₁,  r̈₁ = r̈⁰ + a₀ S f₁
//! ```
//!
//! B are the rows of the supports; R those of the supports and of the monitored points, of which alone r̈ is asked. A
//! [`Base`] holds p, g and r⁰: it serves every repetition of a step from the same state. A small system answers a repetition with a solve. A large one
//! answers with S alone, a dense product, and u₁ waits until the next step asks for it: one sparse solve a step, however
//! often the step is repeated.
//!
//! A [`System`] holds what no parameter touches (K₀, M₀, modes); a [`Step`] what belongs to one step size. There are two:
//! all degrees of freedom ([`crate::full`]) and coordinates that stand alone ([`crate::reduced`]).

use std::sync::Arc;

use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_sparse::FactorError;

use crate::compliance::Compliance;
use crate::law::Law;
use crate::rows::Rows;

/// What a step owes to the state it starts from. Vectors that a system does not need stay empty.
#[derive(Clone, Debug, Default)]
pub struct Base {
    /// u, u̇, ü at the step's begin.
    pub motion: Motion,
    /// p, as the system keeps it.
    pub load: Vec<f64>,
    /// The known part g of the motion at the step's end.
    pub known: Vec<f64>,
    /// Φᵀp, with modal damping.
    pub amplitudes: Vec<f64>,
    /// r⁰, ṙ⁰ and, of the monitored points, r̈⁰: what is seen at the step's end without forces.
    pub free: Motion,
    /// R u̇ of the monitored points at the step's begin.
    pub before: Vec<f64>,
}

impl Base {
    /// r₁, ṙ₁ and, of the monitored points, r̈₁ under the forces f₁ through S.
    pub fn answer(&self, compliance: &Compliance, newmark: &Newmark, forces: &[f64], end: &mut Motion) {
        let (rows, monitors) = (self.free.u.len(), self.free.a.len());
        let [a0, a1, ..] = newmark.a;
        [&mut end.u, &mut end.v, &mut end.a].into_iter().for_each(|r| r.resize(rows, 0.0));
        compliance.multiply(forces, &mut end.u);
        let moved = &end.u;
        end.v.iter_mut().zip(&self.free.v).zip(moved).for_each(|((v, free), r)| *v = free + a1 * r);
        let monitored = rows - monitors..;
        let a = end.a[monitored.clone()].iter_mut().zip(&self.free.a).zip(&moved[monitored]);
        a.for_each(|((a, free), r)| *a = free + a0 * r);
        end.u.iter_mut().zip(&self.free.u).for_each(|(u, free)| *u += free);
    }
}

impl Base {
    /// From R K̂⁻¹p in `free.u` to r⁰, with ṙ⁰ and r̈⁰ that belong to it; B are the first `supports` of the rows R.
    pub fn see(&mut self, rows: &Rows, newmark: &Newmark, supports: usize) {
        let Self { motion: Motion { u, v, a }, known, free, before, .. } = self;
        [&mut free.v, &mut free.a, before].into_iter().for_each(Vec::clear);
        for (i, r) in free.u.iter_mut().enumerate() {
            *r += rows.dot(i, known);
            let [u, v, a] = [&*u, v, a].map(|x| rows.dot(i, x));
            let (velocity, acceleration) = newmark.finish(*r, u, v, a);
            free.v.push(velocity);
            if i >= supports {
                free.a.push(acceleration);
                before.push(v);
            }
        }
    }
}

/// A step that one of several bridges over this structure finishes while it begins the next.
pub struct Lane<'a> {
    /// The base of the step that ends.
    pub base: &'a Base,
    /// The forces at its end.
    pub forces: &'a [f64],
    /// That of the step that begins.
    pub next: &'a mut Base,
}

/// Buffers of a step.
#[derive(Clone, Debug, Default)]
pub struct Work {
    /// One number an unknown.
    pub x: Vec<f64>,
    /// One number an unknown.
    pub y: Vec<f64>,
    /// Room for the sweeps over the factor.
    pub buffer: Vec<f64>,
}

/// A structure's equations.
pub trait System: Send + Sync {
    /// Number of unknowns.
    fn unknowns(&self) -> usize;

    /// Static solution: `x` holds the load and receives u.
    ///
    /// # Errors
    /// K is not positive definite.
    fn statics(&self, law: &Law, x: &mut [f64]) -> Result<(), FactorError>;

    /// Static solutions are not needed for a while.
    fn rest_statics(&self) {}

    /// Factorises for one step size; R are all rows, B the first `supports` of them.
    ///
    /// # Errors
    /// K̂ is not positive definite.
    fn prepare(
        self: Arc<Self>,
        law: &Law,
        newmark: Newmark,
        rows: &Arc<Rows>,
        supports: usize,
    ) -> Result<Arc<dyn Step>, FactorError>;
}

/// A factorised step; allocates nothing once its buffers have grown.
pub trait Step: Send + Sync {
    /// Newmark's constants.
    fn newmark(&self) -> &Newmark;

    /// Fills a base from its motion.
    fn begin(&self, base: &mut Base, work: &mut Work);

    /// S, where repetitions go through it.
    fn compliance(&self) -> Option<&Compliance>;

    /// u₁ under the forces f₁.
    fn solve(&self, base: &Base, forces: &[f64], u: &mut Vec<f64>, work: &mut Work);

    /// The motion at the step's end under the forces f₁.
    fn finish(&self, base: &Base, forces: &[f64], end: &mut Motion, work: &mut Work) {
        self.solve(base, forces, &mut end.u, work);
        let n = end.u.len();
        [&mut end.v, &mut end.a].into_iter().for_each(|x| x.resize(n, 0.0));
        self.newmark().finish_all(&base.motion, end);
    }

    /// Finishes a step and begins the next of the same size, `next`.
    fn proceed(&self, base: &Base, forces: &[f64], next: &mut Base, work: &mut Work) {
        self.finish(base, forces, &mut next.motion, work);
        self.begin(next, work);
    }

    /// [`Step::proceed`] of several bridges. What a lane gets does not depend on the others.
    fn proceed_abreast(&self, lanes: &mut [Lane], work: &mut Work) {
        lanes.iter_mut().for_each(|lane| self.proceed(lane.base, lane.forces, lane.next, work));
    }
}
