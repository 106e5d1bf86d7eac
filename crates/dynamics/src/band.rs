//! Symmetric banded matrices: a rail on its supports, numbered along the track, has a half bandwidth of three to seven.
//!
//! A = L D Lᵀ with unit lower L.

use thiserror::Error;

/// A banded matrix that has no Cholesky factor.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("the matrix is not positive definite: pivot {pivot:e} at degree of freedom {row}")]
pub struct NotPositiveDefinite {
    /// 0-based row.
    pub row: usize,
    /// The pivot found there.
    pub pivot: f64,
}

/// Lower band of a symmetric n × n matrix by rows: row i holds columns i−b … i.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    n: usize,
    b: usize,
    rows: Vec<f64>,
}

impl Band {
    /// Zero matrix of order `n` with half bandwidth `b`.
    pub fn zeros(n: usize, b: usize) -> Self {
        Self { n, b, rows: vec![0.0; n * (b + 1)] }
    }
    /// Number of rows.
    pub fn order(&self) -> usize {
        self.n
    }
    /// Half bandwidth.
    pub fn half_bandwidth(&self) -> usize {
        self.b
    }
    /// Entry (i, j) within the band.
    pub fn get(&self, i: usize, j: usize) -> f64 {
        let (i, j) = (i.max(j), i.min(j));
        self.rows[i * (self.b + 1) + self.b - (i - j)]
    }
    /// Adds `value` to the entry (i, j); the mirrored entry is the same storage, so give each pair once.
    pub fn add(&mut self, i: usize, j: usize, value: f64) {
        let (i, j) = (i.max(j), i.min(j));
        self.rows[i * (self.b + 1) + self.b - (i - j)] += value;
    }
    /// Adds a symmetric element matrix at the given degrees of freedom.
    pub fn add_element<const N: usize>(&mut self, dofs: &[usize; N], matrix: &[[f64; N]; N]) {
        for (p, row) in dofs.iter().zip(matrix) {
            for (q, value) in dofs.iter().zip(row).filter(|(q, _)| *q <= p) {
                self.add(*p, *q, *value);
            }
        }
    }

    /// A = L D Lᵀ.
    ///
    /// # Errors
    /// A pivot that is not positive.
    pub fn factorise(mut self) -> Result<BandFactor, NotPositiveDefinite> {
        let (b, w) = (self.b, self.b + 1);
        let mut inverse = vec![0.0; self.n];
        for i in 0..self.n {
            let first = i.saturating_sub(b);
            // Row i: c_ij = a_ij − Σ_k c_ik l_jk, then l_ij = c_ij / d_j.
            for j in first..i {
                let from = first.max(j.saturating_sub(b));
                let c: f64 = (from..j).map(|k| self.rows[i * w + b - (i - k)] * self.rows[j * w + b - (j - k)]).sum();
                self.rows[i * w + b - (i - j)] -= c;
            }
            let mut d = self.rows[i * w + b];
            for (j, inverse) in (first..i).zip(&inverse[first..i]) {
                let c = self.rows[i * w + b - (i - j)];
                let l = c * inverse;
                d -= c * l;
                self.rows[i * w + b - (i - j)] = l;
            }
            if d <= 0.0 || !d.is_finite() {
                return Err(NotPositiveDefinite { row: i, pivot: d });
            }
            inverse[i] = 1.0 / d;
        }
        let rows = self.rows.chunks_exact(w).flat_map(|row| &row[..b]).copied().collect();
        Ok(BandFactor { n: self.n, b, rows, inverse })
    }
}

/// L and 1/D of a [`Band`], for set-up; [`crate::twisted::TwistedFactor`] is its like for the step loop.
#[derive(Clone, Debug)]
pub struct BandFactor {
    n: usize,
    b: usize,
    /// Row i: l_{i,i−b} … l_{i,i−1}.
    rows: Vec<f64>,
    inverse: Vec<f64>,
}

impl BandFactor {
    /// x ← A⁻¹ x.
    pub fn solve(&self, x: &mut [f64]) {
        self.solve_range(x, 0, self.n);
    }

    /// Solves the part of the system from row `from` to row `to` as if the rest did not exist; with a right-hand side that
    /// is zero before `from` and a solution that has decayed at `to`, rows `from..to` are those of A⁻¹ x.
    pub fn solve_range(&self, x: &mut [f64], from: usize, to: usize) {
        let coefficients = |i: usize| {
            let first = i.saturating_sub(self.b).max(from);
            (first, &self.rows[i * self.b + self.b - (i - first)..(i + 1) * self.b])
        };
        for i in from..to {
            let (first, row) = coefficients(i);
            let sum: f64 = row.iter().zip(&x[first..i]).map(|(l, y)| l * y).sum();
            x[i] -= sum;
        }
        x[from..to].iter_mut().zip(&self.inverse[from..to]).for_each(|(x, inverse)| *x *= inverse);
        for i in (from..to).rev() {
            let (first, row) = coefficients(i);
            let (before, xi) = x.split_at_mut(i);
            before[first..].iter_mut().zip(row).for_each(|(y, l)| *y -= l * xi[0]);
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    impl Band {
        /// y += A x, to check what a factor solves.
        pub(crate) fn multiply_add(&self, x: &[f64], y: &mut [f64]) {
            for (i, y) in y.iter_mut().enumerate() {
                let columns = i.saturating_sub(self.b)..(i + self.b + 1).min(self.n);
                *y += columns.map(|j| self.get(i, j) * x[j]).sum::<f64>();
            }
        }
    }

    /// A diagonally dominant band of reproducible numbers.
    pub(crate) fn random(n: usize, b: usize) -> Band {
        let mut a = Band::zeros(n, b);
        let mut seed = 1u64;
        let mut next = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 40) as f64 / (1u64 << 24) as f64 - 0.5
        };
        for i in 0..n {
            a.add(i, i, 2.0 * b as f64);
            (i.saturating_sub(b)..i).for_each(|j| a.add(i, j, next()));
        }
        a
    }

    #[test]
    fn every_bandwidth_solves_what_it_multiplies() {
        for b in 1..=10 {
            let a = random(40, b);
            let x: Vec<f64> = (0..40).map(|i| f64::from(i).sin()).collect();
            let mut y = vec![0.0; 40];
            a.multiply_add(&x, &mut y);
            a.factorise().unwrap().solve(&mut y);
            let error = x.iter().zip(&y).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(error < 1e-14, "half bandwidth {b}: {error:e}");
        }
    }

    #[test]
    fn an_indefinite_matrix_is_named_by_its_row() {
        let mut a = random(10, 2);
        a.add(6, 6, -100.0);
        assert_eq!(a.factorise().unwrap_err().row, 6);
    }

    #[test]
    fn a_window_of_the_inverse_is_exact_where_the_solution_has_decayed() {
        let mut a = random(200, 3);
        (0..200).for_each(|i| a.add(i, i, 20.0));
        let factor = a.factorise().unwrap();
        let (mut whole, mut window) = (vec![0.0; 200], vec![0.0; 200]);
        (whole[90], window[90]) = (1.0, 1.0);
        factor.solve(&mut whole);
        factor.solve_range(&mut window, 90, 140);
        for i in 90..110 {
            assert!((whole[i] - window[i]).abs() < 1e-17, "{i}");
        }
    }
}
