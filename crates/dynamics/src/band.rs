//! Symmetric banded matrices: a rail on its supports, numbered along the track, has a half bandwidth of three to seven.
//!
//! A = L D Lᵀ with unit lower L. Forward and backward substitution are one short recurrence each, bound by the latency of
//! a multiplication and a subtraction a row; the usual bandwidths get loops of constant length.

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
    /// Order.
    pub fn order(&self) -> usize {
        self.n
    }
    /// Half bandwidth.
    pub fn half_bandwidth(&self) -> usize {
        self.b
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
    /// self + factor · other, same shape.
    pub fn plus(&self, factor: f64, other: &Band) -> Band {
        let rows = self.rows.iter().zip(&other.rows).map(|(a, b)| a + factor * b).collect();
        Band { rows, ..*self }
    }
    /// y += A x.
    pub fn multiply_add(&self, x: &[f64], y: &mut [f64]) {
        let w = self.b + 1;
        for (i, row) in self.rows.chunks_exact(w).enumerate() {
            let first = i.saturating_sub(self.b);
            let row = &row[w - 1 - (i - first)..];
            let (lower, diagonal) = row.split_at(row.len() - 1);
            let xi = x[i];
            let mut sum = diagonal[0] * xi;
            for ((a, xj), yj) in lower.iter().zip(&x[first..i]).zip(&mut y[first..i]) {
                sum += a * xj;
                *yj += a * xi;
            }
            y[i] += sum;
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
            for j in first..i {
                let c = self.rows[i * w + b - (i - j)];
                let l = c * inverse[j];
                d -= c * l;
                self.rows[i * w + b - (i - j)] = l;
            }
            if d <= 0.0 || !d.is_finite() {
                return Err(NotPositiveDefinite { row: i, pivot: d });
            }
            inverse[i] = 1.0 / d;
        }
        let mut columns = vec![0.0; self.n * b];
        for i in 0..self.n {
            for k in 1..=b.min(self.n - 1 - i) {
                columns[i * b + k - 1] = self.rows[(i + k) * w + b - k];
            }
        }
        let rows = self.rows.chunks_exact(w).flat_map(|row| &row[..b]).copied().collect();
        Ok(BandFactor { n: self.n, b, rows, columns, inverse })
    }
}

/// L and 1/D of a [`Band`]; L by columns for the forward, by rows for the backward substitution.
#[derive(Clone, Debug)]
pub struct BandFactor {
    n: usize,
    b: usize,
    /// Row i: l_{i,i−b} … l_{i,i−1}.
    rows: Vec<f64>,
    /// Row i: l_{i+1,i} … l_{i+b,i}.
    columns: Vec<f64>,
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
        match self.b {
            1 => self.solve_fixed::<1>(x, from, to),
            2 => self.solve_fixed::<2>(x, from, to),
            3 => self.solve_fixed::<3>(x, from, to),
            4 => self.solve_fixed::<4>(x, from, to),
            5 => self.solve_fixed::<5>(x, from, to),
            6 => self.solve_fixed::<6>(x, from, to),
            7 => self.solve_fixed::<7>(x, from, to),
            8 => self.solve_fixed::<8>(x, from, to),
            b => self.solve_any(b, x, from, to),
        }
    }

    /// What a found unknown takes off the next B right-hand sides is added up in registers, so that a row waits for one
    /// product and one sum only: twice as fast as dot products with the last B unknowns.
    fn solve_fixed<const B: usize>(&self, x: &mut [f64], from: usize, to: usize) {
        let (rows, _) = self.rows.as_chunks::<B>();
        let (columns, _) = self.columns.as_chunks::<B>();
        let mut owed = [0.0; B];
        for ((x, column), inverse) in x[from..to].iter_mut().zip(&columns[from..to]).zip(&self.inverse[from..to]) {
            let y = *x - owed[0];
            for k in 1..B {
                owed[k - 1] = owed[k] + column[k - 1] * y;
            }
            owed[B - 1] = column[B - 1] * y;
            *x = y * inverse;
        }
        let mut owed = [0.0; B];
        for (x, row) in x[from..to].iter_mut().zip(&rows[from..to]).rev() {
            let y = *x - owed[0];
            for k in 1..B {
                owed[k - 1] = owed[k] + row[B - k] * y;
            }
            owed[B - 1] = row[0] * y;
            *x = y;
        }
    }

    fn solve_any(&self, b: usize, x: &mut [f64], from: usize, to: usize) {
        for i in from..to {
            let first = i.saturating_sub(b).max(from);
            let row = &self.rows[i * b + b - (i - first)..(i + 1) * b];
            let sum: f64 = row.iter().zip(&x[first..i]).map(|(l, y)| l * y).sum();
            x[i] -= sum;
        }
        for i in (from..to).rev() {
            let column = &self.columns[i * b..i * b + b.min(to - 1 - i)];
            let sum: f64 = column.iter().zip(&x[i + 1..]).map(|(l, y)| l * y).sum();
            x[i] = x[i] * self.inverse[i] - sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(n: usize, b: usize) -> Band {
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
        let a = random(200, 3).plus(20.0, &{
            let mut d = Band::zeros(200, 3);
            (0..200).for_each(|i| d.add(i, i, 1.0));
            d
        });
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
