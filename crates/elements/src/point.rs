//! Springs, dashpots and masses: diagonal in global axes.

use crate::matrices::Matrices;

/// Springs and dashpots along and about x, y, z between two nodes or from one to the ground. Nodes that lie apart feel
/// no moment from the force between them: give springs between nodes that coincide, or along their connection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// Along x, y, z (N/m) and about them (N m).
    pub stiffness: [f64; 6],
    /// Along x, y, z (N s/m) and about them (N m s).
    pub damping: [f64; 6],
}

impl Spring {
    /// K between two nodes; no mass.
    pub fn matrices(&self) -> Matrices {
        Matrices { n: 12, k: between(self.stiffness), m: vec![0.0; 144] }
    }
    /// K from a node to the ground; no mass.
    pub fn grounded(&self) -> Matrices {
        Matrices { n: 6, k: diagonal(self.stiffness), m: vec![0.0; 36] }
    }
    /// C between two nodes, row by row.
    pub fn damping(&self) -> Vec<f64> {
        between(self.damping)
    }
    /// C from a node to the ground, row by row.
    pub fn grounded_damping(&self) -> Vec<f64> {
        diagonal(self.damping)
    }
}

/// A mass at a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass {
    /// Mass, kg.
    pub mass: f64,
    /// About x, y, z, kg m².
    pub inertia: [f64; 3],
}

impl Mass {
    /// M; no stiffness.
    pub fn matrices(&self) -> Matrices {
        let [x, y, z] = self.inertia;
        Matrices { n: 6, k: vec![0.0; 36], m: diagonal([self.mass, self.mass, self.mass, x, y, z]) }
    }
}

fn diagonal(values: [f64; 6]) -> Vec<f64> {
    let mut matrix = vec![0.0; 36];
    values.into_iter().enumerate().for_each(|(i, value)| matrix[7 * i] = value);
    matrix
}

fn between(values: [f64; 6]) -> Vec<f64> {
    let mut matrix = vec![0.0; 144];
    for (i, value) in values.into_iter().enumerate() {
        (matrix[13 * i], matrix[13 * (i + 6)]) = (value, value);
        (matrix[12 * i + i + 6], matrix[12 * (i + 6) + i]) = (-value, -value);
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrices::testing::square;

    #[test]
    fn a_spring_feels_the_difference_only() {
        let spring = Spring { stiffness: [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], damping: [6.0, 5.0, 4.0, 3.0, 2.0, 1.0] };
        let both = |v: [f64; 6]| nalgebra::DVector::from_iterator(12, v.into_iter().chain(v));
        let (k, c) = (square(&spring.matrices().k), square(&spring.damping()));
        assert_eq!((&k * both([1.0; 6])).amax() + (&c * both([1.0; 6])).amax(), 0.0);
        assert_eq!((k.trace(), c.trace()), (42.0, 42.0));
        assert_eq!(square(&spring.grounded().k).trace(), 21.0);
        assert_eq!(square(&spring.grounded_damping())[(0, 0)], 6.0);
    }

    #[test]
    fn a_mass_resists_in_all_directions() {
        let m = square(&Mass { mass: 7.0, inertia: [1.0, 2.0, 3.0] }.matrices().m);
        assert_eq!(m.diagonal().as_slice(), [7.0, 7.0, 7.0, 1.0, 2.0, 3.0]);
    }
}
