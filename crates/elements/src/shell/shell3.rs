//! Flat triangular shell.

use nalgebra::Vector3;

use super::flat::{Flat, Products, interpolate};
use super::membrane4::area;
use super::plate::Plate;
use super::{bending, membrane3};
use crate::error::{ElementError, exceeds};
use crate::matrices::{Matrices, Weights};

/// A flat shell element of three nodes.
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
        if !exceeds(ratio, 1e-9) {
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
        let area = self.area();
        let products = Products::new(POINTS.iter().flat_map(|&(a, b, weight)| {
            [[a, b, b], [b, a, b], [b, b, a]].map(|lambda| (lambda, edges(lambda), weight * area))
        }));
        self.flat.matrices(&self.nodes, &self.plate, &membrane, &bending, &products)
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
    /// coordinates. Rigid motions come out exactly; the element's own shapes as in its M, so that it is smooth along its
    /// edges.
    pub fn interpolate(&self, lambda: [f64; 3], direction: [f64; 3], arm: [f64; 3]) -> Weights {
        interpolate(&self.nodes, &lambda, &edges(lambda), direction, arm)
    }
}

/// P: 1 in the middle of an edge, 0 on the others.
fn edges([a, b, c]: [f64; 3]) -> [f64; 3] {
    [4.0 * a * b, 4.0 * b * c, 4.0 * c * a]
}

/// Area coordinates (a, b, b) in all orders and weights of the six-point rule, exact to degree 4 (Dunavant, Int. J. Numer.
/// Methods Eng. 21, 1985, 1129–1148).
const POINTS: [(f64, f64, f64); 2] = [
    (0.108_103_018_168_070, 0.445_948_490_915_965, 0.223_381_589_678_011),
    (0.816_847_572_980_459, 0.091_576_213_509_771, 0.109_951_743_655_322),
];
