//! Why a matrix cannot be factorised.

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

impl FactorError {
    /// From faer's number of a bad pivot, which counts from 1, and the degrees of freedom in the order of elimination.
    pub(crate) fn at_pivot(number: usize, order: &[u32]) -> Self {
        let row = number.saturating_sub(1);
        Self::NotPositive { dof: order.get(row).map_or(row, |dof| *dof as usize) }
    }
}
