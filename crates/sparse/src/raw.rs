//! A [`Pencil`] as plain numbers, to be stored and read again.

use faer::sparse::SymbolicSparseColMat;

use crate::entries::Entry;
use crate::error::FactorError;
use crate::order::layout::Layout;
use crate::pencil::Pencil;
use crate::symbolic::Symbolic;
use crate::symmetric::Symmetric;

/// The numbers of a [`Pencil`], to be stored.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub struct Raw {
    /// Starts of the columns of the lower triangle, and its end.
    pub starts: Vec<u32>,
    /// Rows, the diagonal first in each column.
    pub rows: Vec<u32>,
    /// Numbers of K, in the order of `rows`.
    pub k: Vec<f64>,
    /// Numbers of M, in the same order.
    pub m: Vec<f64>,
    /// Entries (row, column, number) of C by columns.
    pub damping: Vec<(u32, u32, f64)>,
    /// Order of elimination; empty for small models.
    pub order: Vec<u32>,
}

impl Pencil {
    /// Everything, to be stored.
    pub fn raw(&self) -> Raw {
        let order = self.order().unwrap_or_default().to_vec();
        let (starts, rows) = (self.pattern.col_ptr().to_vec(), self.pattern.row_idx().to_vec());
        Raw { starts, rows, k: self.k.clone(), m: self.m.clone(), damping: self.damping.entries().collect(), order }
    }

    /// From what was stored.
    ///
    /// # Errors
    /// [`FactorError::Symbolic`]: the numbers are no lower triangle with its diagonal.
    pub fn from_raw(raw: Raw) -> Result<Self, FactorError> {
        let Raw { starts, rows, k, m, damping, order } = raw;
        let n = starts.len().saturating_sub(1);
        let broken = |why: &str| FactorError::Symbolic(format!("stored matrices: {why}"));
        if starts.first() != Some(&0) || starts[n] as usize != rows.len() || [k.len(), m.len()] != [rows.len(); 2] {
            return Err(broken("lengths differ"));
        }
        let column = |j: usize| rows.get(starts[j] as usize..starts[j + 1] as usize);
        let sound = |j: usize| {
            column(j).is_some_and(|c| {
                c.first() == Some(&(j as u32)) && c.is_sorted_by(|a, b| a < b) && c.iter().all(|i| (*i as usize) < n)
            })
        };
        if !(0..n).all(sound) {
            return Err(broken("a column is no column of a lower triangle"));
        }
        let mut known = vec![false; n];
        for dof in &order {
            known.get_mut(*dof as usize).into_iter().for_each(|known| *known = true);
        }
        if !order.is_empty() && (order.len() != n || !known.iter().all(|known| *known)) {
            return Err(broken("the order is no permutation"));
        }
        let entry = |(row, column, k): (u32, u32, f64)| Entry { column, row, k, m: 0.0 };
        if damping.iter().any(|&(i, j, _)| (j as usize) >= n || !column(j as usize).is_some_and(|c| c.contains(&i))) {
            return Err(broken("an entry of C is off the pattern"));
        }
        let damping = Symmetric::new(n, damping.into_iter().map(entry));
        let by_columns = (0..n).flat_map(|j| (starts[j] as usize..starts[j + 1] as usize).map(move |at| (at, j)));
        let masses = by_columns.map(|(at, j)| Entry { column: j as u32, row: rows[at], k: m[at], m: 0.0 });
        let mass = Symmetric::new(n, masses);
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        let symbolic = Symbolic::new(pattern.as_ref(), &Layout { order, ..Layout::default() })?;
        Ok(Self { pattern, k, m, mass, damping, symbolic })
    }
}
