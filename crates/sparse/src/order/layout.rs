//! What is known of a large model's degrees of freedom that helps to order their elimination.

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
