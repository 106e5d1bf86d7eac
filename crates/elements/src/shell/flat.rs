//! What flat elements share: their plane, and the way from it to the nodes.
//!
//! The corners p_i of a warped quadrilateral lie off its mean plane by h_i n; rigid arms lead from the nodes to the
//! plane's corners, so that rigid motion stays free of strain:
//!
//! ```text
//! u_plane = A (u_node − h_i r × n),   r_plane = A r_node,   A: rows e₁, e₂, n
//! K = Tᵀ [membrane + bending] T
//! M: ρt ∫ N_i N_j dA on u,   ρt³/12 ∫ N_i N_j dA on what of r lies in the plane
//! ```
//!
//! Bilinear displacements of the nodes themselves hold rigid motion exactly: M needs no arms, and none is given to the
//! drilling rotations.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::Plate;
use crate::matrices::{Matrices, Weights};

/// The mean plane of an element.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Flat<const N: usize> {
    /// A.
    pub axes: Matrix3<f64>,
    /// Corners in the plane.
    pub corners: [[f64; 2]; N],
    /// h.
    pub heights: [f64; N],
}

impl<const N: usize> Flat<N> {
    /// The plane through the nodes' mean with the given normal (any length but zero).
    pub fn new(nodes: &[Vector3<f64>; N], normal: Vector3<f64>) -> Self {
        let centre = nodes.iter().sum::<Vector3<f64>>() / N as f64;
        let n = normal.normalize();
        let edge = nodes[1] - nodes[0];
        let e1 = (edge - n * n.dot(&edge)).normalize();
        let axes = Matrix3::from_rows(&[e1.transpose(), n.cross(&e1).transpose(), n.transpose()]);
        let local = nodes.map(|p| axes * (p - centre));
        Self { axes, corners: local.map(|p| [p.x, p.y]), heights: local.map(|p| p.z) }
    }

    /// K and M from both parts' K and ∫ N_i N_j dA; D = 3N.
    pub fn matrices<const D: usize>(
        &self,
        plate: &Plate,
        membrane: &[[f64; D]; D],
        bending: &[[f64; D]; D],
        shared: &[[f64; N]; N],
    ) -> Matrices {
        let to_plane = self.heights.map(|h| {
            let mut t = SMatrix::<f64, 6, 6>::zeros();
            t.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.axes);
            t.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.axes);
            // A (−h r × n) = h (n × r in own axes) = h (−r₂, r₁, 0).
            for column in 0..3 {
                t[(0, 3 + column)] = -h * self.axes[(1, column)];
                t[(1, 3 + column)] = h * self.axes[(0, column)];
            }
            t
        });
        let normal: Vector3<f64> = self.axes.row(2).transpose();
        let in_plane = Matrix3::identity() - normal * normal.transpose();
        let rotary = plate.mass * plate.thickness * plate.thickness / 12.0;
        let mut both = Matrices::zeros(6 * N);
        for i in 0..N {
            for j in 0..N {
                let mut k = SMatrix::<f64, 6, 6>::zeros();
                for a in 0..3 {
                    for b in 0..3 {
                        k[(MEMBRANE[a], MEMBRANE[b])] = membrane[3 * i + a][3 * j + b];
                        k[(BENDING[a], BENDING[b])] = bending[3 * i + a][3 * j + b];
                    }
                }
                let k = to_plane[i].transpose() * k * to_plane[j];
                for a in 0..6 {
                    let first = (6 * i + a) * 6 * N + 6 * j;
                    (0..6).for_each(|b| both.k[first + b] = k[(a, b)]);
                    if a < 3 {
                        both.m[first + a] = plate.mass * shared[i][j];
                    } else {
                        (3..6).for_each(|b| both.m[first + b] = rotary * shared[i][j] * in_plane[(a - 3, b - 3)]);
                    }
                }
            }
        }
        both
    }
}

/// Places of u, v, r_z and of w, r_x, r_y among a node's six.
const MEMBRANE: [usize; 3] = [0, 1, 5];
const BENDING: [usize; 3] = [2, 3, 4];

/// Row of the displacement along `direction` at the point with shapes `n`, `arm` away from the element.
pub(super) fn interpolate<const N: usize>(n: &[f64; N], direction: [f64; 3], arm: [f64; 3]) -> Weights {
    let (direction, arm) = (Vector3::from(direction), Vector3::from(arm));
    // direction · (r × arm) = r · (arm × direction).
    let about = arm.cross(&direction);
    let all = [direction.x, direction.y, direction.z, about.x, about.y, about.z];
    let each = n
        .iter()
        .enumerate()
        .flat_map(|(i, n)| all.into_iter().enumerate().map(move |(freedom, factor)| (6 * i + freedom, n * factor)));
    each.filter(|(_, weight)| *weight != 0.0).collect()
}
