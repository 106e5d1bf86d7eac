//! The shift-invert Lanczos process behind every search for modes, K φ = ω² M φ, in the inner product of M with full
//! orthogonalisation.
//!
//! ```text
//! A = K⁻¹M,   v_iᵀ M v_j = δ_ij
//! A v_j = Σ t_ij v_i                 `width` waiting vectors in turn; what is left of A v becomes new vectors, which wait
//! T s = θ s   →   ω² = 1/θ,  φ = V s           residual ‖Aφ − θφ‖_M = ‖ rows of t beyond T times s ‖
//! ```
//!
//! The searches differ in what they start from and in what they ask of the process: the lowest modes, none missing
//! ([`crate::modes`]), and all that a set of loads excites up to a frequency ([`crate::excited`]). (Grimes, Lewis &
//! Simon, SIAM J. Matrix Anal. Appl. 15, 1994, 228–272.)

use crate::blocks::solve;
use crate::factor::Factor;
use crate::orthogonal::{Space, block, single};
use crate::pencil::Pencil;
use crate::vector::add_scaled;

/// The process; it can always be continued.
pub(crate) struct Lanczos<'a> {
    pencil: &'a Pencil,
    stiffness: &'a Factor,
    /// Vectors that A is applied to at a time.
    width: usize,
    space: Space,
    /// t_ij by columns j, over the space as it was when v_j was processed.
    t: Vec<Vec<f64>>,
}

impl<'a> Lanczos<'a> {
    /// An empty space; `stiffness` is the factor of K. Vectors one at a time go through plain sums, blocks through dense
    /// products, which are several times faster on large models.
    pub fn new(pencil: &'a Pencil, stiffness: &'a Factor, width: usize) -> Self {
        Self { pencil, stiffness, width, space: Space::new(pencil.ndof()), t: Vec::new() }
    }

    /// Vectors of the space.
    pub fn vectors(&self) -> usize {
        self.space.len()
    }

    /// Vectors that A was applied to: the dimension of T.
    pub fn processed(&self) -> usize {
        self.t.len()
    }

    /// No vector waits: the space is invariant under A.
    pub fn is_closed(&self) -> bool {
        self.processed() == self.vectors()
    }

    /// Admits start vectors, one behind the other, to the queue.
    pub fn start(&mut self, vectors: Vec<f64>) {
        self.admit(vectors);
    }

    /// Admits K⁻¹ M x to the queue: what has no mass is taken out.
    pub fn start_with_mass(&mut self, x: &[f64]) {
        let mut y = self.pencil.mass_times(x);
        self.invert(&mut y);
        self.admit(y);
    }

    /// Processes the next waiting vectors; false when none waits.
    pub fn advance(&mut self) -> bool {
        let width = (self.vectors() - self.processed()).min(self.width);
        if width == 0 {
            return false;
        }
        let mut next = self.space.mass_of(self.processed(), width, self.pencil);
        self.invert(&mut next);
        let columns = self.admit(next);
        self.t.extend(columns);
        true
    }

    /// X ← K⁻¹ X.
    fn invert(&self, x: &mut [f64]) {
        if self.width == 1 {
            self.stiffness.solve_in_place(x, &mut vec![0.0; self.pencil.ndof()]);
        } else {
            solve(self.stiffness, x);
        }
    }

    /// Splits vectors into their parts in the space and a rest, which joins it; returns all coefficients by columns.
    fn admit(&mut self, vectors: Vec<f64>) -> Vec<Vec<f64>> {
        if self.width == 1 {
            vec![single(&mut self.space, vectors, self.pencil)]
        } else {
            block(&mut self.space, vectors, self.pencil)
        }
    }

    /// Entry (i, j) of T.
    pub fn projected(&self, i: usize, j: usize) -> f64 {
        self.t[i.max(j)].get(i.min(j)).copied().unwrap_or(0.0)
    }

    /// ‖Aφ − θφ‖_M of φ = V s.
    pub fn residual(&self, s: impl Iterator<Item = f64> + Clone) -> f64 {
        let row = |i: usize| {
            let terms = self.t.iter().zip(s.clone()).map(|(t, s)| t.get(i).map_or(0.0, |t| t * s));
            terms.sum::<f64>()
        };
        (self.processed()..self.vectors()).map(|i| row(i) * row(i)).sum::<f64>().sqrt()
    }

    /// The combination V s of the vectors.
    pub fn combine(&self, s: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut sum = vec![0.0; self.pencil.ndof()];
        s.enumerate().for_each(|(j, s)| add_scaled(s, self.space.vector(j), &mut sum));
        sum
    }

    /// wᵀ v_j for a sparse row w.
    pub fn seen(&self, row: &[(u32, f64)], j: usize) -> f64 {
        let v = self.space.vector(j);
        row.iter().map(|(dof, w)| w * v[*dof as usize]).sum()
    }
}
