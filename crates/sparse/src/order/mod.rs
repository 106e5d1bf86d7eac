//! Elimination orders for large models: nested dissection where coordinates are known, else the approximate minimum
//! degree of the nodes' graph; then a postorder of the elimination tree. The degrees of freedom of a node stay together.

pub mod dissection;
pub mod graph;
pub mod layout;
pub mod tree;
