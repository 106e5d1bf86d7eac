//! A degree of freedom by node and direction, and the names of the directions.

use std::fmt;

/// Names of a node's six motions, in order.
pub const DIRECTIONS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// The internal node −k of an Abaqus model has the number `INTERNAL` + k.
pub const INTERNAL: u32 = 1 << 31;

/// A degree of freedom, in the axes of the program that wrote the matrices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Dof {
    /// Number of its node; above [`INTERNAL`] an internal one.
    pub node: u32,
    /// 0…5: one of [`DIRECTIONS`].
    pub freedom: u8,
}

impl fmt::Display for Dof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let direction = DIRECTIONS.get(usize::from(self.freedom)).unwrap_or(&"?");
        match self.node {
            internal if internal > INTERNAL => write!(f, "internal node {}, {direction}", internal - INTERNAL),
            node => write!(f, "node {node}, {direction}"),
        }
    }
}

/// A direction by its name: x, ux, 1; rx, rotx, 4.
pub(crate) fn direction(name: &str) -> Option<u8> {
    const ALIASES: [[&str; 3]; 6] = [
        ["x", "ux", "1"],
        ["y", "uy", "2"],
        ["z", "uz", "3"],
        ["rx", "rotx", "4"],
        ["ry", "roty", "5"],
        ["rz", "rotz", "6"],
    ];
    let name = name.to_ascii_lowercase();
    (0..6).find(|&freedom| ALIASES[usize::from(freedom)].contains(&name.as_str()))
}
