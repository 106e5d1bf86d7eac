//! Symmetric positive definite matrices whose entries, and those of their inverse, decay away from the diagonal: what
//! axles of a long train have to do with each other.
//!
//! ```text
//! A = L Lᵀ,   L y = b,   Lᵀ x = y        column j of L holds the rows j … j + reach
//! ```
//!
//! All is done in the order of a dense Cholesky by columns, with the entries beyond `reach` left out that are zero there:
//! the results are those of the dense method to the last bit, at a cost that grows with the order alone.

/// An entry of an inverse this much below the largest of its column is left out. Nothing that it is added to notices.
pub const NEGLIGIBLE: f64 = 1e-40;
/// Terms that a dot product adds side by side.
const LANES: usize = 8;

/// The lower triangle of a matrix, by columns.
#[derive(Clone, Debug)]
pub struct Decaying {
    n: usize,
    reach: usize,
    columns: Vec<f64>,
}

impl Decaying {
    /// Zeros of order `n` with entries up to `reach` below the diagonal.
    pub fn zeros(n: usize, reach: usize) -> Self {
        let reach = reach.next_multiple_of(LANES);
        Self { n, reach, columns: vec![0.0; n * (reach + 1)] }
    }

    /// Adds to the entry in row i, column j ≤ i.
    pub fn add(&mut self, i: usize, j: usize, value: f64) {
        self.columns[j * (self.reach + 1) + i - j] += value;
    }

    /// The rows below the diagonal that column j has.
    fn below(&self, j: usize) -> usize {
        self.reach.min(self.n - 1 - j)
    }

    /// L; `None` if a pivot is not positive.
    pub fn factorise(mut self) -> Option<Factor> {
        let width = self.reach + 1;
        for j in 0..self.n {
            for k in j.saturating_sub(self.reach)..j {
                let (before, column) = self.columns.split_at_mut(j * width);
                let pivots = &before[k * width + j - k..(k + 1) * width];
                let factor = -pivots[0];
                column.iter_mut().zip(pivots).for_each(|(a, l)| *a += factor * l);
            }
            let below = self.below(j);
            let column = &mut self.columns[j * width..(j + 1) * width];
            let pivot = column[0].sqrt();
            if column[0].is_nan() || column[0] <= 0.0 {
                return None;
            }
            column[0] = pivot;
            column[1..=below].iter_mut().for_each(|a| *a /= pivot);
        }
        Some(Factor(self))
    }
}

/// L of a [`Decaying`].
#[derive(Clone, Debug)]
pub struct Factor(Decaying);

impl Factor {
    /// Column j of L from the diagonal down.
    fn column(&self, j: usize) -> &[f64] {
        let begin = j * (self.0.reach + 1);
        &self.0.columns[begin..=begin + self.0.below(j)]
    }

    /// x ← A⁻¹ x.
    pub fn solve(&self, x: &mut [f64]) {
        (0..self.0.n).for_each(|i| self.forward(x, i));
        (0..self.0.n).rev().for_each(|i| self.backward(x, i));
    }

    /// Column j of A⁻¹, written to `column` (zero elsewhere, also on entry), and the rows where it is not negligible.
    pub fn inverse(&self, j: usize, column: &mut [f64]) -> std::ops::Range<usize> {
        let n = self.0.n;
        column[j] = 1.0;
        let mut decay = Decay { count: 0, reach: self.0.reach, largest: 0.0 };
        let mut end = j;
        while end < n && !decay.is_over() {
            self.forward(column, end);
            decay.meet(column[end]);
            end += 1;
        }
        column[end..(end + self.0.reach).min(n)].fill(0.0);
        (decay.count, decay.largest) = (0, 0.0);
        let mut begin = end;
        while begin > 0 && !(begin <= j && decay.is_over()) {
            begin -= 1;
            self.backward(column, begin);
            decay.meet(column[begin]);
        }
        begin..end
    }

    fn forward(&self, x: &mut [f64], i: usize) {
        let column = self.column(i);
        let y = x[i] / column[0];
        x[i] = y;
        x[i + 1..].iter_mut().zip(&column[1..]).for_each(|(x, l)| *x += -y * l);
    }

    fn backward(&self, x: &mut [f64], i: usize) {
        let column = self.column(i);
        x[i] = (x[i] - dot(&column[1..], &x[i + 1..])) / column[0];
    }
}

/// Whether a column has decayed: as many negligible entries in succession as another can be reached from.
struct Decay {
    count: usize,
    reach: usize,
    largest: f64,
}

impl Decay {
    fn meet(&mut self, entry: f64) {
        self.largest = self.largest.max(entry.abs());
        // NaN is not negligible.
        self.count = if entry.abs() < NEGLIGIBLE * self.largest { self.count + 1 } else { 0 };
    }
    fn is_over(&self) -> bool {
        self.count > self.reach
    }
}

/// Σ a b, eight sums side by side.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a, rest_a) = a.as_chunks::<LANES>();
    let (b, rest_b) = b[..LANES * a.len() + rest_a.len()].as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        (0..LANES).for_each(|lane| sums[lane] += a[lane] * b[lane]);
    }
    let side_by_side: f64 = (0..LANES / 2).fold(0.0, |sum, lane| sum + (sums[lane] + sums[lane + LANES / 2]));
    rest_a.iter().zip(rest_b).fold(side_by_side, |sum, (a, b)| sum + a * b)
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    /// I plus entries that decay by a factor an entry, exactly zero from `reach` on.
    fn matrix(n: usize, reach: usize, decay: f64) -> (Decaying, DMatrix<f64>) {
        let entry = |i: usize, j: usize| {
            let (i, j) = (i.max(j), i.min(j));
            let far = i - j;
            if far > reach {
                0.0
            } else {
                (1.0 + 0.1 * (i as f64).sin()) * decay.powi(far as i32) + f64::from(far == 0)
            }
        };
        let mut own = Decaying::zeros(n, reach);
        (0..n).for_each(|j| (j..n.min(j + reach + 1)).for_each(|i| own.add(i, j, entry(i, j))));
        (own, DMatrix::from_fn(n, n, entry))
    }

    #[test]
    fn solutions_are_those_of_the_dense_method_to_the_last_bit() {
        for (n, reach) in [(1, 0), (5, 3), (40, 1), (40, 13), (61, 16), (33, 32), (100, 24)] {
            let (own, dense) = matrix(n, reach, 0.4);
            let b = DVector::from_fn(n, |i, _| (3.0 * i as f64).cos());
            let mut x = b.as_slice().to_vec();
            own.factorise().unwrap().solve(&mut x);
            assert_eq!(x, dense.cholesky().unwrap().solve(&b).as_slice(), "order {n}, reach {reach}");
        }
    }

    #[test]
    fn columns_of_the_inverse_leave_out_nothing_that_can_be_seen() {
        let (own, dense) = matrix(400, 20, 0.4);
        let (factor, inverse) = (own.factorise().unwrap(), dense.cholesky().unwrap().inverse());
        let mut column = vec![0.0; 400];
        let mut longest = 0;
        for j in 0..400 {
            let rows = factor.inverse(j, &mut column);
            longest = longest.max(rows.len());
            for i in 0..400 {
                // The last bit of what is above 1e-20.
                let (own, dense) = (column[i], inverse[(i, j)]);
                assert!((own - dense).abs() < 1e-38, "({i}, {j}): {own} {dense}");
            }
            column[rows].fill(0.0);
        }
        assert!(longest < 330, "{longest} rows");
    }

    #[test]
    fn what_is_not_positive_definite_has_no_factor() {
        for bad in [0.0, -1.0, f64::NAN] {
            let mut a = Decaying::zeros(3, 1);
            (0..3).for_each(|i| a.add(i, i, if i == 1 { bad } else { 1.0 }));
            assert!(a.factorise().is_none(), "{bad}");
        }
    }
}
