//! Modes that a set of loads can excite, by block Lanczos with shift-invert, for models too large for [`crate::modes`].
//!
//! ```text
//! A = K⁻¹M,   QᵀMQ = I,   first block Q₀ ∝ K⁻¹ Bᵀ W           W: random mixtures of the loads B
//! A Q_j = Q T_j + Q_{j+1} R_j                                  block by block, orthogonalised twice
//! T s = θ s   →   ω² = 1/θ,  φ = Q s                           residual ‖Aφ − θφ‖_M = ‖R s_last‖
//! ```
//!
//! Because the process starts from the loads, modes that they cannot excite (those swaying sideways under a track in the
//! middle, say) never appear. All products with the basis are dense products of blocks. (Grimes, Lewis & Simon, SIAM J.
//! Matrix Anal. Appl. 15, 1994, 228–272.)

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par, Side};

use crate::blocks::{inner, solve};
use crate::factor::Factor;
use crate::random::Random;
use crate::sparse::Pencil;
use crate::vector::dot;

/// Vectors in a block.
const BLOCK: usize = 16;
/// Squares below this part of what they were before the orthogonalisation are rounding.
const ROUNDING: f64 = 1e-22;
/// Residual of A φ = θ φ relative to θ at which a mode is taken as found.
const TOLERANCE: f64 = 1e-7;

/// The process; can be continued for more modes.
pub struct Krylov<'a> {
    pencil: &'a Pencil,
    stiffness: &'a Factor,
    n: usize,
    /// Q by columns.
    basis: Vec<f64>,
    /// M Q of the last two blocks.
    mass_basis: Vec<f64>,
    /// Vectors in the last block.
    last: usize,
    /// T, and R below its last block: (columns + one block) × columns.
    t: Vec<Vec<f64>>,
    /// The space is exhausted.
    complete: bool,
}

/// Ritz values of the space so far.
pub struct Ritz {
    /// ω² of the modes found, lowest first.
    pub omega2: Vec<f64>,
    /// Their s by columns.
    coordinates: Mat<f64>,
}

impl<'a> Krylov<'a> {
    /// Starts from mixtures of the loads; `loads` are rows of weights on degrees of freedom.
    pub fn new(pencil: &'a Pencil, stiffness: &'a Factor, loads: &[Vec<(u32, f64)>]) -> Self {
        let n = pencil.ndof();
        let (basis, mass_basis, t) = (Vec::new(), Vec::new(), Vec::new());
        let mut this = Self { pencil, stiffness, n, basis, mass_basis, last: 0, t, complete: false };
        let mut block = vec![0.0; n * BLOCK];
        let mut random = Random::default();
        for load in loads {
            for column in 0..BLOCK {
                let weight = random.draw();
                load.iter().for_each(|(dof, w)| block[column * n + *dof as usize] += weight * w);
            }
        }
        solve(stiffness, &mut block);
        this.append(block);
        this
    }

    /// Vectors in the basis.
    pub fn dimension(&self) -> usize {
        self.t.len()
    }

    /// Orthonormalises a block X against the basis and itself, and appends what is left; returns all coefficients by columns.
    ///
    /// Twice is enough (Parlett, The Symmetric Eigenvalue Problem, 1998, section 6.9). The first time only against the
    /// neighbours, from which alone X differs by more than rounding; their M Q is at hand.
    fn append(&mut self, mut block: Vec<f64>) -> Vec<Vec<f64>> {
        let (n, width) = (self.n, block.len() / self.n);
        let (known, near) = (self.basis.len() / n, self.mass_basis.len() / n);
        let basis = columns(&self.basis, n);
        let local = inner(columns(&self.mass_basis, n), columns(&block, n));
        subtract(&mut block, n, basis.subcols(known - near, near), &local);
        let mut mass = self.mass(&block);
        let all = inner(basis, columns(&mass, n));
        let sizes = block.chunks_exact(n).zip(mass.chunks_exact(n)).map(|(x, y)| dot(x, y));
        let whole = sizes.enumerate().map(|(j, size)| size + local.col(j).squared_norm_l2()).fold(0.0, f64::max);
        subtract(&mut block, n, basis, &all);
        let sum = |i: usize, j: usize| all[(i, j)] + if i + near >= known { local[(i + near - known, j)] } else { 0.0 };
        let mut coefficients: Vec<Vec<f64>> = (0..width).map(|j| (0..known).map(|i| sum(i, j)).collect()).collect();
        // Inside the block: G = XᵀMX = V diag(g) Vᵀ; directions without mass of their own are dropped. The basis has just
        // been taken out of X, so that M X may be that from before.
        let mut transform = Mat::<f64>::identity(width, width);
        let mut kept = width;
        for pass in 0..2 {
            let gram = inner(columns(&block, n), columns(&mass, n));
            let Ok(eigen) = gram.self_adjoint_eigen(Side::Lower) else { break };
            let values: Vec<f64> = eigen.S().column_vector().iter().copied().collect();
            let largest = values.iter().fold(0.0_f64, |m, x| m.max(*x));
            let floor = if pass == 0 { (1e-20 * largest).max(ROUNDING * whole) } else { 1e-6 * largest };
            let good: Vec<usize> = (0..kept).filter(|&i| values[i] > floor).collect();
            let v = eigen.U();
            let scale = Mat::from_fn(kept, good.len(), |i, j| v[(i, good[j])] / values[good[j]].sqrt());
            let back = Mat::from_fn(good.len(), kept, |i, j| v[(j, good[i])] * values[good[i]].sqrt());
            transform = &back * &transform;
            block = times(&block, n, &scale);
            mass = if pass == 0 { self.mass(&block) } else { times(&mass, n, &scale) };
            kept = good.len();
        }
        for (column, sums) in coefficients.iter_mut().enumerate() {
            sums.extend((0..kept).map(|i| transform[(i, column)]));
        }
        self.complete |= kept == 0;
        self.basis.extend_from_slice(&block);
        let last = (self.mass_basis.len() / n).saturating_sub(self.last) * n;
        self.mass_basis.drain(..last);
        self.mass_basis.extend_from_slice(&mass);
        self.last = kept;
        coefficients
    }

    fn mass(&self, block: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; block.len()];
        for (x, y) in block.chunks_exact(self.n).zip(product.chunks_exact_mut(self.n)) {
            self.pencil.add_mass(x, y);
        }
        product
    }

    /// Enlarges the space by `blocks` blocks.
    fn advance(&mut self, blocks: usize) {
        for _ in 0..blocks {
            let from = self.t.len() * self.n;
            if self.complete || from >= self.basis.len() {
                self.complete = true;
                return;
            }
            let mut next = self.mass_basis[self.mass_basis.len() - self.last * self.n..].to_vec();
            solve(self.stiffness, &mut next);
            let columns = self.append(next);
            self.t.extend(columns);
        }
    }

    /// All modes up to `highest` (rad/s) that the loads excite, or as many as fit into `most` vectors.
    pub fn modes(&mut self, highest: f64, most: usize) -> Ritz {
        let theta = 1.0 / (highest * highest);
        let mut first = true;
        loop {
            if self.t.is_empty() || !first {
                // A look costs a dense eigenproblem: not after every block.
                self.advance(4 + self.t.len() / (10 * BLOCK));
            }
            first = false;
            let p = self.t.len();
            let t = Mat::from_fn(p, p, |i, j| self.t[i.max(j)].get(i.min(j)).copied().unwrap_or(0.0));
            let Ok(eigen) = t.self_adjoint_eigen(Side::Lower) else {
                return Ritz { omega2: Vec::new(), coordinates: Mat::zeros(p, 0) };
            };
            let values = eigen.S().column_vector();
            let residual = |j: usize| {
                let below = (p..self.basis.len() / self.n).map(|i| {
                    let row = (0..p).map(|k| self.t[k].get(i).copied().unwrap_or(0.0) * eigen.U()[(k, j)]);
                    row.sum::<f64>()
                });
                below.map(|r| r * r).sum::<f64>().sqrt()
            };
            // Ascending θ: the highest come last.
            let found = |j: usize| self.complete || residual(j) <= TOLERANCE * values[j];
            let wanted: Vec<usize> = (0..p).rev().take_while(|&j| values[j] >= theta).collect();
            let all = wanted.iter().all(|&j| found(j)) && wanted.len() < p;
            if all || self.complete || p >= most {
                let kept: Vec<usize> = wanted.into_iter().take_while(|&j| found(j)).collect();
                let omega2 = kept.iter().map(|&j| 1.0 / values[j]).collect();
                let coordinates = Mat::from_fn(p, kept.len(), |i, j| eigen.U()[(i, kept[j])]);
                return Ritz { omega2, coordinates };
            }
        }
    }

    /// R Φ by rows, for sparse rows R.
    pub fn seen(&self, ritz: &Ritz, rows: &[Vec<(u32, f64)>]) -> Mat<f64> {
        let p = ritz.coordinates.nrows();
        let of_basis = Mat::from_fn(rows.len(), p, |i, j| {
            let q = &self.basis[j * self.n..(j + 1) * self.n];
            rows[i].iter().map(|(dof, w)| w * q[*dof as usize]).sum::<f64>()
        });
        &of_basis * &ritz.coordinates
    }
}

/// Vectors one behind the other as a matrix.
fn columns(numbers: &[f64], n: usize) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice(numbers, n, numbers.len() / n)
}

/// Rows of a basis that are multiplied at a time.
const NEAR: usize = 512;

/// X ← X − Q C.
fn subtract(x: &mut [f64], n: usize, q: MatRef<'_, f64>, c: &Mat<f64>) {
    let mut x = MatMut::from_column_major_slice_mut(x, n, c.ncols());
    // By rows that stay near: a fifth quicker.
    for first in (0..n).step_by(NEAR) {
        let rows = NEAR.min(n - first);
        let (x, q) = (x.as_mut().subrows_mut(first, rows), q.subrows(first, rows));
        matmul(x, Accum::Add, q, c.as_ref(), -1.0, Par::Seq);
    }
}

/// X C.
fn times(x: &[f64], n: usize, c: &Mat<f64>) -> Vec<f64> {
    let mut product = vec![0.0; n * c.ncols()];
    let into = MatMut::from_column_major_slice_mut(&mut product, n, c.ncols());
    matmul(into, Accum::Replace, columns(x, n), c.as_ref(), 1.0, Par::Seq);
    product
}
