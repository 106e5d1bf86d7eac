//! Orthonormal vectors in the inner product of M, and how new ones join them.
//!
//! ```text
//! x = V c + rest,   c = VᵀM x            orthogonalised twice; the rest joins V with length one
//! ```
//!
//! Twice is enough (Parlett, The Symmetric Eigenvalue Problem, 1998, section 6.9). A vector by itself goes through plain
//! sums, whose order no CPU changes; a block goes through dense products.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par, Side};

use crate::blocks::inner;
use crate::pencil::Pencil;
use crate::vector::{add_scaled, dot};

/// The vectors V, one behind the other.
pub(crate) struct Space {
    n: usize,
    vectors: Vec<f64>,
    /// M V of the last two blocks; empty where vectors join one by one.
    mass: Vec<f64>,
    /// Vectors in the last block.
    last: usize,
}

impl Space {
    /// No vectors yet, of `n` numbers each.
    pub fn new(n: usize) -> Self {
        Self { n, vectors: Vec::new(), mass: Vec::new(), last: 0 }
    }

    /// Number of vectors.
    pub fn len(&self) -> usize {
        self.vectors.len() / self.n.max(1)
    }

    /// Vector j.
    pub fn vector(&self, j: usize) -> &[f64] {
        &self.vectors[j * self.n..(j + 1) * self.n]
    }

    /// M v of `count` vectors from v_first on.
    pub fn mass_of(&self, first: usize, count: usize, pencil: &Pencil) -> Vec<f64> {
        let known = self.len() - self.mass.len() / self.n.max(1);
        if first >= known {
            return self.mass[(first - known) * self.n..][..count * self.n].to_vec();
        }
        products(&self.vectors[first * self.n..][..count * self.n], pencil)
    }
}

/// The products M X of vectors one behind the other.
fn products(x: &[f64], pencil: &Pencil) -> Vec<f64> {
    x.chunks_exact(pencil.ndof()).flat_map(|x| pencil.mass_times(x)).collect()
}

/// A single vector shorter than this, relative to itself before the orthogonalisation, is rounding.
const DEFLATION: f64 = 1e-12;

/// Lets one vector join; returns c and, if anything was left, its length.
pub(crate) fn single(space: &mut Space, mut x: Vec<f64>, pencil: &Pencil) -> Vec<f64> {
    let mut coefficients = vec![0.0; space.len()];
    let before = dot(&x, &pencil.mass_times(&x)).max(0.0).sqrt();
    for _ in 0..2 {
        let mx = pencil.mass_times(&x);
        let h: Vec<f64> = space.vectors.chunks_exact(space.n).map(|v| dot(v, &mx)).collect();
        for ((v, h), sum) in space.vectors.chunks_exact(space.n).zip(&h).zip(&mut coefficients) {
            add_scaled(-h, v, &mut x);
            *sum += h;
        }
    }
    let rest = dot(&x, &pencil.mass_times(&x)).max(0.0).sqrt();
    if rest > DEFLATION * before && space.len() < x.len() {
        x.iter_mut().for_each(|x| *x /= rest);
        space.vectors.extend_from_slice(&x);
        coefficients.push(rest);
    }
    coefficients
}

/// Squares below this part of what they were before the orthogonalisation are rounding.
const ROUNDING: f64 = 1e-22;

/// Lets a block X join, orthonormalised against the space and itself; returns all coefficients by columns.
///
/// The first pass is only against the neighbours, from which alone X differs by more than rounding; their M V is at hand.
pub(crate) fn block(space: &mut Space, mut block: Vec<f64>, pencil: &Pencil) -> Vec<Vec<f64>> {
    let (n, width) = (space.n, block.len() / space.n);
    let (known, near) = (space.vectors.len() / n, space.mass.len() / n);
    let basis = columns(&space.vectors, n);
    let local = inner(columns(&space.mass, n), columns(&block, n));
    subtract(&mut block, n, basis.subcols(known - near, near), &local);
    let mut mass = products(&block, pencil);
    let all = inner(basis, columns(&mass, n));
    let sizes = block.chunks_exact(n).zip(mass.chunks_exact(n)).map(|(x, y)| dot(x, y));
    let whole = sizes.enumerate().map(|(j, size)| size + local.col(j).squared_norm_l2()).fold(0.0, f64::max);
    subtract(&mut block, n, basis, &all);
    let sum = |i: usize, j: usize| all[(i, j)] + if i + near >= known { local[(i + near - known, j)] } else { 0.0 };
    let mut coefficients: Vec<Vec<f64>> = (0..width).map(|j| (0..known).map(|i| sum(i, j)).collect()).collect();
    // Inside the block: G = XᵀMX = V diag(g) Vᵀ; directions without mass of their own are dropped. The space has just
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
        mass = if pass == 0 { products(&block, pencil) } else { times(&mass, n, &scale) };
        kept = good.len();
    }
    for (column, sums) in coefficients.iter_mut().enumerate() {
        sums.extend((0..kept).map(|i| transform[(i, column)]));
    }
    space.vectors.extend_from_slice(&block);
    let forgotten = (space.mass.len() / n).saturating_sub(space.last) * n;
    space.mass.drain(..forgotten);
    space.mass.extend_from_slice(&mass);
    space.last = kept;
    coefficients
}

/// Vectors one behind the other as a matrix.
fn columns(numbers: &[f64], n: usize) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice(numbers, n, numbers.len() / n)
}

/// Rows of a space that are multiplied at a time.
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
