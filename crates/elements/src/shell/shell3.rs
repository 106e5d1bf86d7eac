//! Flat triangular shell.

use nalgebra::Vector3;

use super::flat::{Flat, interpolate};
use super::membrane4::area;
use super::{Plate, bending, membrane3};
use crate::error::ElementError;
use crate::matrices::{Matrices, Weights};

/// A triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Shell3 {
    nodes: [Vector3<f64>; 3],
    plate: Plate,
    flat: Flat<3>,
}

/// Least height over the longest side.
const LEAST_HEIGHT: f64 = 1e-3;
/// Least share of the area seen from above, below which the element counts as upright.
const UPRIGHT: f64 = 1e-3;

impl Shell3 {
    /// Through three nodes.
    ///
    /// # Errors
    /// No area, a sliver, or no plate.
    pub fn new(nodes: [[f64; 3]; 3], plate: Plate) -> Result<Self, ElementError> {
        plate.check()?;
        let nodes = nodes.map(Vector3::from);
        let normal = (nodes[1] - nodes[0]).cross(&(nodes[2] - nodes[0]));
        let longest = (0..3).map(|i| (nodes[(i + 1) % 3] - nodes[i]).norm_squared()).fold(0.0, f64::max);
        let ratio = normal.norm() / longest;
        if !(ratio > 1e-9) {
            return Err(ElementError::NoArea);
        }
        if ratio < LEAST_HEIGHT {
            return Err(ElementError::Sliver { ratio });
        }
        Ok(Self { nodes, plate, flat: Flat::new(&nodes, normal) })
    }

    /// Area, m².
    pub fn area(&self) -> f64 {
        area(&self.flat.corners)
    }

    /// K and consistent M.
    pub fn matrices(&self) -> Matrices {
        let corners = &self.flat.corners;
        let (membrane, bending) = (membrane3::stiffness(corners, &self.plate), bending::triangle(corners, &self.plate));
        let twelfth = self.area() / 12.0;
        let shared = [0, 1, 2].map(|i| [0, 1, 2].map(|j| if i == j { 2.0 * twelfth } else { twelfth }));
        self.flat.matrices(&self.plate, &membrane, &bending, &shared)
    }

    /// Area coordinates of the point over or under which (x, y) lies; `None` outside, beyond `slack` (in these
    /// coordinates; 1e-9 takes in the edges), or when the element stands upright.
    pub fn contains_in_plan(&self, x: f64, y: f64, slack: f64) -> Option<[f64; 3]> {
        let plan = self.nodes.map(|p| [p.x - x, p.y - y]);
        let whole = area(&plan);
        if whole.abs() < UPRIGHT * self.area() {
            return None;
        }
        let part = |i: usize, j: usize| 0.5 * (plan[i][0] * plan[j][1] - plan[i][1] * plan[j][0]) / whole;
        let lambda = [part(1, 2), part(2, 0), part(0, 1)];
        lambda.iter().all(|l| *l >= -slack).then_some(lambda)
    }

    /// The point at these area coordinates.
    pub fn point(&self, lambda: [f64; 3]) -> [f64; 3] {
        lambda.iter().zip(&self.nodes).map(|(l, p)| *l * p).sum::<Vector3<f64>>().into()
    }

    /// Row that gives the displacement along `direction` of a point `arm` (global, m) away from the element at these area
    /// coordinates. It is linear between the nodes, so that rigid motions come out exactly.
    pub fn interpolate(&self, lambda: [f64; 3], direction: [f64; 3], arm: [f64; 3]) -> Weights {
        interpolate(&lambda, direction, arm)
    }
}
