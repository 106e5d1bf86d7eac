//! Sparse symmetric matrices.

/// The lower triangle of a symmetric matrix, by columns.
///
/// Rows rise strictly within a column; duplicates are summed and zeros off the diagonal left out. A diagonal entry comes
/// first in its column where there is one.
#[derive(Clone, Debug, PartialEq)]
pub struct SymmetricMatrix {
    /// Number of rows.
    pub n: usize,
    /// Where each column begins in `rows` and `values`, and their length: n + 1 numbers.
    pub starts: Vec<usize>,
    /// Row of every entry, from 0.
    pub rows: Vec<u32>,
    /// Every entry.
    pub values: Vec<f64>,
}

impl SymmetricMatrix {
    /// Rows and values of a column.
    pub fn column(&self, j: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.starts[j]..self.starts[j + 1];
        self.rows[range.clone()].iter().zip(&self.values[range]).map(|(&i, &value)| (i as usize, value))
    }

    /// Stored entries.
    pub fn entries(&self) -> usize {
        self.rows.len()
    }

    /// The diagonal, zero where it is not stored.
    pub fn diagonal(&self) -> Vec<f64> {
        let first = |j| self.column(j).next().filter(|(i, _)| *i == j);
        (0..self.n).map(|j| first(j).map_or(0.0, |(_, value)| value)).collect()
    }

    /// Rows without an entry other than 0, rising.
    pub(crate) fn empty_rows(&self) -> Vec<u32> {
        let mut used = vec![false; self.n];
        for j in 0..self.n {
            for (i, _) in self.column(j).filter(|(_, value)| *value != 0.0) {
                (used[i], used[j]) = (true, true);
            }
        }
        (0..self.n as u32).filter(|&row| !used[row as usize]).collect()
    }

    /// Gives empty rows a diagonal.
    pub(crate) fn hold(&mut self, empty: &[u32], value: f64) {
        let old = std::mem::replace(self, Self { n: self.n, starts: vec![0], rows: Vec::new(), values: Vec::new() });
        for j in 0..old.n {
            if empty.binary_search(&(j as u32)).is_ok() {
                self.rows.push(j as u32);
                self.values.push(value);
            } else {
                let column = old.starts[j]..old.starts[j + 1];
                self.rows.extend_from_slice(&old.rows[column.clone()]);
                self.values.extend_from_slice(&old.values[column]);
            }
            self.starts.push(self.rows.len());
        }
    }

    /// The product A x.
    pub fn product(&self, x: &[f64]) -> Vec<f64> {
        self.fold(x, |a| a)
    }

    /// |A| |x|, entry by entry: the scale against which a product that should vanish is judged.
    pub(crate) fn magnitude(&self, x: &[f64]) -> Vec<f64> {
        let x: Vec<f64> = x.iter().map(|x| x.abs()).collect();
        self.fold(&x, f64::abs)
    }

    fn fold(&self, x: &[f64], of: impl Fn(f64) -> f64) -> Vec<f64> {
        let mut y = vec![0.0; self.n];
        for j in 0..self.n {
            let mut yj = 0.0;
            for (i, a) in self.column(j) {
                let a = of(a);
                if i != j {
                    y[i] += a * x[j];
                }
                yj += a * x[i];
            }
            y[j] += yj;
        }
        y
    }
}
