//! Factorisation P A Pᵀ = L D Lᵀ by columns with the approximate-minimum-degree order, for small models.
//!
//! The numbers come from faer's simplicial factorisation; the two triangular sweeps are our own loops over its factor.

use faer::Par;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};

use crate::error::FactorError;

/// Order and pattern of the factor.
pub struct Pattern {
    cholesky: SymbolicCholesky<u32>,
    /// Degree of freedom of each row of the factor.
    order: Vec<u32>,
    /// Columns of L below the diagonal.
    starts: Vec<u32>,
    rows: Vec<u32>,
}

impl std::fmt::Debug for Pattern {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Pattern").field("n", &self.order.len()).field("entries", &self.rows.len()).finish()
    }
}

impl Pattern {
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

/// The numbers of L and D.
#[derive(Clone, Debug)]
pub struct Numbers {
    /// L below the diagonal, by columns.
    l: Vec<f64>,
    /// Reciprocals of the diagonal D.
    inverse_d: Vec<f64>,
}

impl Numbers {
    /// Number of negative eigenvalues of A (Sylvester's law of inertia).
    pub fn negative_pivots(&self) -> usize {
        self.inverse_d.iter().filter(|d| **d < 0.0).count()
    }

    /// Entries of L and D: what one sweep reads.
    pub fn entries(&self) -> usize {
        self.l.len() + self.inverse_d.len()
    }
}

impl Pattern {
    /// Number of degrees of freedom.
    pub fn dimension(&self) -> usize {
        self.order.len()
    }

    /// Factorises `a` (lower triangle, of the analysed pattern), definite or not: no pivoting.
    ///
    /// # Errors
    /// A pivot is zero or not finite.
    pub fn factorise(&self, a: SparseColMatRef<'_, u32, f64>) -> Result<Numbers, FactorError> {
        let (cholesky, par) = (&self.cholesky, Par::Seq);
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
            .map_err(|LdltError::ZeroPivot { index }| FactorError::at_pivot(index, &self.order))?;
        let (mut l, mut inverse_d) = (Vec::with_capacity(self.rows.len()), Vec::with_capacity(self.order.len()));
        let mut values = values.into_iter();
        for column in self.starts.windows(2) {
            inverse_d.extend(values.next().map(|d| 1.0 / d));
            l.extend(values.by_ref().take((column[1] - column[0]) as usize));
        }
        Ok(Numbers { l, inverse_d })
    }

    /// Factorises a positive definite `a`, whose columns begin with the diagonal.
    ///
    /// # Errors
    /// [`FactorError::NotPositive`] when a pivot is below `least_pivot` times its diagonal entry.
    pub fn factorise_positive(
        &self,
        a: SparseColMatRef<'_, u32, f64>,
        least_pivot: f64,
    ) -> Result<Numbers, FactorError> {
        let numbers = self.factorise(a)?;
        for (&dof, &inverse_d) in self.order.iter().zip(&numbers.inverse_d) {
            let diagonal = a.val()[a.col_ptr()[dof as usize] as usize];
            let positive = inverse_d > 0.0 && inverse_d * least_pivot * diagonal < 1.0;
            if !positive {
                return Err(FactorError::NotPositive { dof: dof as usize });
            }
        }
        Ok(numbers)
    }

    /// x ← A⁻¹ x; `scratch` has the length of `x` and is overwritten.
    pub fn solve_in_place(&self, numbers: &Numbers, x: &mut [f64], scratch: &mut [f64]) {
        let (Self { order, starts, rows, .. }, Numbers { l, inverse_d }) = (self, numbers);
        let y = scratch;
        for (y, &dof) in y.iter_mut().zip(order) {
            *y = x[dof as usize];
        }
        let column = |j: usize| {
            let range = starts[j] as usize..starts[j + 1] as usize;
            rows[range.clone()].iter().zip(&l[range])
        };
        for j in 0..y.len() {
            let yj = y[j];
            for (&i, l) in column(j) {
                y[i as usize] -= l * yj;
            }
        }
        for j in (0..y.len()).rev() {
            let yj = y[j] * inverse_d[j];
            y[j] = column(j).fold(yj, |yj, (&i, l)| yj - l * y[i as usize]);
        }
        for (y, &dof) in y.iter().zip(order) {
            x[dof as usize] = *y;
        }
    }
}
