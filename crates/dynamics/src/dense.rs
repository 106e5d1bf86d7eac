//! A dense matrix to multiply with, by rows; the instruction set is chosen at run time (crate pulp). The order of summation
//! is fixed, so that results do not depend on it.
//!
//! All products go through [`Dense::fold`], which reads the matrix once:
//!
//! ```text
//! p = a_j · x   →   weights w(j, p)   →   y ← y + w a_j        for every row a_j
//! ```

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, Par};
use pulp::{Arch, Simd, WithSimd};
use serde::{Deserialize, Serialize};
use ttb_sparse::vector::dot_in;

/// A matrix; in single precision half as much is read from memory. Sums are in double precision either way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Dense<T = f64> {
    columns: usize,
    /// Numbers, row by row.
    data: Vec<T>,
}

/// Partial sums of a product.
const WIDE: usize = 16;

impl Dense {
    /// No rows, no columns.
    pub const EMPTY: Self = Self { columns: 0, data: Vec::new() };

    /// A matrix of zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { columns, data: vec![0.0; rows * columns] }
    }

    /// A row, writable.
    pub fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.data[i * self.columns..(i + 1) * self.columns]
    }

    /// The same matrix, rounded to single precision.
    pub fn single(&self) -> Dense<f32> {
        Dense { columns: self.columns, data: self.data.iter().map(|x| *x as f32).collect() }
    }
}

impl<T: Copy + Into<f64>> Dense<T> {
    /// From its numbers by rows.
    pub fn new(columns: usize, data: Vec<T>) -> Self {
        Self { columns, data }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.data.len().checked_div(self.columns).unwrap_or(0)
    }

    /// Whether it has so many rows, at least one, all of the same length.
    pub fn is_whole(&self, rows: usize) -> bool {
        rows > 0 && self.columns > 0 && Some(self.data.len()) == rows.checked_mul(self.columns)
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// A row.
    pub fn row(&self, i: usize) -> &[T] {
        &self.data[i * self.columns..(i + 1) * self.columns]
    }

    /// Aᵀ diag(w) A′, A′ the first `columns` of A.
    pub fn weighted_gram(&self, w: &[f64], columns: usize) -> Dense {
        let a: Mat<f64> = Mat::from_fn(self.rows(), self.columns, |j, k| self.row(j)[k].into());
        let weighted = Mat::from_fn(self.rows(), columns, |j, k| w[j] * a[(j, k)]);
        let mut gram = Dense::zeros(self.columns, columns);
        let into = MatMut::from_row_major_slice_mut(&mut gram.data, self.columns, columns);
        matmul(into, Accum::Replace, a.transpose(), &weighted, 1.0, Par::Seq);
        gram
    }

    /// y ← A x over the first columns, as many as `x` has numbers.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        self.fold(
            x,
            |j, p| {
                y[j] = p;
                []
            },
            [],
        );
    }

    /// y ← y + Aᵀ x.
    pub fn add_transposed(&self, x: &[f64], y: &mut [f64]) {
        self.fold(&[], |j, _| [x[j]], [y]);
    }

    /// For every row a_j: p = a_j · x over the first columns, as many as `x` has numbers; then y ← y + w a_j for every
    /// w of `weights(j, p)` and its y, over the last columns, as many as that has numbers.
    pub fn fold<const N: usize>(&self, x: &[f64], weights: impl FnMut(usize, f64) -> [f64; N], y: [&mut [f64]; N]) {
        Arch::new().dispatch(Fold { matrix: self, x, weights, y });
    }
}

struct Fold<'a, T, W, const N: usize> {
    matrix: &'a Dense<T>,
    x: &'a [f64],
    weights: W,
    y: [&'a mut [f64]; N],
}

impl<T: Copy + Into<f64>, W: FnMut(usize, f64) -> [f64; N], const N: usize> WithSimd for Fold<'_, T, W, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { matrix, x, mut weights, mut y } = self;
        let columns = matrix.columns.max(1);
        let mut groups = matrix.data.chunks_exact(4 * columns);
        let mut j = 0;
        for group in &mut groups {
            let (ab, cd) = group.split_at(2 * columns);
            let ((a, b), (c, d)) = (ab.split_at(columns), cd.split_at(columns));
            let [p, q, r, s] = [a, b, c, d].map(|row| dot(row, x));
            let w = [weights(j, p), weights(j + 1, q), weights(j + 2, r), weights(j + 3, s)];
            for (n, y) in y.iter_mut().enumerate() {
                let w = w.map(|w| w[n]);
                let [a, b, c, d] = [a, b, c, d].map(|row| &row[columns - y.len()..]);
                for ((((y, a), b), c), d) in y.iter_mut().zip(a).zip(b).zip(c).zip(d) {
                    let [a, b, c, d]: [f64; 4] = [(*a).into(), (*b).into(), (*c).into(), (*d).into()];
                    *y += (w[0] * a + w[1] * b) + (w[2] * c + w[3] * d);
                }
            }
            j += 4;
        }
        for a in groups.remainder().chunks_exact(columns) {
            let w = weights(j, dot(a, x));
            for (y, w) in y.iter_mut().zip(w) {
                let a = &a[columns - y.len()..];
                y.iter_mut().zip(a).for_each(|(y, a)| *y += w * (*a).into());
            }
            j += 1;
        }
    }
}

/// a · x over the first numbers of a, as many as x has.
#[inline(always)]
pub(crate) fn dot<T: Copy + Into<f64>>(a: &[T], x: &[f64]) -> f64 {
    dot_in::<WIDE, T>(&a[..x.len()], x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_every_shape() {
        for (rows, columns) in [(1, 1), (3, 8), (9, 21), (6, 40)] {
            let data: Vec<f64> = (0..rows * columns).map(|i| ((i * 7) % 13) as f64 - 6.0).collect();
            let a = Dense::new(columns, data.clone());
            let x: Vec<f64> = (0..columns).map(|j| j as f64 - 2.0).collect();
            let product = |i: usize, first: usize| (0..first).map(|j| data[i * columns + j] * x[j]).sum::<f64>();
            let mut y = vec![0.0; rows];
            a.single().multiply(&x, &mut y);
            assert_eq!(y, (0..rows).map(|i| product(i, columns)).collect::<Vec<f64>>());
            a.multiply(&x, &mut y);
            assert_eq!(y, (0..rows).map(|i| product(i, columns)).collect::<Vec<f64>>());
            let transposed =
                |of: &dyn Fn(usize) -> f64, j: usize| (0..rows).map(|i| data[i * columns + j] * of(i)).sum::<f64>();
            let mut back = vec![1.0; columns];
            a.add_transposed(&y, &mut back);
            assert_eq!(back, (0..columns).map(|j| 1.0 + transposed(&|i| y[i], j)).collect::<Vec<f64>>());
            // Over the first columns, to all and to the last.
            let first = columns.div_ceil(2);
            let (mut all, mut last) = (vec![0.0; columns], vec![0.0; columns - first]);
            a.fold(&x[..first], |j, p| [p + j as f64, 2.0 * p], [&mut all, &mut last]);
            for (j, all) in all.iter().enumerate() {
                assert_eq!(*all, transposed(&|i| product(i, first) + i as f64, j));
                if let Some(k) = j.checked_sub(first) {
                    assert_eq!(last[k], transposed(&|i| 2.0 * product(i, first), j));
                }
            }
        }
    }
}
