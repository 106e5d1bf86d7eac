//! What every description of a bridge in space comes down to: equations, places, and rows that lead in and out.

use serde::{Deserialize, Serialize};
use ttb_sparse::Assembly;

use crate::deck::Row;

/// A discretised bridge.
pub struct Assembled {
    /// K, M and C over the free degrees of freedom.
    pub equations: Assembly,
    /// Coordinates (x, y, z) of the nodes, m; empty where they are unknown. They only order the elimination.
    pub nodes: Vec<[f64; 3]>,
    /// Node of every degree of freedom, a position in `nodes` (or any grouping of degrees of freedom without them).
    pub node_of: Vec<u32>,
    /// In words, for messages: node and direction of a degree of freedom.
    pub names: Names,
    /// Displacement under every support of the track, as weights on degrees of freedom; forces act through the same.
    pub supports: Vec<Row>,
    /// Rows of the monitored points.
    pub monitors: Vec<Row>,
    /// The monitored points: which of `monitors` they read.
    pub points: Vec<Monitor>,
    /// Total mass, kg.
    pub mass: f64,
    /// Significant digits with which a file gives K; none if K was computed here.
    pub digits: Option<u32>,
}

/// Describes a degree of freedom by its number.
pub type Names = Box<dyn Fn(usize) -> String + Send + Sync>;

/// A monitored point: its rows in [`Assembled::monitors`].
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Monitor {
    /// Name in the interface: `point[NAME]`.
    pub name: String,
    /// Row of the displacement.
    pub motion: usize,
    /// Bending moment.
    pub moment: Option<usize>,
}
