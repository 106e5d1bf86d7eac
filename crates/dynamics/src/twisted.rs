//! Banded solves for the step loop: eliminated from both ends at once, towards a small block in the middle.
//!
//! One substitution is a recurrence, bound by the latency of a product and a sum a row. Two independent ones, the upper
//! half's and the lower half's, run side by side in the two lanes of a vector register:
//!
//! ```text
//! A = | A_uu A_um  0   |     rows 0 … p−1 ascending and n−1 … n−p descending are eliminated,
//!     | A_mu A_mm A_ml |     the middle block keeps S = A_mm − A_mu A_uu⁻¹ A_um − A_ml A_ll⁻¹ A_lm,
//!     |  0   A_lm A_ll |     of order b or b + 1, inverted once
//! ```
//!
//! (The "twisted" factorisation; Parlett & Dhillon, Linear Algebra Appl. 267, 1997, for b = 1.)
//!
//! A track is the same from bay to bay, and what its ends do to the factor decays: from some row on the coefficients repeat, to
//! the last bit. They are kept once (module `repeating`), so that a solution reads little more than its own numbers.

mod repeating;

use nalgebra::DMatrix;

use crate::band::{Band, NotPositiveDefinite};
use repeating::Repeating;

/// A pair of values: of the upper and of the lower half.
type Pair = [f64; 2];

/// Widths of the loops: a half bandwidth takes the next of them, filled up with zeros.
const WIDTHS: [usize; 12] = [1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 64];

/// Factor of a banded matrix for the step loop.
#[derive(Clone, Debug)]
pub struct TwistedFactor {
    /// Rows eliminated from either end.
    p: usize,
    /// Coefficients a row: one of `WIDTHS`.
    width: usize,
    /// Row i of either half, counted from its end: coefficients of the rows behind, nearest first.
    forward: Repeating,
    /// Coefficients of the rows before, nearest first.
    backward: Repeating,
    /// Reciprocals of the pivots d.
    inverse: Repeating,
    /// S⁻¹ by rows.
    middle: Vec<f64>,
}

impl TwistedFactor {
    /// Factorises.
    ///
    /// # Errors
    /// A pivot that is not positive.
    ///
    /// # Panics
    /// For a half bandwidth above 64: a rail with 31 elements a bay.
    pub fn new(mut a: Band) -> Result<Self, NotPositiveDefinite> {
        let (n, b) = (a.order(), a.half_bandwidth());
        let width = WIDTHS.into_iter().find(|w| *w >= b).expect("a half bandwidth of at most 64");
        let p = n.saturating_sub(b) / 2;
        let (mut forward, mut inverse) = (vec![[0.0; 2]; p * width], vec![[0.0; 2]; p]);
        for i in 0..p {
            for lane in 0..2 {
                // Row r of this half's numbering is row `row(r)` of the matrix.
                let row = |r: usize| if lane == 0 { r } else { n - 1 - r };
                let d = a.get(row(i), row(i));
                if d <= 0.0 || !d.is_finite() {
                    return Err(NotPositiveDefinite { row: row(i), pivot: d });
                }
                inverse[i][lane] = 1.0 / d;
                for k in 1..=b {
                    let l = a.get(row(i + k), row(i)) / d;
                    forward[i * width + k - 1][lane] = l;
                    for m in 1..=k {
                        let lm = forward[i * width + m - 1][lane];
                        a.add(row(i + k), row(i + m), -l * lm * d);
                    }
                }
            }
        }
        let backward = (0..p * width).map(|at| {
            let (i, k) = (at / width, at % width + 1);
            if i >= k { forward[(i - k) * width + k - 1] } else { [0.0; 2] }
        });
        let backward: Vec<Pair> = backward.collect();
        let size = n - 2 * p;
        let entry = |i: usize, j: usize| if i.abs_diff(j) <= b { a.get(p + i, p + j) } else { 0.0 };
        let middle = DMatrix::from_fn(size, size, entry).cholesky();
        let middle = middle.ok_or(NotPositiveDefinite { row: p, pivot: f64::NAN })?.inverse();
        let [forward, inverse] = Repeating::both([forward, inverse], [width, 1], p);
        let backward = Repeating::new(backward, width, p);
        Ok(Self { p, width, forward, backward, inverse, middle: middle.as_slice().to_vec() })
    }

    /// x ← A⁻¹ x; allocates nothing.
    pub fn solve(&self, x: &mut [f64]) {
        match self.width {
            1 => self.solve_fixed::<1>(x),
            2 => self.solve_fixed::<2>(x),
            3 => self.solve_fixed::<3>(x),
            4 => self.solve_fixed::<4>(x),
            5 => self.solve_fixed::<5>(x),
            6 => self.solve_fixed::<6>(x),
            7 => self.solve_fixed::<7>(x),
            8 => self.solve_fixed::<8>(x),
            10 => self.solve_fixed::<10>(x),
            12 => self.solve_fixed::<12>(x),
            16 => self.solve_fixed::<16>(x),
            _ => self.solve_fixed::<64>(x),
        }
    }

    fn solve_fixed<const B: usize>(&self, x: &mut [f64]) {
        let (forward, _) = self.forward.kept().as_chunks::<B>();
        let (backward, _) = self.backward.kept().as_chunks::<B>();
        let (upper, rest) = x.split_at_mut(self.p);
        let (middle, lower) = rest.split_at_mut(rest.len() - self.p);
        let mut sweep = Sweep::<B>::default();
        for (rows, kept) in self.forward.parts() {
            let lower = lower[self.p - rows.end..self.p - rows.start].iter_mut().rev();
            let inverse = &self.inverse.kept()[kept.clone()];
            for (((u, l), row), d) in upper[rows].iter_mut().zip(lower).zip(&forward[kept]).zip(inverse) {
                let y = sweep.next([*u, *l], row);
                (*u, *l) = (y[0] * d[0], y[1] * d[1]);
            }
        }
        let size = middle.len();
        for k in 0..B.min(size) {
            let owed = sweep.owed(k);
            middle[k] -= owed[0];
            middle[size - 1 - k] -= owed[1];
        }
        let mut solved = [0.0; 66];
        for (solved, row) in solved.iter_mut().zip(self.middle.chunks_exact(size)) {
            *solved = row.iter().zip(&*middle).map(|(a, x)| a * x).sum();
        }
        middle.copy_from_slice(&solved[..size]);
        let mut sweep = Sweep::<B>::default();
        for k in 0..B.min(self.p) {
            // The k-th row before the middle holds coefficients of the middle's rows from its own distance on.
            let row = &forward[self.forward.place(self.p - 1 - k)];
            for m in 0..(B - k).min(size) {
                sweep.sums[k][0] += row[k + m][0] * middle[m];
                sweep.sums[k][1] += row[k + m][1] * middle[size - 1 - m];
            }
        }
        for (rows, kept) in self.backward.parts().rev() {
            let lower = lower[self.p - rows.end..self.p - rows.start].iter_mut().rev();
            for ((u, l), row) in upper[rows].iter_mut().zip(lower).zip(&backward[kept]).rev() {
                [*u, *l] = sweep.next([*u, *l], row);
            }
        }
    }
}

/// One substitution of both halves: what found unknowns take off the rows to come is added up in registers, and the newest
/// one's share of the next row is left for last, so that a row waits for one product and one difference only.
struct Sweep<const B: usize> {
    /// For the next B rows, without what the newest unknown takes off the very next.
    sums: [Pair; B],
    newest: Pair,
    nearest: Pair,
}

impl<const B: usize> Default for Sweep<B> {
    fn default() -> Self {
        Self { sums: [[0.0; 2]; B], newest: [0.0; 2], nearest: [0.0; 2] }
    }
}

impl<const B: usize> Sweep<B> {
    /// What is taken off the k-th row to come.
    fn owed(&self, k: usize) -> Pair {
        let near = |lane: usize| if k == 0 { self.nearest[lane] * self.newest[lane] } else { 0.0 };
        [self.sums[k][0] + near(0), self.sums[k][1] + near(1)]
    }

    /// The unknown of the next row, and its coefficients to the rows after it.
    fn next(&mut self, x: Pair, row: &[Pair; B]) -> Pair {
        let y = std::array::from_fn(|lane| (x[lane] - self.sums[0][lane]) - self.nearest[lane] * self.newest[lane]);
        for (k, coefficients) in row.iter().enumerate() {
            let carried = if k + 1 < B { self.sums[k + 1] } else { [0.0; 2] };
            let taken = |lane: usize| if k > 0 { coefficients[lane] * y[lane] } else { 0.0 };
            self.sums[k] = std::array::from_fn(|lane| carried[lane] + taken(lane));
        }
        (self.newest, self.nearest) = (y, row[0]);
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bandwidth_and_parity_solves_what_it_multiplies() {
        for b in (1..=10).chain([20]) {
            for n in [b + 1, b + 2, 3 * b + 5, 101, 102] {
                let a = crate::band::tests::random(n, b);
                let x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
                let mut y = vec![0.0; n];
                a.multiply_add(&x, &mut y);
                TwistedFactor::new(a).expect("positive definite").solve(&mut y);
                let error = x.iter().zip(&y).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(error < 1e-13, "half bandwidth {b}, order {n}: {error:e}");
            }
        }
    }
}
