//! Order and pattern of a supernodal factor.

use faer::perm::PermRef;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, SymbolicSupernodalParams};

use crate::error::FactorError;

/// Panels of up to so many columns are merged as long as so large a share of theirs becomes zeros: fewer, wider panels are
/// quicker to compute with, but a step reads the zeros too.
const RELAXED: &[(usize, f64)] = &[(8, 0.3), (32, 0.1), (usize::MAX, 0.02)];

/// Order and pattern of a supernodal factor.
pub struct Pattern {
    pub(super) cholesky: SymbolicCholesky<u32>,
    /// Degree of freedom of each row of L.
    pub order: Vec<u32>,
    /// Row of L of each degree of freedom.
    pub position: Vec<u32>,
    pub(super) columns: Vec<u32>,
    pub(super) row_starts: Vec<u32>,
    pub(super) rows: Vec<u32>,
    pub(super) value_starts: Vec<usize>,
    /// Rows of the highest panel.
    pub(super) height: usize,
}

impl std::fmt::Debug for Pattern {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Pattern").field("n", &self.order.len()).field("panels", &self.columns.len()).finish()
    }
}

impl Pattern {
    /// Analyses a pattern given by its lower triangle, to be eliminated in `order`.
    ///
    /// # Errors
    /// [`FactorError::Symbolic`] when memory or indices do not suffice.
    pub fn new(pattern: SymbolicSparseColMatRef<'_, u32>, order: Vec<u32>) -> Result<Self, FactorError> {
        let mut position = vec![0; order.len()];
        order.iter().enumerate().for_each(|(at, &dof)| position[dof as usize] = at as u32);
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            supernodal_params: SymbolicSupernodalParams { relax: Some(RELAXED) },
            ..Default::default()
        };
        let permutation = PermRef::new_checked(&order, &position, order.len());
        let ordering = SymmetricOrdering::Custom(permutation);
        let cholesky = factorize_symbolic_cholesky(pattern, faer::Side::Lower, ordering, parameters)
            .map_err(|e| FactorError::Symbolic(e.to_string()))?;
        let SymbolicCholeskyRaw::Supernodal(l) = cholesky.raw() else {
            return Err(FactorError::Symbolic("a supernodal factor was asked for".into()));
        };
        let mut columns = l.supernode_begin().to_vec();
        columns.push(order.len() as u32);
        let value_starts: Vec<usize> = l.col_ptr_for_val().iter().map(|at| *at as usize).collect();
        let (mut rows, mut row_starts, mut height) = (Vec::with_capacity(l.row_idx().len()), vec![0], 0);
        for s in 0..l.n_supernodes() {
            let pattern = l.supernode(s).pattern();
            rows.extend_from_slice(pattern);
            row_starts.push(rows.len() as u32);
            height = height.max(pattern.len() + (columns[s + 1] - columns[s]) as usize);
        }
        Ok(Self { columns, row_starts, rows, value_starts, height, cholesky, order, position })
    }

    /// y ← P x: into the order of elimination.
    pub fn gather(&self, x: &[f64], y: &mut [f64]) {
        y.iter_mut().zip(&self.order).for_each(|(y, &dof)| *y = x[dof as usize]);
    }

    /// x ← Pᵀ y: out of it.
    pub fn scatter(&self, y: &[f64], x: &mut [f64]) {
        y.iter().zip(&self.order).for_each(|(y, &dof)| x[dof as usize] = *y);
    }

    /// Number of panels.
    pub fn panels(&self) -> usize {
        self.columns.len() - 1
    }

    /// The panels that hold these degrees of freedom and all that follows from them up to the roots, ascending: outside
    /// them L⁻¹b is zero when b is zero elsewhere, and they alone give x there.
    pub fn reach(&self, dofs: impl IntoIterator<Item = u32>) -> Vec<u32> {
        let mut met = vec![false; self.panels()];
        for dof in dofs {
            let mut row = self.position[dof as usize];
            loop {
                let s = self.panel_of(row);
                if std::mem::replace(&mut met[s], true) {
                    break;
                }
                match self.rows.get(self.row_starts[s] as usize..self.row_starts[s + 1] as usize) {
                    Some([next, ..]) => row = *next,
                    _ => break,
                }
            }
        }
        (0..self.panels() as u32).filter(|&s| met[s as usize]).collect()
    }

    /// The last panel of the connected part that each panel belongs to.
    pub fn roots(&self) -> Vec<u32> {
        let mut roots: Vec<u32> = (0..self.panels() as u32).collect();
        for s in (0..self.panels()).rev() {
            let above = self.rows.get(self.row_starts[s] as usize..self.row_starts[s + 1] as usize);
            if let Some([next, ..]) = above {
                roots[s] = roots[self.panel_of(*next)];
            }
        }
        roots
    }

    /// The panel that holds a row of L.
    pub fn panel_of(&self, row: u32) -> usize {
        self.columns.partition_point(|&begin| begin <= row) - 1
    }

    /// The columns of a panel, which are rows of L.
    pub fn columns_of(&self, panel: u32) -> std::ops::Range<usize> {
        self.columns[panel as usize] as usize..self.columns[panel as usize + 1] as usize
    }

    /// Numbers of L in all panels.
    pub fn entries(&self) -> usize {
        self.value_starts.last().copied().unwrap_or(0)
    }
}
