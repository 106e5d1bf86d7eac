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

/// Some Ritz vectors of a space.
pub struct Vectors {
    /// Their ω², lowest first.
    pub omega2: Vec<f64>,
    /// Their s by columns.
    coordinates: Mat<f64>,
}

/// The Ritz values of the space so far: θ = 1/ω², ascending, and s by columns.
struct Eigen {
    values: Vec<f64>,
    vectors: Mat<f64>,
}

/// What a space holds.
pub struct Ritz {
    /// The modes found.
    pub modes: Vectors,
    all: Eigen,
}

impl Ritz {
    /// All that the space holds up to `highest` (rad/s): the modes, and above them vectors that each stand for several.
    pub fn up_to(&self, highest: f64) -> Vectors {
        let values = &self.all.values;
        let kept: Vec<usize> = (0..values.len()).rev().take_while(|&j| values[j] * highest * highest >= 1.0).collect();
        self.all.take(&kept)
    }
}

impl Eigen {
    fn take(&self, kept: &[usize]) -> Vectors {
        let omega2 = kept.iter().map(|&j| 1.0 / self.values[j]).collect();
        let coordinates = Mat::from_fn(self.vectors.nrows(), kept.len(), |i, j| self.vectors[(i, kept[j])]);
        Vectors { omega2, coordinates }
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
            let all = self.eigen();
            let Eigen { values, vectors } = &all;
            if values.len() < p {
                return Ritz { modes: all.take(&[]), all };
            }
            let complete = self.0.is_closed();
            // Ascending θ: the highest come last.
            let found =
                |j: usize| complete || self.0.residual((0..p).map(|k| vectors[(k, j)])) <= TOLERANCE * values[j];
            let wanted: Vec<usize> = (0..p).rev().take_while(|&j| values[j] >= theta).collect();
            let every = wanted.iter().all(|&j| found(j)) && wanted.len() < p;
            if every || complete || p >= most {
                let kept: Vec<usize> = wanted.into_iter().take_while(|&j| found(j)).collect();
                return Ritz { modes: all.take(&kept), all };
            }
        }
    }

    /// Those of the space so far; none where they cannot be computed.
    fn eigen(&self) -> Eigen {
        let p = self.dimension();
        let t = Mat::from_fn(p, p, |i, j| self.0.projected(i, j));
        match t.self_adjoint_eigen(Side::Lower) {
            Ok(eigen) => {
                let values = eigen.S().column_vector().iter().copied().collect();
                Eigen { values, vectors: eigen.U().to_owned() }
            }
            Err(_) => Eigen { values: Vec::new(), vectors: Mat::zeros(p, 0) },
        }
    }

    /// R Φ by rows, for sparse rows R.
    pub fn seen(&self, vectors: &Vectors, rows: &[Vec<(u32, f64)>]) -> Mat<f64> {
        let of_space = Mat::from_fn(rows.len(), vectors.coordinates.nrows(), |i, j| self.0.seen(&rows[i], j));
        &of_space * &vectors.coordinates
    }
}
