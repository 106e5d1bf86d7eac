//! Rows of weights over the unknowns: what the outside sees of the structure, and where its forces act.

use ttb_dynamics::dense::Dense;
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
    Dense(Dense),
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
            Self::Dense(rows) => rows.rows(),
        }
    }

    /// No rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Degrees of freedom of a sparse row; of a dense one none.
    pub fn columns(&self, i: usize) -> &[u32] {
        match self {
            Self::Sparse { starts, columns, .. } => &columns[starts[i] as usize..starts[i + 1] as usize],
            Self::Dense(_) => &[],
        }
    }

    /// Weights of a sparse row in the order of its columns; all of a dense one.
    pub fn weights(&self, i: usize) -> &[f64] {
        match self {
            Self::Sparse { starts, weights, .. } => &weights[starts[i] as usize..starts[i + 1] as usize],
            Self::Dense(rows) => rows.row(i),
        }
    }

    /// Row i times u.
    pub fn dot(&self, i: usize, u: &[f64]) -> f64 {
        match self {
            Self::Sparse { .. } => {
                let row = self.columns(i).iter().zip(self.weights(i));
                row.map(|(&column, weight)| weight * u[column as usize]).sum()
            }
            Self::Dense(rows) => dot(rows.row(i), u),
        }
    }

    /// All rows times several u; dense rows are read once.
    pub fn multiply<const N: usize>(&self, u: [&[f64]; N], r: [&mut [f64]; N]) {
        match self {
            Self::Sparse { .. } => {
                for (r, u) in r.into_iter().zip(u) {
                    r.iter_mut().enumerate().for_each(|(i, r)| *r = self.dot(i, u));
                }
            }
            Self::Dense(rows) => rows.multiply(u, r),
        }
    }

    /// load ← load + f · row i.
    pub fn add_row(&self, i: usize, f: f64, load: &mut [f64]) {
        match self {
            Self::Sparse { .. } => {
                for (&column, weight) in self.columns(i).iter().zip(self.weights(i)) {
                    load[column as usize] += weight * f;
                }
            }
            Self::Dense(rows) => add_scaled(f, rows.row(i), load),
        }
    }

    /// load ← load + Bᵀ f, B the first rows, as many as there are forces.
    pub fn add_transposed(&self, f: &[f64], load: &mut [f64]) {
        match self {
            Self::Sparse { .. } => f.iter().enumerate().for_each(|(i, f)| self.add_row(i, *f, load)),
            Self::Dense(rows) => rows.add_transposed(f, load),
        }
    }

    /// fᵀ B u, B the first rows, as many as there are forces.
    pub fn dot_transposed(&self, f: &[f64], u: &[f64]) -> f64 {
        f.iter().enumerate().map(|(i, f)| f * self.dot(i, u)).sum()
    }

    /// The same rows over modal coordinates: R Φ.
    pub fn project(&self, shapes: &[Vec<f64>]) -> Self {
        let numbers = (0..self.len()).flat_map(|i| shapes.iter().map(move |shape| self.dot(i, shape)));
        Self::Dense(Dense::new(shapes.len(), numbers.collect()))
    }

    /// The same sparse rows over unknowns in another order: column c becomes `position[c]`.
    pub fn renumbered(&self, position: &[u32]) -> Self {
        let mut rows = self.clone();
        if let Self::Sparse { columns, .. } = &mut rows {
            columns.iter_mut().for_each(|c| *c = position[*c as usize]);
        }
        rows
    }
}
