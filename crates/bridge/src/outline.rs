//! What every description of a bridge tells of its shape: points, cells, what moves the points, what it weighs.

use crate::deck::Row;

/// Points, cells, and the rows that move the points.
pub struct Outline {
    /// Where the points are, m.
    pub points: Vec<[f64; 3]>,
    /// Points of every cell by position: one is a node, two a line, three or four a plate.
    pub cells: Vec<Vec<u32>>,
    /// Displacements along x, y and z of all points, as weights on degrees of freedom.
    pub rows: Vec<[Row; 3]>,
    /// The own weight, N.
    pub weight: Weight,
}

/// The own weight of a bridge.
pub enum Weight {
    /// On every degree of freedom.
    Loads(Vec<f64>),
    /// The mass is known to the matrix M alone; down is this axis (0, 1, 2 for x, y, z) with this sign.
    Down(usize, f64),
}
