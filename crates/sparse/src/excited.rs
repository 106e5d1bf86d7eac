//! Modes that a set of loads can excite, for models too large for [`crate::modes`].
//!
//! ```text
//! first block V₀ ∝ K⁻¹ Bᵀ W           W: random mixtures of the loads B
//! ```
//!
//! Because the process (`lanczos.rs`, in blocks) starts from the loads, modes that they cannot excite (those swaying
//! sideways under a track in the middle, say) never appear.

use faer::{Mat, Side};

use crate::blocks::solve;
use crate::factor::Factor;
use crate::lanczos::Lanczos;
use crate::pencil::Pencil;
use crate::random::Random;

/// Vectors in a block.
const BLOCK: usize = 16;
/// Residual of A φ = θ φ relative to θ at which a mode is taken as found.
const TOLERANCE: f64 = 1e-7;

/// The search; can be continued for more modes.
pub struct Excited<'a>(Lanczos<'a>);

/// Ritz values of the space so far.
pub struct Ritz {
    /// ω² of the modes found, lowest first.
    pub omega2: Vec<f64>,
    /// Their s by columns.
    coordinates: Mat<f64>,
}

impl Ritz {
    /// Those of the columns `kept`.
    fn of(kept: &[usize], values: &[f64], vectors: &Mat<f64>) -> Self {
        let omega2 = kept.iter().map(|&j| 1.0 / values[j]).collect();
        let coordinates = Mat::from_fn(vectors.nrows(), kept.len(), |i, j| vectors[(i, kept[j])]);
        Self { omega2, coordinates }
    }
}

impl<'a> Excited<'a> {
    /// Starts from mixtures of the loads; `loads` are rows of weights on degrees of freedom.
    pub fn new(pencil: &'a Pencil, stiffness: &'a Factor, loads: &[Vec<(u32, f64)>]) -> Self {
        let n = pencil.ndof();
        let mut block = vec![0.0; n * BLOCK];
        let mut random = Random::default();
        for load in loads {
            for column in 0..BLOCK {
                let weight = random.draw();
                load.iter().for_each(|(dof, w)| block[column * n + *dof as usize] += weight * w);
            }
        }
        solve(stiffness, &mut block);
        let mut lanczos = Lanczos::new(pencil, stiffness, BLOCK);
        lanczos.start(block);
        Self(lanczos)
    }

    /// Dimension of the space that was searched.
    pub fn dimension(&self) -> usize {
        self.0.processed()
    }

    /// Nothing is left to search: the space holds all that the loads excite.
    pub fn is_complete(&self) -> bool {
        self.0.is_closed()
    }

    /// Enlarges the space by `blocks` blocks, as far as it can be.
    fn advance(&mut self, blocks: usize) {
        for _ in 0..blocks {
            if !self.0.advance() {
                return;
            }
        }
    }

    /// All modes up to `highest` (rad/s) that the loads excite, or as many as fit into `most` vectors.
    pub fn modes(&mut self, highest: f64, most: usize) -> Ritz {
        let theta = 1.0 / (highest * highest);
        let mut first = true;
        loop {
            if self.dimension() == 0 || !first {
                // A look costs a dense eigenproblem: not after every block.
                self.advance(4 + self.dimension() / (10 * BLOCK));
            }
            first = false;
            let p = self.dimension();
            let (values, vectors) = self.eigen();
            if values.len() < p {
                return Ritz::of(&[], &values, &vectors);
            }
            let complete = self.0.is_closed();
            // Ascending θ: the highest come last.
            let found =
                |j: usize| complete || self.0.residual((0..p).map(|k| vectors[(k, j)])) <= TOLERANCE * values[j];
            let wanted: Vec<usize> = (0..p).rev().take_while(|&j| values[j] >= theta).collect();
            let all = wanted.iter().all(|&j| found(j)) && wanted.len() < p;
            if all || complete || p >= most {
                let kept: Vec<usize> = wanted.into_iter().take_while(|&j| found(j)).collect();
                return Ritz::of(&kept, &values, &vectors);
            }
        }
    }

    /// All that the space so far holds up to `highest` (rad/s): the modes, and above them vectors that each stand for several.
    pub fn vectors(&self, highest: f64) -> Ritz {
        let (values, vectors) = self.eigen();
        let kept: Vec<usize> = (0..values.len()).rev().take_while(|&j| values[j] * highest * highest >= 1.0).collect();
        Ritz::of(&kept, &values, &vectors)
    }

    /// θ, ascending, and s of the space so far; none where they cannot be computed.
    fn eigen(&self) -> (Vec<f64>, Mat<f64>) {
        let p = self.dimension();
        let t = Mat::from_fn(p, p, |i, j| self.0.projected(i, j));
        match t.self_adjoint_eigen(Side::Lower) {
            Ok(eigen) => (eigen.S().column_vector().iter().copied().collect(), eigen.U().to_owned()),
            Err(_) => (Vec::new(), Mat::zeros(p, 0)),
        }
    }

    /// R Φ by rows, for sparse rows R.
    pub fn seen(&self, ritz: &Ritz, rows: &[Vec<(u32, f64)>]) -> Mat<f64> {
        let of_space = Mat::from_fn(rows.len(), ritz.coordinates.nrows(), |i, j| self.0.seen(&rows[i], j));
        &of_space * &ritz.coordinates
    }
}
