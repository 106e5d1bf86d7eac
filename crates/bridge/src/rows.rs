//! Rows of weights over the unknowns: what the outside sees of the structure, and where its forces act.

use ttb_dynamics::dense::Dense;

use crate::compliance::Compliance;
use crate::deck::Row;
use crate::local::Local;

/// The entries of a vector that are not zero.
pub fn sparse(values: &[f64]) -> Row {
    (0..).zip(values.iter().copied()).filter(|(_, value)| *value != 0.0).collect()
}

/// A list of rows: sparse over degrees of freedom, or by the coordinates φ_j of a reduced model.
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
    /// Coordinate by coordinate: row j is R φ_j.
    Modal(Dense),
    /// The same in single precision: of a reduced model, whose error is greater.
    Single(Dense<f32>),
    /// Of modes and local coordinates.
    Local(Local),
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
            Self::Modal(shapes) => shapes.columns(),
            Self::Single(shapes) => shapes.columns(),
            Self::Local(local) => local.rows(),
        }
    }

    /// No rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Degrees of freedom of a sparse row; of modal coordinates none.
    pub fn columns(&self, i: usize) -> &[u32] {
        match self {
            Self::Sparse { starts, columns, .. } => &columns[starts[i] as usize..starts[i + 1] as usize],
            Self::Modal(_) | Self::Single(_) | Self::Local(_) => &[],
        }
    }

    /// Weights of a sparse row in the order of its columns.
    pub fn weights(&self, i: usize) -> &[f64] {
        match self {
            Self::Sparse { starts, weights, .. } => &weights[starts[i] as usize..starts[i + 1] as usize],
            Self::Modal(_) | Self::Single(_) | Self::Local(_) => &[],
        }
    }

    /// Row i times u.
    pub fn dot(&self, i: usize, u: &[f64]) -> f64 {
        match self {
            Self::Sparse { .. } => {
                let row = self.columns(i).iter().zip(self.weights(i));
                row.map(|(&column, weight)| weight * u[column as usize]).sum()
            }
            Self::Modal(shapes) => u.iter().enumerate().map(|(j, u)| shapes.row(j)[i] * u).sum(),
            Self::Single(shapes) => u.iter().enumerate().map(|(j, u)| f64::from(shapes.row(j)[i]) * u).sum(),
            Self::Local(local) => local.dot(i, u),
        }
    }

    /// r ← R u.
    pub fn multiply(&self, u: &[f64], r: &mut [f64]) {
        match self {
            Self::Sparse { .. } => r.iter_mut().enumerate().for_each(|(i, r)| *r = self.dot(i, u)),
            Self::Modal(_) | Self::Single(_) | Self::Local(_) => {
                r.fill(0.0);
                self.fold(&[], |j, _| [u[j]], [r]);
            }
        }
    }

    /// load ← load + Bᵀ f, B the first rows, as many as there are forces; of local coordinates what drives them.
    pub fn add_transposed(&self, f: &[f64], load: &mut [f64]) {
        match self {
            Self::Sparse { .. } => {
                for (i, f) in f.iter().enumerate() {
                    let row = self.columns(i).iter().zip(self.weights(i));
                    row.for_each(|(&column, weight)| load[column as usize] += weight * f);
                }
            }
            Self::Modal(_) | Self::Single(_) | Self::Local(_) => {
                let add = |j: usize, p: f64| {
                    load[j] += p;
                    []
                };
                self.fold(f, add, []);
            }
        }
    }

    /// [`Dense::fold`] over the coordinates; nothing for sparse rows.
    pub fn fold<const N: usize>(&self, x: &[f64], weights: impl FnMut(usize, f64) -> [f64; N], y: [&mut [f64]; N]) {
        match self {
            Self::Sparse { .. } => {}
            Self::Modal(shapes) => shapes.fold(x, weights, y),
            Self::Single(shapes) => shapes.fold(x, weights, y),
            Self::Local(local) => local.fold(x, weights, y),
        }
    }

    /// R Φ diag(w) (BΦ)ᵀ, B the first `supports` rows; none for sparse rows.
    pub fn compliance(&self, w: &[f64], supports: usize) -> Option<Compliance> {
        match self {
            Self::Sparse { .. } => None,
            Self::Modal(shapes) => Some(Compliance::Dense(shapes.weighted_gram(w, supports))),
            Self::Single(shapes) => Some(Compliance::Dense(shapes.weighted_gram(w, supports))),
            Self::Local(local) => Some(Compliance::Near(local.compliance(w))),
        }
    }

    /// fᵀ B u, B the first rows, as many as there are forces.
    pub fn dot_transposed(&self, f: &[f64], u: &[f64]) -> f64 {
        f.iter().enumerate().map(|(i, f)| f * self.dot(i, u)).sum()
    }

    /// The same rows over modal coordinates: R Φ.
    pub fn project(&self, shapes: &[Vec<f64>]) -> Self {
        let numbers = shapes.iter().flat_map(|shape| (0..self.len()).map(|i| self.dot(i, shape)));
        Self::Modal(Dense::new(self.len(), numbers.collect()))
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
