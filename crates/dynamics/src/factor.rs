//! Sparse factorisation of symmetric matrices, symbolic once, numeric often: L D Lᵀ by columns for small models, L Lᵀ by
//! panels ([`crate::supernodal`]) for large ones.
//!
//! For the few hundred degrees of freedom of a plane model the panels' overhead costs more than the arithmetic.

use std::sync::Arc;

use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{CholeskySymbolicParams, SymmetricOrdering, factorize_symbolic_cholesky};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};

use crate::order::{Graph, nested_dissection, postordered};
use crate::simplicial;
use crate::supernodal::{Numbers, Pattern};
use crate::sweeps::Which;

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

/// A pivot below this times its diagonal entry is rounding, not stiffness. The bending of a beam of n elements leaves
/// about 2/n³, which is still larger for 25,000 elements.
const LEAST_PIVOT: f64 = 1e-13;
/// From so many degrees of freedom on the factor goes by panels.
const LARGE: usize = 3000;

/// What helps to order the elimination of a large model.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    /// Node of every degree of freedom; empty: each is its own.
    pub node_of: Vec<u32>,
    /// Coordinates (x, y, z) of every node, m; empty: unknown. Nodes without degrees of freedom may follow.
    pub place: Vec<[f64; 3]>,
    /// Degrees of freedom to eliminate last.
    pub last: Vec<u32>,
    /// The order itself, when it is known already; empty: it is not.
    pub order: Vec<u32>,
}

/// Order and pattern of the factor.
#[derive(Clone, Debug)]
pub enum Symbolic {
    /// By columns.
    Simplicial(Arc<simplicial::Pattern>),
    /// By panels.
    Supernodal(Arc<Pattern>),
}

impl Symbolic {
    /// Analyses a pattern given by its lower triangle.
    ///
    /// # Errors
    /// [`FactorError::Symbolic`] when memory or indices do not suffice.
    pub fn new(pattern: SymbolicSparseColMatRef<'_, u32>, layout: &Layout) -> Result<Self, FactorError> {
        if pattern.ncols() < LARGE {
            return Ok(Self::Simplicial(Arc::new(simplicial::Pattern::new(pattern)?)));
        }
        let known = layout.order.len() == pattern.ncols();
        let found = if known { Pattern::new(pattern, layout.order.clone())? } else { best(pattern, layout)? };
        Ok(Self::Supernodal(Arc::new(found)))
    }

    /// Number of negative eigenvalues of `a` (Sylvester's law of inertia).
    ///
    /// # Errors
    /// A pivot is zero.
    pub fn count_negative(&self, a: SparseColMatRef<'_, u32, f64>) -> Result<usize, FactorError> {
        match self {
            Self::Simplicial(pattern) => Ok(pattern.factorise(a)?.negative_pivots()),
            Self::Supernodal(pattern) => pattern.count_negative(a),
        }
    }

    /// The order of elimination of a large model.
    pub fn order(&self) -> Option<&[u32]> {
        match self {
            Self::Simplicial(_) => None,
            Self::Supernodal(pattern) => Some(&pattern.order),
        }
    }
}

/// The better of two orders: nested dissection, where coordinates are known, and minimum degree. Which one wins depends on
/// the model: dissection on wide plates, minimum degree on long boxes.
fn best(pattern: SymbolicSparseColMatRef<'_, u32>, layout: &Layout) -> Result<Pattern, FactorError> {
    let n = pattern.ncols();
    let (starts, rows) = (pattern.col_ptr(), pattern.row_idx());
    let own: Vec<u32>;
    let node_of = if layout.node_of.len() == n {
        &layout.node_of
    } else {
        own = (0..n as u32).collect();
        &own
    };
    let graph = Graph::new(starts, rows, node_of);
    let mut last = vec![false; n];
    layout.last.iter().for_each(|&dof| last[dof as usize] = true);
    let finish = |nodes: Vec<u32>| {
        let mut rank = vec![0_u32; nodes.len()];
        nodes.iter().zip(0..).for_each(|(&node, at)| rank[node as usize] = at);
        let mut order: Vec<u32> = (0..n as u32).collect();
        order.sort_by_key(|&dof| (last[dof as usize], rank[node_of[dof as usize] as usize]));
        Pattern::new(pattern, postordered(starts, rows, &order))
    };
    let by_degree = finish(minimum_degree(&graph)?)?;
    if layout.place.len() < graph.nodes() {
        return Ok(by_degree);
    }
    let dissected = finish(nested_dissection(&graph, &layout.place))?;
    Ok(if dissected.entries() < by_degree.entries() { dissected } else { by_degree })
}

/// Approximate minimum degree of the nodes' graph.
fn minimum_degree(graph: &Graph) -> Result<Vec<u32>, FactorError> {
    let (starts, rows) = graph.lower();
    let pattern = SymbolicSparseColMat::new_checked(graph.nodes(), graph.nodes(), starts, None, rows);
    let parameters = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SIMPLICIAL,
        ..Default::default()
    };
    let found = factorize_symbolic_cholesky(pattern.as_ref(), faer::Side::Lower, SymmetricOrdering::Amd, parameters)
        .map_err(|e| FactorError::Symbolic(e.to_string()))?;
    Ok(found.perm().map_or_else(|| (0..graph.nodes() as u32).collect(), |perm| perm.arrays().0.to_vec()))
}

/// A factor: pattern and numbers.
#[derive(Clone, Debug)]
pub enum Factor {
    /// By columns.
    Simplicial(Arc<simplicial::Pattern>, simplicial::Numbers),
    /// By panels.
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
