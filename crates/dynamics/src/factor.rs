//! Sparse factorisation P A Pᵀ = L D Lᵀ with the approximate-minimum-degree order; symbolic once, numeric often.
//!
//! The numbers come from faer's simplicial factorisation; the two triangular sweeps are our own loops over its factor,
//! because for the few hundred degrees of freedom of a plane model the general solver's overhead costs more than the
//! arithmetic. A supernodal kernel for large models can replace the inside of [`Factor`] without touching its users.

use std::sync::Arc;

use faer::Par;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};

/// Why a matrix cannot be factorised.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FactorError {
    /// Not positive definite.
    #[error("degree of freedom {dof} has no stiffness left (a mechanism, or far too fine a mesh)")]
    NotPositive {
        /// The degree of freedom that moves without any force once those eliminated before it follow.
        dof: usize,
    },
    /// The symbolic analysis failed.
    #[error("the sparse factorisation cannot be prepared: {0}")]
    Symbolic(String),
}

/// A pivot below this times its diagonal entry is rounding, not stiffness. The bending of a beam of n elements leaves
/// about 2/n³, which is still larger for 25,000 elements.
const LEAST_PIVOT: f64 = 1e-13;

/// Order and pattern of the factor.
pub struct Symbolic {
    cholesky: SymbolicCholesky<u32>,
    /// Degree of freedom of each row of the factor.
    order: Vec<u32>,
    /// Columns of L below the diagonal.
    starts: Vec<u32>,
    rows: Vec<u32>,
}

impl std::fmt::Debug for Symbolic {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Symbolic").field("n", &self.order.len()).field("entries", &self.rows.len()).finish()
    }
}

impl Symbolic {
    /// Analyses a pattern given by its lower triangle.
    ///
    /// # Errors
    /// [`FactorError::Symbolic`] when memory or indices do not suffice.
    pub fn new(pattern: SymbolicSparseColMatRef<'_, u32>) -> Result<Self, FactorError> {
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SIMPLICIAL,
            ..Default::default()
        };
        let cholesky = factorize_symbolic_cholesky(pattern, faer::Side::Lower, SymmetricOrdering::Amd, parameters)
            .map_err(|e| FactorError::Symbolic(e.to_string()))?;
        let n = pattern.ncols();
        let order = cholesky.perm().map_or_else(|| (0..n as u32).collect(), |perm| perm.arrays().0.to_vec());
        let SymbolicCholeskyRaw::Simplicial(l) = cholesky.raw() else {
            return Err(FactorError::Symbolic("a simplicial factor was asked for".into()));
        };
        let (mut starts, mut rows) = (vec![0], Vec::with_capacity(l.len_val() - n));
        for column in l.col_ptr().windows(2) {
            rows.extend_from_slice(&l.row_idx()[column[0] as usize + 1..column[1] as usize]);
            starts.push(rows.len() as u32);
        }
        Ok(Self { cholesky, order, starts, rows })
    }
}

/// L and D.
#[derive(Clone, Debug)]
pub struct Factor {
    symbolic: Arc<Symbolic>,
    /// L below the diagonal, by columns.
    l: Vec<f64>,
    /// 1/D.
    inverse_d: Vec<f64>,
}

impl Factor {
    /// Factorises `a` (lower triangle, of the analysed pattern), definite or not: no pivoting.
    ///
    /// # Errors
    /// A pivot is zero or not finite.
    pub fn indefinite(symbolic: &Arc<Symbolic>, a: SparseColMatRef<'_, u32, f64>) -> Result<Self, FactorError> {
        let (cholesky, par) = (&symbolic.cholesky, Par::Seq);
        let mut values = vec![0.0; cholesky.len_val()];
        let mut memory = MemBuffer::new(cholesky.factorize_numeric_ldlt_scratch::<f64>(par, Default::default()));
        let none = LdltRegularization::default();
        cholesky
            .factorize_numeric_ldlt(
                &mut values,
                a,
                faer::Side::Lower,
                none,
                par,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|LdltError::ZeroPivot { index }| {
                let row = index.saturating_sub(1); // faer counts pivots from 1
                FactorError::NotPositive { dof: symbolic.order.get(row).map_or(row, |dof| *dof as usize) }
            })?;
        let (mut l, mut inverse_d) =
            (Vec::with_capacity(symbolic.rows.len()), Vec::with_capacity(symbolic.order.len()));
        let mut values = values.into_iter();
        for column in symbolic.starts.windows(2) {
            inverse_d.extend(values.next().map(|d| 1.0 / d));
            l.extend(values.by_ref().take((column[1] - column[0]) as usize));
        }
        Ok(Self { symbolic: Arc::clone(symbolic), l, inverse_d })
    }

    /// Factorises `a` (lower triangle, of the analysed pattern, with its diagonal first in each column).
    ///
    /// # Errors
    /// [`FactorError::NotPositive`] when it is not positive definite by a margin above rounding.
    pub fn positive(symbolic: &Arc<Symbolic>, a: SparseColMatRef<'_, u32, f64>) -> Result<Self, FactorError> {
        let factor = Self::indefinite(symbolic, a)?;
        for (&dof, &inverse_d) in symbolic.order.iter().zip(&factor.inverse_d) {
            let diagonal = a.val()[a.col_ptr()[dof as usize] as usize];
            let positive = inverse_d > 0.0 && inverse_d * LEAST_PIVOT * diagonal < 1.0;
            if !positive {
                return Err(FactorError::NotPositive { dof: dof as usize });
            }
        }
        Ok(factor)
    }

    /// Number of negative eigenvalues of A (Sylvester's law of inertia).
    pub fn negative_pivots(&self) -> usize {
        self.inverse_d.iter().filter(|d| **d < 0.0).count()
    }

    /// Entries of L and D: what one sweep reads.
    pub fn entries(&self) -> usize {
        self.l.len() + self.inverse_d.len()
    }

    /// x ← A⁻¹ x; `scratch` has the length of `x` and is overwritten.
    pub fn solve_in_place(&self, x: &mut [f64], scratch: &mut [f64]) {
        let Symbolic { order, starts, rows, .. } = &*self.symbolic;
        let y = scratch;
        for (y, &dof) in y.iter_mut().zip(order) {
            *y = x[dof as usize];
        }
        let column = |j: usize| {
            let range = starts[j] as usize..starts[j + 1] as usize;
            rows[range.clone()].iter().zip(&self.l[range])
        };
        for j in 0..y.len() {
            let yj = y[j];
            for (&i, l) in column(j) {
                y[i as usize] -= l * yj;
            }
        }
        for j in (0..y.len()).rev() {
            let yj = y[j] * self.inverse_d[j];
            y[j] = column(j).fold(yj, |yj, (&i, l)| yj - l * y[i as usize]);
        }
        for (y, &dof) in y.iter().zip(order) {
            x[dof as usize] = *y;
        }
    }
}
