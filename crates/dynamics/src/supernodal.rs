//! Supernodal Cholesky factorisation P A Pᵀ = L Lᵀ for large models: symbolic once, numeric often.
//!
//! faer computes the numbers; the order is [`crate::order`]'s and the sweeps are [`crate::sweeps`]'.

use faer::Par;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, SymbolicSupernodalParams};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};

use crate::factor::FactorError;
use crate::sweeps::{LANES, Panels, Which};

/// Panels of up to so many columns are merged as long as so large a share of theirs becomes zeros: fewer, wider panels are
/// quicker to compute with, but a step reads the zeros too.
const RELAXED: &[(usize, f64)] = &[(8, 0.3), (32, 0.1), (usize::MAX, 0.02)];

/// Order and pattern of a supernodal factor.
pub struct Pattern {
    cholesky: SymbolicCholesky<u32>,
    /// Degree of freedom of each row of L.
    pub order: Vec<u32>,
    /// Row of L of each degree of freedom.
    pub position: Vec<u32>,
    columns: Vec<u32>,
    row_starts: Vec<u32>,
    rows: Vec<u32>,
    value_starts: Vec<usize>,
    /// Rows of the highest panel.
    height: usize,
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

/// Memory that faer works in.
fn scratch(size: StackReq) -> Result<MemBuffer, FactorError> {
    MemBuffer::try_new(size).map_err(|_| FactorError::Symbolic("there is not enough memory".into()))
}

/// The numbers of a factor.
#[derive(Clone, Debug)]
pub struct Numbers {
    values: Vec<f64>,
    inverse_diagonal: Vec<f64>,
}

impl Pattern {
    /// Factorises a positive definite `a` (lower triangle, of the analysed pattern, the diagonal first in each column).
    ///
    /// # Errors
    /// [`FactorError::NotPositive`] when a pivot is below `least_pivot` times its diagonal entry.
    pub fn factorise(&self, a: SparseColMatRef<'_, u32, f64>, least_pivot: f64) -> Result<Numbers, FactorError> {
        let mut numbers = Numbers {
            values: vec![0.0; self.cholesky.len_val()],
            inverse_diagonal: Vec::with_capacity(self.order.len()),
        };
        self.factorise_into(a, least_pivot, &mut numbers)?;
        Ok(numbers)
    }

    /// As [`Pattern::factorise`], into the memory of a factor of the same pattern.
    ///
    /// # Errors
    /// As there; the numbers are then of no use.
    pub fn factorise_into(
        &self,
        a: SparseColMatRef<'_, u32, f64>,
        least_pivot: f64,
        numbers: &mut Numbers,
    ) -> Result<(), FactorError> {
        let (cholesky, par) = (&self.cholesky, Par::Seq);
        let Numbers { values, inverse_diagonal } = numbers;
        let mut memory = scratch(cholesky.factorize_numeric_llt_scratch::<f64>(par, Default::default()))?;
        cholesky
            .factorize_numeric_llt(
                values,
                a,
                faer::Side::Lower,
                Default::default(),
                par,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|LltError::NonPositivePivot { index }| FactorError::at_pivot(index, &self.order))?;
        inverse_diagonal.clear();
        for (column, diagonal) in self.diagonal().enumerate() {
            let l = values[diagonal];
            let dof = self.order[column] as usize;
            let of_a = a.val()[a.col_ptr()[dof] as usize];
            let positive = l * l > least_pivot * of_a;
            if !positive {
                return Err(FactorError::NotPositive { dof });
            }
            inverse_diagonal.push(1.0 / l);
        }
        Ok(())
    }

    /// Number of negative eigenvalues of `a`, from its L D Lᵀ without pivoting.
    ///
    /// # Errors
    /// A pivot is zero.
    pub fn count_negative(&self, a: SparseColMatRef<'_, u32, f64>) -> Result<usize, FactorError> {
        let (cholesky, par) = (&self.cholesky, Par::Seq);
        let mut values = vec![0.0; cholesky.len_val()];
        let mut memory = scratch(cholesky.factorize_numeric_ldlt_scratch::<f64>(par, Default::default()))?;
        cholesky
            .factorize_numeric_ldlt(
                &mut values,
                a,
                faer::Side::Lower,
                LdltRegularization::default(),
                par,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|LdltError::ZeroPivot { index }| FactorError::at_pivot(index, &self.order))?;
        Ok(self.diagonal().filter(|&at| values[at] < 0.0).count())
    }

    /// Where the diagonal of L stands in the numbers, by columns.
    fn diagonal(&self) -> impl Iterator<Item = usize> {
        (0..self.panels()).flat_map(move |s| {
            let width = (self.columns[s + 1] - self.columns[s]) as usize;
            let height = width + (self.row_starts[s + 1] - self.row_starts[s]) as usize;
            (0..width).map(move |j| self.value_starts[s] + j * height + j)
        })
    }

    fn panels_of<'a>(&'a self, numbers: &'a Numbers) -> Panels<'a> {
        Panels {
            columns: &self.columns,
            row_starts: &self.row_starts,
            rows: &self.rows,
            value_starts: &self.value_starts,
            values: &numbers.values,
            inverse_diagonal: &numbers.inverse_diagonal,
        }
    }

    /// y ← L⁻¹ y (in the order of elimination) over `which` panels.
    pub fn forward(&self, numbers: &Numbers, y: &mut [f64], buffer: &mut Vec<f64>, which: Which) {
        buffer.resize(self.height, 0.0);
        self.panels_of(numbers).forward(y, buffer, which);
    }

    /// y ← L⁻ᵀ y (in the order of elimination) over `which` panels.
    pub fn backward(&self, numbers: &Numbers, y: &mut [f64], buffer: &mut Vec<f64>, which: Which) {
        buffer.resize(self.height, 0.0);
        self.panels_of(numbers).backward(y, buffer, which);
    }

    /// As [`Pattern::forward`] for groups of [`LANES`] right-hand sides, interleaved.
    pub fn forward_many(&self, numbers: &Numbers, y: &mut [f64], buffer: &mut Vec<f64>, which: Which) {
        buffer.resize(self.height * LANES, 0.0);
        self.panels_of(numbers).forward_many(y, buffer, which);
    }

    /// As [`Pattern::backward`] for groups of [`LANES`] right-hand sides, interleaved.
    pub fn backward_many(&self, numbers: &Numbers, y: &mut [f64], buffer: &mut Vec<f64>, which: Which) {
        buffer.resize(self.height * LANES, 0.0);
        self.panels_of(numbers).backward_many(y, buffer, which);
    }
}
