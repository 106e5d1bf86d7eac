//! L U = P A of a small dense matrix: factorised by rows, solved by columns.
//!
//! A row's sum waits for the unknown before it; what an unknown takes off the others is a few vector instructions that wait
//! for nothing.

/// A factor with its workspace.
#[derive(Clone, Debug, Default)]
pub struct Lu {
    n: usize,
    /// L below the diagonal, U from it on, by rows.
    pub rows: Vec<f64>,
    /// The same by columns, and the reciprocals of U's diagonal.
    columns: Vec<f64>,
    inverse: Vec<f64>,
    pivots: Vec<usize>,
}

impl Lu {
    /// For order `n`.
    pub fn new(n: usize) -> Self {
        Self { n, rows: vec![0.0; n * n], columns: vec![0.0; n * n], inverse: vec![0.0; n], pivots: vec![0; n] }
    }

    /// Factorises what stands in `rows`; false for a matrix without factor.
    pub fn factorise(&mut self) -> bool {
        let n = self.n;
        for k in 0..n {
            let size = |i: usize| self.rows[i * n + k].abs();
            let best = (k + 1..n).fold(k, |best, i| if size(i) > size(best) { i } else { best });
            self.pivots[k] = best;
            if best != k {
                let (before, after) = self.rows.split_at_mut(best * n);
                before[k * n..(k + 1) * n].swap_with_slice(&mut after[..n]);
            }
            let (above, below) = self.rows.split_at_mut((k + 1) * n);
            let pivot = &above[k * n..(k + 1) * n];
            if pivot[k] == 0.0 || !pivot[k].is_finite() {
                return false;
            }
            let inverse = 1.0 / pivot[k];
            self.inverse[k] = inverse;
            for row in below.chunks_exact_mut(n) {
                if row[k] == 0.0 {
                    continue;
                }
                let factor = row[k] * inverse;
                row[k] = factor;
                row[k + 1..].iter_mut().zip(&pivot[k + 1..]).for_each(|(a, p)| *a -= factor * p);
            }
        }
        for (k, column) in self.columns.chunks_exact_mut(n).enumerate() {
            column.iter_mut().zip(self.rows.chunks_exact(n)).for_each(|(to, row)| *to = row[k]);
        }
        true
    }

    /// x ← A⁻¹ x.
    pub fn solve(&self, x: &mut [f64]) {
        let n = self.n;
        for (k, pivot) in self.pivots.iter().enumerate() {
            x.swap(k, *pivot);
        }
        let take = |from: &mut [f64], by: f64, column: &[f64]| {
            from.iter_mut().zip(column).for_each(|(x, a)| *x -= by * a);
        };
        for (k, column) in self.columns.chunks_exact(n).enumerate() {
            let (before, after) = x.split_at_mut(k + 1);
            take(after, before[k], &column[k + 1..]);
        }
        for (k, column) in self.columns.chunks_exact(n).enumerate().rev() {
            let (before, after) = x.split_at_mut(k);
            after[0] *= self.inverse[k];
            take(before, after[0], column);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_solves_what_the_matrix_multiplies() {
        let n = 13;
        let entry = |i: usize, j: usize| ((5 * i * j + 3 * j * j + i + 1) as f64).sin();
        let mut lu = Lu::new(n);
        (0..n * n).for_each(|k| lu.rows[k] = entry(k / n, k % n));
        let x: Vec<f64> = (0..n).map(|i| (i as f64).cos()).collect();
        let mut b: Vec<f64> = (0..n).map(|i| (0..n).map(|j| entry(i, j) * x[j]).sum()).collect();
        assert!(lu.factorise());
        lu.solve(&mut b);
        let miss = b.iter().zip(&x).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(miss < 1e-11, "{miss}");
        lu.rows.fill(0.0);
        assert!(!lu.factorise());
    }
}
