//! Sparse factorisation of symmetric matrices, symbolic once, numeric often: L D Lᵀ by columns for small models, L Lᵀ by
//! panels ([`crate::supernodal`]) for large ones.

use std::sync::Arc;

use faer::sparse::SparseColMatRef;

use crate::error::FactorError;
use crate::simplicial;
use crate::supernodal::{Numbers, Pattern};
use crate::sweeps::Which;
use crate::symbolic::Symbolic;

/// A pivot below this times its diagonal entry is rounding, not stiffness. The bending of a beam of n elements leaves
/// about 2/n³, which is still larger for 25,000 elements.
const LEAST_PIVOT: f64 = 1e-13;

/// A factor: pattern and numbers.
#[derive(Clone, Debug)]
pub enum Factor {
    /// Column by column: small models.
    Simplicial(Arc<simplicial::Pattern>, simplicial::Numbers),
    /// By dense panels: large models.
    Supernodal(Arc<Pattern>, Numbers),
}

impl Factor {
    /// Factorises `a` (lower triangle, of the analysed pattern, with its diagonal first in each column).
    ///
    /// # Errors
    /// [`FactorError::NotPositive`] when it is not positive definite by a margin above rounding.
    pub fn positive(symbolic: &Symbolic, a: SparseColMatRef<'_, u32, f64>) -> Result<Self, FactorError> {
        Ok(match symbolic {
            Symbolic::Simplicial(pattern) => {
                Self::Simplicial(Arc::clone(pattern), pattern.factorise_positive(a, LEAST_PIVOT)?)
            }
            Symbolic::Supernodal(pattern) => Self::Supernodal(Arc::clone(pattern), pattern.factorise(a, LEAST_PIVOT)?),
        })
    }

    /// Takes the numbers of another matrix of the same pattern; a large factor keeps its memory.
    ///
    /// # Errors
    /// As [`Factor::positive`]; the factor is then of no use.
    pub fn again(&mut self, a: SparseColMatRef<'_, u32, f64>) -> Result<(), FactorError> {
        match self {
            Self::Simplicial(pattern, numbers) => *numbers = pattern.factorise_positive(a, LEAST_PIVOT)?,
            Self::Supernodal(pattern, numbers) => pattern.factorise_into(a, LEAST_PIVOT, numbers)?,
        }
        Ok(())
    }

    /// Numbers of the factor: what one sweep reads.
    pub fn entries(&self) -> usize {
        match self {
            Self::Simplicial(_, numbers) => numbers.entries(),
            Self::Supernodal(pattern, _) => pattern.entries(),
        }
    }

    /// Number of degrees of freedom.
    pub fn dimension(&self) -> usize {
        match self {
            Self::Simplicial(pattern, _) => pattern.dimension(),
            Self::Supernodal(pattern, _) => pattern.order.len(),
        }
    }

    /// x ← A⁻¹ x; `scratch` has the length of `x` and is overwritten.
    pub fn solve_in_place(&self, x: &mut [f64], scratch: &mut [f64]) {
        match self {
            Self::Simplicial(pattern, numbers) => pattern.solve_in_place(numbers, x, scratch),
            Self::Supernodal(pattern, numbers) => {
                let mut buffer = Vec::new();
                pattern.gather(x, scratch);
                pattern.forward(numbers, scratch, &mut buffer, Which::All);
                pattern.backward(numbers, scratch, &mut buffer, Which::All);
                pattern.scatter(scratch, x);
            }
        }
    }

    /// Pattern and numbers by panels, of a large model.
    pub fn panels(&self) -> Option<(&Pattern, &Numbers)> {
        match self {
            Self::Simplicial(..) => None,
            Self::Supernodal(pattern, numbers) => Some((pattern, numbers)),
        }
    }
}
