//! Rows of weights over the degrees of freedom: what the outside sees of the structure, and where its forces act.

use ttb_dynamics::modes::Modes;
use ttb_dynamics::vector::{add_scaled, dot};

use crate::deck::Row;

/// A list of rows: sparse over degrees of freedom, or dense over modal coordinates.
#[derive(Clone, Debug)]
pub enum Rows {
    /// Compressed: row i has the columns and weights from `starts[i]` to `starts[i + 1]`.
    Sparse {
        /// One more than rows.
        starts: Vec<u32>,
        /// Degrees of freedom.
        columns: Vec<u32>,
        /// Their weights.
        weights: Vec<f64>,
    },
    /// Every row in full.
    Dense(Vec<Vec<f64>>),
}

impl Rows {
    /// From sparse rows.
    pub fn new(rows: &[Row]) -> Self {
        let (columns, weights) = rows.iter().flatten().copied().unzip();
        let mut starts = vec![0];
        let mut end = 0;
        starts.extend(rows.iter().map(|row| {
            end += row.len() as u32;
            end
        }));
        Self::Sparse { starts, columns, weights }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Sparse { starts, .. } => starts.len() - 1,
            Self::Dense(rows) => rows.len(),
        }
    }

    /// No rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Row i times u.
    pub fn dot(&self, i: usize, u: &[f64]) -> f64 {
        match self {
            Self::Sparse { starts, columns, weights } => {
                let range = starts[i] as usize..starts[i + 1] as usize;
                let row = columns[range.clone()].iter().zip(&weights[range]);
                row.map(|(&column, weight)| weight * u[column as usize]).sum()
            }
            Self::Dense(rows) => dot(&rows[i], u),
        }
    }

    /// load ← load + Rowsᵀ f.
    pub fn add_transposed(&self, f: &[f64], load: &mut [f64]) {
        match self {
            Self::Sparse { starts, columns, weights } => {
                for (f, bounds) in f.iter().zip(starts.windows(2)) {
                    let range = bounds[0] as usize..bounds[1] as usize;
                    for (&column, weight) in columns[range.clone()].iter().zip(&weights[range]) {
                        load[column as usize] += weight * f;
                    }
                }
            }
            Self::Dense(rows) => f.iter().zip(rows).for_each(|(f, row)| add_scaled(*f, row, load)),
        }
    }

    /// The same rows over modal coordinates: Rows Φ.
    pub fn project(&self, modes: &Modes) -> Self {
        let row = |i| modes.shapes.iter().map(|shape| self.dot(i, shape)).collect();
        Self::Dense((0..self.len()).map(row).collect())
    }
}
