//! Several bridges over one large structure, side by side: L is read once for up to [`RUNS`] of them.
//!
//! ```text
//! end      x = L⁻¹ Bᵀf₁            of all runs: a sweep over the reach of B
//!          u₁ = L⁻ᵀ (y + x) + g    one sweep over L for all
//! begin    y = L⁻¹ p               one sweep over L for all
//!          r⁰ = R (L⁻ᵀy + g)       a sweep over the reach of R
//! ```
//!
//! The runs may differ in train and speed; the forces between the end of one step and the next are each run's own. Right-hand
//! sides stand in the order of elimination, in groups of [`LANES`] runs, number i of all of a group side by side; every run's
//! numbers are computed in one order, whoever its neighbours are. Rayleigh damping or none ([`crate::full`] has the equations).

use ttb_dynamics::newmark::Newmark;
use ttb_sparse::sweeps::{LANES, Which};
use ttb_sparse::{Factor, Product};

use crate::lazy::Lazy;
use crate::rows::Rows;
use crate::system::{Base, Lane, Work};

/// Groups of runs: L is read once for all, and once more from near for each.
const GROUPS: usize = 2;
/// Runs that share one reading of L.
pub const RUNS: usize = GROUPS * LANES;
/// Unknowns that are taken from one arrangement into the other at a time: they stay in the first-level cache.
const BLOCK: usize = 256;

/// What a step of runs side by side needs.
pub struct Lanes<'a> {
    /// K̂.
    pub factor: &'a Factor,
    /// How its solve is split.
    pub lazy: &'a Lazy,
    /// M₀ in the order of elimination.
    pub mass: &'a Product,
    /// R over the degrees of freedom.
    pub rows: &'a Rows,
    /// Newmark's constants.
    pub newmark: &'a Newmark,
    /// m, α′ and kβ/c_K of [`crate::full`].
    pub constants: [f64; 3],
    /// No forces.
    pub zeros: &'a [f64],
}

impl Lanes<'_> {
    /// Ends a step of at most [`RUNS`] runs and begins the next.
    pub fn proceed(&self, lanes: &mut [Lane], work: &mut Work) {
        let Some((pattern, numbers)) = self.factor.panels() else { return };
        let n = pattern.order.len();
        let size = lanes.len().div_ceil(LANES) * n * LANES;
        let Work { x, y, buffer } = work;
        let seen = self.rows.len() * LANES;
        x.resize(size, 0.0);
        y.resize(size.max(seen), 0.0);

        x.fill(0.0);
        for (x, lanes) in x.chunks_exact_mut(n * LANES).zip(lanes.chunks(LANES)) {
            let forces = std::array::from_fn(|l| lanes.get(l).map_or(self.zeros, |lane| lane.forces));
            self.lazy.load_many(&forces, x);
        }
        pattern.forward_many(numbers, x, buffer, Which::Some(self.lazy.support_reach()));
        for (x, lanes) in x.chunks_exact_mut(n * LANES).zip(lanes.chunks(LANES)) {
            in_blocks(n, |i, l| x[i * LANES + l] += lanes[l].base.load[i], lanes.len());
        }
        pattern.backward_many(numbers, x, buffer, Which::All);

        for ((x, y), lanes) in x.chunks(n * LANES).zip(y.chunks_mut(n * LANES)).zip(lanes.chunks_mut(LANES)) {
            self.advance(&pattern.position, x, y, lanes);
        }

        x.fill(0.0);
        self.mass.add_many(&y[..size], x);
        pattern.forward_many(numbers, x, buffer, Which::All);
        for (x, lanes) in x.chunks(n * LANES).zip(lanes.chunks_mut(LANES)) {
            lanes.iter_mut().for_each(|lane| lane.next.load.resize(n, 0.0));
            let count = lanes.len();
            in_blocks(n, |i, l| lanes[l].next.load[i] = x[i * LANES + l], count);
        }
        pattern.backward_many(numbers, x, buffer, Which::Some(self.lazy.reach()));
        for (x, lanes) in x.chunks(n * LANES).zip(lanes.chunks_mut(LANES)) {
            self.lazy.see_many(x, &mut y[..seen]);
            for (l, lane) in lanes.iter_mut().enumerate() {
                let free = &mut lane.next.free.u;
                free.clear();
                free.extend(y[..seen].chunks_exact(LANES).map(|r| r[l]));
                lane.next.see(self.rows, self.newmark, self.lazy.supports());
            }
        }
    }

    /// From L⁻ᵀ(y + x) in `x` to the motions at the step's end, to g there, and to what M₀ multiplies in `inertia`.
    fn advance(&self, position: &[u32], x: &[f64], inertia: &mut [f64], lanes: &mut [Lane]) {
        let [mass, alpha, share] = self.constants;
        let n = position.len();
        for Lane { next: Base { motion, known, amplitudes, .. }, .. } in lanes.iter_mut() {
            amplitudes.clear();
            [&mut motion.u, &mut motion.v, &mut motion.a, known].into_iter().for_each(|x| x.resize(n, 0.0));
        }
        let count = lanes.len();
        let one = |dof: usize, l: usize| {
            let Lane { base: Base { motion: old, known: g, .. }, next: Base { motion, known, .. }, .. } = &mut lanes[l];
            let at = position[dof] as usize * LANES + l;
            let u1 = x[at] + g[dof];
            let (v1, a1) = self.newmark.finish(u1, old.u[dof], old.v[dof], old.a[dof]);
            (motion.u[dof], motion.v[dof], motion.a[dof]) = (u1, v1, a1);
            let q = self.newmark.damping(u1, v1, a1);
            known[dof] = share * q;
            inertia[at] = mass * (self.newmark.inertia(u1, v1, a1) + alpha * q);
        };
        in_blocks(n, one, count);
    }
}

/// All numbers from 0 to n of every lane, a block of one lane after that of another.
fn in_blocks(n: usize, mut each: impl FnMut(usize, usize), lanes: usize) {
    for first in (0..n).step_by(BLOCK) {
        for lane in 0..lanes {
            (first..n.min(first + BLOCK)).for_each(|i| each(i, lane));
        }
    }
}
