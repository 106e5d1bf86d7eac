//! Flat quadrilateral shell.

use nalgebra::Vector3;

use super::flat::{Flat, Products, interpolate};
use super::membrane4::{GAUSS, area, bilinear, shapes};
use super::plate::Plate;
use super::{bending, membrane4};
use crate::error::{ElementError, exceeds};
use crate::matrices::{Matrices, Weights};

/// A quadrilateral; four nodes in order around it, nearly in one plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Shell4 {
    nodes: [Vector3<f64>; 4],
    plate: Plate,
    flat: Flat<4>,
}

/// Sine of the least corner angle, and of the least angle short of a straight one: 1°.
const LEAST_SINE: f64 = 0.017;
/// Greatest distance of the corners from the mean plane over the square root of the area.
const GREATEST_WARP: f64 = 0.2;
/// Least share of the area seen from above, below which the element counts as upright.
const UPRIGHT: f64 = 1e-3;

impl Shell4 {
    /// Through nodes in order around the element.
    ///
    /// # Errors
    /// No area, corners crossed, concave or on one line, too warped, or no plate.
    pub fn new(nodes: [[f64; 3]; 4], plate: Plate) -> Result<Self, ElementError> {
        plate.check()?;
        let nodes = nodes.map(Vector3::from);
        let (first, second) = (nodes[2] - nodes[0], nodes[3] - nodes[1]);
        let normal = first.cross(&second);
        let size = first.norm_squared() + second.norm_squared();
        if !exceeds(normal.norm(), 1e-9 * size) {
            return Err(ElementError::NoArea);
        }
        let (edge, n) = (nodes[1] - nodes[0], normal.normalize());
        if !exceeds((edge - n * n.dot(&edge)).norm_squared(), 1e-12 * size) {
            return Err(ElementError::NoArea);
        }
        let flat = Flat::new(&nodes, normal);
        for corner in 0..4 {
            let at = |i: usize| flat.corners[i % 4];
            let (before, here, after) = (at(corner + 3), at(corner), at(corner + 1));
            let (a, b) = ([after[0] - here[0], after[1] - here[1]], [before[0] - here[0], before[1] - here[1]]);
            let (sine, cosine) = (a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
            if !exceeds(sine, LEAST_SINE * sine.hypot(cosine)) {
                return Err(ElementError::Corner { corner: corner + 1, angle: sine.atan2(cosine).to_degrees() });
            }
        }
        let warp = flat.heights[0].abs() / area(&flat.corners).sqrt();
        if warp > GREATEST_WARP {
            return Err(ElementError::Warped { percent: 100.0 * warp });
        }
        Ok(Self { nodes, plate, flat })
    }

    /// Area of the mean plane's quadrilateral, m².
    pub fn area(&self) -> f64 {
        area(&self.flat.corners)
    }

    /// K and consistent M.
    pub fn matrices(&self) -> Matrices {
        let corners = &self.flat.corners;
        let membrane = membrane4::stiffness(corners, &self.plate);
        let bending = bending::quadrilateral(corners, &self.plate);
        let points = GAUSS.into_iter().flat_map(|x| GAUSS.map(|y| (x, y)));
        let products = Products::new(points.map(|((xi, wx), (eta, wy))| {
            let (n, _, jacobian) = bilinear(corners, xi, eta);
            (n, edges(xi, eta), wx * wy * jacobian)
        }));
        self.flat.matrices(&self.nodes, &self.plate, &membrane, &bending, &products)
    }

    /// (ξ, η), each between −1 and 1, of the point over or under which (x, y) lies; `None` outside, beyond `slack` (in ξ
    /// and η; 1e-9 takes in the edges), or when the element stands upright.
    pub fn contains_in_plan(&self, x: f64, y: f64, slack: f64) -> Option<[f64; 2]> {
        let plan = self.nodes.map(|p| [p.x - x, p.y - y]);
        if area(&plan).abs() < UPRIGHT * self.area() {
            return None;
        }
        // Newton from the middle: for a convex element it stays inside and converges.
        let [mut xi, mut eta] = [0.0_f64; 2];
        for _ in 0..20 {
            let (n, d) = shapes(xi, eta);
            let sum = |w: &[f64; 4], axis: usize| w.iter().zip(&plan).map(|(w, p)| w * p[axis]).sum::<f64>();
            let (u, v) = (sum(&n, 0), sum(&n, 1));
            let [[a, b], [c, e]] = [[sum(&d[0], 0), sum(&d[1], 0)], [sum(&d[0], 1), sum(&d[1], 1)]];
            let jacobian = a * e - b * c;
            let (step_xi, step_eta) = ((e * u - b * v) / jacobian, (a * v - c * u) / jacobian);
            (xi, eta) = ((xi - step_xi).clamp(-3.0, 3.0), (eta - step_eta).clamp(-3.0, 3.0));
            if step_xi.abs().max(step_eta.abs()) < 1e-14 {
                break;
            }
        }
        let inside = xi.abs() <= 1.0 + slack && eta.abs() <= 1.0 + slack;
        inside.then_some([xi, eta])
    }

    /// The point at (ξ, η).
    pub fn point(&self, [xi, eta]: [f64; 2]) -> [f64; 3] {
        let (n, _) = shapes(xi, eta);
        n.iter().zip(&self.nodes).map(|(n, p)| *n * p).sum::<Vector3<f64>>().into()
    }

    /// Row that gives the displacement along `direction` of a point `arm` (global, m) away from the element at (ξ, η).
    /// Rigid motions come out exactly; the element's own shapes as in its M, so that it is smooth along its edges.
    pub fn interpolate(&self, [xi, eta]: [f64; 2], direction: [f64; 3], arm: [f64; 3]) -> Weights {
        interpolate(&self.nodes, &shapes(xi, eta).0, &edges(xi, eta), direction, arm)
    }
}

/// P: 1 in the middle of an edge, 0 on the others.
fn edges(xi: f64, eta: f64) -> [f64; 4] {
    let (x, y) = (0.5 * (1.0 - xi * xi), 0.5 * (1.0 - eta * eta));
    [x * (1.0 - eta), y * (1.0 + xi), x * (1.0 + eta), y * (1.0 - xi)]
}
