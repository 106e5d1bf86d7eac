//! The numbers of a supernodal factor, and its sweeps.

use faer::Par;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::sparse::SparseColMatRef;

use crate::error::FactorError;
use crate::supernodal::pattern::Pattern;
use crate::sweeps::{LANES, Panels, Which};

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
