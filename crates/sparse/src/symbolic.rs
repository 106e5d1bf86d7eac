//! The symbolic analysis of a pattern: which kind of factor, which order of elimination.
//!
//! For the few hundred degrees of freedom of a plane model the panels' overhead costs more than the arithmetic.

use std::sync::Arc;

use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{CholeskySymbolicParams, SymmetricOrdering, factorize_symbolic_cholesky};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};

use crate::error::FactorError;
use crate::order::dissection::nested_dissection;
use crate::order::graph::Graph;
use crate::order::layout::Layout;
use crate::order::tree::postordered;
use crate::simplicial;
use crate::supernodal::Pattern;

/// From so many degrees of freedom on the factor goes by panels.
const LARGE: usize = 3000;

/// Order and pattern of the factor.
#[derive(Clone, Debug)]
pub enum Symbolic {
    /// The factor goes column by column: small models.
    Simplicial(Arc<simplicial::Pattern>),
    /// The factor goes by dense panels: large models.
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
