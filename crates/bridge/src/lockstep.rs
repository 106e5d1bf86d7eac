//! Several runs over one bridge in lockstep, for sweeps: [`RUNS`] of them share one reading of the factor.
//!
//! ```text
//! begin    y = L⁻¹ p  of all runs           one sweep over L for all
//! trial    r₁ = r⁰ + S f₁                   each run by itself, as often as it likes
//! finish   u₁ = L⁻ᵀ (y + L⁻¹ Bᵀf₁) + g      one sweep over L for all
//! ```
//!
//! The runs may differ in train, speed and track; step size and bridge are the same. Everything stands in the order of
//! elimination, in groups of [`LANES`] runs, number i of all of a group side by side. Rayleigh damping or none
//! ([`crate::full`] has the equations).

use ttb_contract::ModelError;
use ttb_dynamics::dense::Dense;
use ttb_dynamics::newmark::Newmark;
use ttb_sparse::Factor;
use ttb_sparse::sweeps::{LANES, Which};
use ttb_sparse::{Pencil, Product};

use crate::law::Law;
use crate::lazy::Lazy;
use crate::rows::Rows;

/// Groups of runs: L is read once for all, and once more from near for each.
const GROUPS: usize = 2;
/// Runs in lockstep.
pub const RUNS: usize = GROUPS * LANES;

/// Motion and bases of [`RUNS`] runs.
pub struct Lockstep {
    factor: Factor,
    lazy: Lazy,
    mass: Product,
    newmark: Newmark,
    /// m, α′ and kβ/c_K of [`crate::full`].
    constants: [f64; 3],
    u: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    y: Vec<f64>,
    known: Vec<f64>,
    work: Vec<f64>,
    buffer: Vec<f64>,
    /// r⁰ by groups, row by row.
    free: Vec<f64>,
}

impl Lockstep {
    /// All runs at rest; B are the first `supports` of the `rows`.
    ///
    /// # Errors
    /// A small bridge, which has no panels to share; dashpots; K̂ is not positive definite.
    pub fn new(pencil: &Pencil, law: &Law, newmark: Newmark, rows: &Rows, supports: usize) -> Result<Self, ModelError> {
        let [c_k, c_m] = law.effective(&newmark);
        let factor = pencil.factor(c_k, c_m, newmark.a[1]).map_err(|e| ModelError(format!("bridge: {e}")))?;
        let lazy = Lazy::new(&factor, rows, supports, &[], &[]);
        let (Some(lazy), Some((pattern, _))) = (lazy, factor.panels()) else {
            return Err(ModelError("bridge: too small for runs in lockstep".into()));
        };
        if pencil.has_dashpots() || !law.rates.is_empty() {
            return Err(ModelError("bridge: runs in lockstep take Rayleigh damping only".into()));
        }
        let mass = pencil.mass_in(&pattern.position);
        let [alpha, _, share] = law.history(&newmark);
        let constants = [law.mass, alpha, share];
        let zeros = vec![0.0; pattern.order.len() * RUNS];
        let [u, v, a, y, known, work] = std::array::from_fn(|_| zeros.clone());
        let free = vec![0.0; rows.len() * RUNS];
        Ok(Self { factor, lazy, mass, newmark, constants, u, v, a, y, known, work, buffer: Vec::new(), free })
    }

    /// Begins a step of all runs.
    pub fn begin(&mut self) {
        let Some((pattern, numbers)) = self.factor.panels() else { return };
        let [mass, alpha, share] = self.constants;
        let motion = self.u.iter().zip(&self.v).zip(&self.a);
        for ((inertia, known), ((u, v), a)) in self.work.iter_mut().zip(&mut self.known).zip(motion) {
            let q = self.newmark.damping(*u, *v, *a);
            *inertia = mass * (self.newmark.inertia(*u, *v, *a) + alpha * q);
            *known = share * q;
        }
        self.y.fill(0.0);
        self.mass.add_many(&self.work, &mut self.y);
        pattern.forward_many(numbers, &mut self.y, &mut self.buffer, Which::All);
        self.work.copy_from_slice(&self.y);
        pattern.backward_many(numbers, &mut self.work, &mut self.buffer, Which::Some(self.lazy.reach()));
        self.work.iter_mut().zip(&self.known).for_each(|(x, g)| *x += g);
        let (of_work, of_free) = (self.work.len() / GROUPS, self.free.len() / GROUPS);
        let groups = self.work.chunks_exact(of_work).zip(self.free.chunks_exact_mut(of_free));
        groups.for_each(|(x, r)| self.lazy.see_many(x, r));
    }

    /// r₁ of one run under its forces f₁, between `begin` and `finish`.
    pub fn trial(&self, run: usize, forces: &[f64], r: &mut [f64]) {
        self.compliance().multiply(forces, r);
        let group = self.free.chunks_exact(self.free.len() / GROUPS).nth(run / LANES).unwrap_or_default();
        r.iter_mut().zip(group.chunks_exact(LANES)).for_each(|(r, free)| *r += free[run % LANES]);
    }

    /// S: what the outside sees of unit forces on the supports.
    pub fn compliance(&self) -> &Dense {
        self.lazy.compliance()
    }

    /// Ends the step with the forces of every run.
    pub fn finish(&mut self, forces: [&[f64]; RUNS]) {
        let Some((pattern, numbers)) = self.factor.panels() else { return };
        self.work.fill(0.0);
        let of_work = self.work.len() / GROUPS;
        let groups = self.work.chunks_exact_mut(of_work).zip(forces.as_chunks().0);
        groups.for_each(|(x, forces)| self.lazy.load_many(forces, x));
        pattern.forward_many(numbers, &mut self.work, &mut self.buffer, Which::Some(self.lazy.support_reach()));
        self.y.iter_mut().zip(&self.work).for_each(|(y, x)| *y += x);
        pattern.backward_many(numbers, &mut self.y, &mut self.buffer, Which::All);
        let motion = self.u.iter_mut().zip(&mut self.v).zip(&mut self.a);
        for (((u, v), a), (x, g)) in motion.zip(self.y.iter().zip(&self.known)) {
            let u1 = x + g;
            (*v, *a) = self.newmark.finish(u1, *u, *v, *a);
            *u = u1;
        }
    }
}
