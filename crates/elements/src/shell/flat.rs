//! What flat elements share: their plane, and the passage from it to the nodes.
//!
//! The corners p_i of a warped quadrilateral lie off its mean plane by h_i n; rigid arms lead from the nodes to the
//! plane's corners, so that rigid motion stays free of strain:
//!
//! ```text
//! u_plane = A (u_node − h_i r × n),   r_plane = A r_node,   A: rows e₁, e₂, n
//! K = Tᵀ [membrane + bending] T
//! u = Σ N_i u_i + Σ P_k ⅛ (r_i − r_j) × (x_j − x_i)     edge k from node i to j
//! M: ρt ∫ on u,   ρt³/12 ∫ N_i N_j dA on what of r lies in the plane
//! ```
//!
//! On the edges this u is the beam's cubic out of the plane, up to its antisymmetric part, and Allman's parabola in the
//! plane. It holds rigid motion exactly for the nodes themselves: M and the interpolation need no arms.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::plate::Plate;
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

    /// K and M from both parts' K and the shapes' products; D = 3N.
    pub fn matrices<const D: usize>(
        &self,
        nodes: &[Vector3<f64>; N],
        plate: &Plate,
        membrane: &[[f64; D]; D],
        bending: &[[f64; D]; D],
        shared: &Products<N>,
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
        let edges: [Vector3<f64>; N] = std::array::from_fn(|k| 0.125 * (nodes[(k + 1) % N] - nodes[k]));
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
                // u of node i: N_i u_i + g_i × r_i with g_i = P_h e_h − P_i e_i, h the edge that ends at i, e with ⅛.
                let (h, l) = ((i + N - 1) % N, (j + N - 1) % N);
                let nn = shared.nn[i][j];
                let ng = edges[l] * shared.np[i][l] - edges[j] * shared.np[i][j];
                let gn = edges[h] * shared.np[j][h] - edges[i] * shared.np[j][i];
                // (g_i × a)·(g_j × b) = aᵀ [(g_i·g_j) I − g_j g_iᵀ] b.
                let (mut dyad, mut dot) = (Matrix3::zeros(), 0.0);
                for (p, first) in [(h, 1.0), (i, -1.0)] {
                    for (q, second) in [(l, 1.0), (j, -1.0)] {
                        let pp = first * second * shared.pp[p][q];
                        dyad += pp * edges[q] * edges[p].transpose();
                        dot += pp * edges[p].dot(&edges[q]);
                    }
                }
                let turning = plate.mass * (Matrix3::identity() * dot - dyad) + rotary * nn * in_plane;
                let (left, right) = (gn.cross_matrix().transpose() * plate.mass, ng.cross_matrix() * plate.mass);
                for a in 0..6 {
                    let first = (6 * i + a) * 6 * N + 6 * j;
                    (0..6).for_each(|b| both.k[first + b] = k[(a, b)]);
                }
                for a in 0..3 {
                    let (above, below) = ((6 * i + a) * 6 * N + 6 * j, (6 * i + 3 + a) * 6 * N + 6 * j);
                    both.m[above + a] = plate.mass * nn;
                    for b in 0..3 {
                        both.m[above + 3 + b] = right[(a, b)];
                        both.m[below + b] = left[(a, b)];
                        both.m[below + 3 + b] = turning[(a, b)];
                    }
                }
            }
        }
        both
    }
}

/// ∫ over the element of the shapes' products.
pub(super) struct Products<const N: usize> {
    /// N_i N_j.
    pub nn: [[f64; N]; N],
    /// N_i P_k.
    pub np: [[f64; N]; N],
    /// P_k P_l.
    pub pp: [[f64; N]; N],
}

impl<const N: usize> Products<N> {
    /// From the shapes N and P and the share of the area at integration points.
    pub fn new(points: impl IntoIterator<Item = ([f64; N], [f64; N], f64)>) -> Self {
        let mut all = Self { nn: [[0.0; N]; N], np: [[0.0; N]; N], pp: [[0.0; N]; N] };
        for (n, p, area) in points {
            for i in 0..N {
                for j in 0..N {
                    all.nn[i][j] += area * n[i] * n[j];
                    all.np[i][j] += area * n[i] * p[j];
                    all.pp[i][j] += area * p[i] * p[j];
                }
            }
        }
        all
    }
}

/// Places of u, v, r_z and of w, r_x, r_y among a node's six.
const MEMBRANE: [usize; 3] = [0, 1, 5];
const BENDING: [usize; 3] = [2, 3, 4];

/// Row of the displacement along `direction` at the point with shapes `n` and `p`, `arm` away from the element.
pub(super) fn interpolate<const N: usize>(
    nodes: &[Vector3<f64>; N],
    n: &[f64; N],
    p: &[f64; N],
    direction: [f64; 3],
    arm: [f64; 3],
) -> Weights {
    let (direction, arm) = (Vector3::from(direction), Vector3::from(arm));
    let lift = |k: usize| 0.125 * p[k] * (nodes[(k + 1) % N] - nodes[k]);
    let mut row = Weights::with_capacity(6 * N);
    for (i, n) in n.iter().enumerate() {
        // direction · (r × arm + g × r) = r · (arm × direction + direction × g).
        let g = lift((i + N - 1) % N) - lift(i);
        let about = *n * arm.cross(&direction) + direction.cross(&g);
        let all = [n * direction.x, n * direction.y, n * direction.z, about.x, about.y, about.z];
        row.extend(all.into_iter().enumerate().filter(|(_, w)| *w != 0.0).map(|(freedom, w)| (6 * i + freedom, w)));
    }
    row
}
