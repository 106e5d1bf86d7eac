//! Quadrilateral membrane: stresses assumed inside, displacements along the edges (assumed-stress hybrid element; Pian,
//! AIAA J. 2, 1964, 1333–1336; with drilling rotations Aminpour, Int. J. Numer. Methods Eng. 33, 1992, 19–38).
//!
//! ```text
//! inside:  σ = P(x, y) β       equilibrium and compatibility hold exactly: P from biharmonic Airy polynomials
//! edge:    u = linear + 4s(1−s) L/8 (θ_j − θ_i) n,   s = 0…1 from corner i to j, n the outward normal (Allman)
//! H = ∫ Pᵀ C P t dA,   G q = ∮ (n·P)ᵀ u t ds,   K = Gᵀ H⁻¹ G
//! ```
//!
//! The polynomials are complete to the second degree (11 of them), so that the result does not depend on the axes. All 11
//! at full weight are too stiff, the 7 up to the first degree alone leave two motions of the drilling rotations free of
//! energy. So the energy is split by H = L Lᵀ, which makes the second degree orthogonal to the rest, and that part counts
//! with the share ε only; it vanishes for every field the first degree can represent:
//!
//! ```text
//! F = L⁻¹ G,   K = Σ w_i F_iᵀ F_i,   w = 1 for the first 7, ε for the others
//! ```
//!
//! Only differences of θ enter: equal rotations at all corners would be free of energy. They are tied to the mean
//! rotation of the continuum (Hughes & Brezzi, Comput. Methods Appl. Mech. Eng. 72, 1989, 105–121), which keeps constant
//! strain and rigid motion exact:
//!
//! ```text
//! K += γ G t A dᵀd,   d q = (1/A) [∫ Σ N_i θ_i dA − ½ ∮ u·ds]
//! ```
//!
//! ε and γ are small enough not to be felt in slender in-plane bending and large enough to keep K well-conditioned.

use super::plate::Plate;

/// Over u, v, θ of four corners.
pub(super) type Matrix12 = [[f64; 12]; 12];

/// Number of stress polynomials.
const STRESSES: usize = 11;
/// Those up to the first degree.
const LINEAR: usize = 7;
/// ε.
const QUADRATIC: f64 = 0.05;
/// γ.
const DRILLING: f64 = 0.05;

/// Abscissae on [−1, 1] and weights of the three-point Gauss rule: exact to degree 5, H needs that and G needs 4.
pub(super) const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// P: [σ_x, σ_y, τ] of each polynomial.
fn stresses(x: f64, y: f64) -> [[f64; 3]; STRESSES] {
    [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [y, 0.0, 0.0],
        [0.0, x, 0.0],
        [x, 0.0, -y],
        [0.0, y, -x],
        [0.0, 2.0 * x * y, -x * x],
        [2.0 * x * y, 0.0, -y * y],
        [-y * y, x * x, 0.0],
        [y * y - x * x, x * x - y * y, 2.0 * x * y],
    ]
}

/// K.
pub(super) fn stiffness(corners: &[[f64; 2]; 4], plate: &Plate) -> Matrix12 {
    let size = area(corners).sqrt();
    // Coordinates of order one keep H well-conditioned.
    let corners = corners.map(|p| p.map(|x| x / size));
    let (e, nu) = (plate.modulus, plate.poisson);

    let (mut h, mut turned) = ([[0.0; STRESSES]; STRESSES], [0.0; 4]);
    for (xi, wx) in GAUSS {
        for (eta, wy) in GAUSS {
            let (n, [x, y], jacobian) = bilinear(&corners, xi, eta);
            let weight = wx * wy * jacobian;
            let p = stresses(x, y);
            for (i, [sx, sy, t]) in p.iter().enumerate() {
                let strain = [(sx - nu * sy) / e, (sy - nu * sx) / e, 2.0 * (1.0 + nu) * t / e];
                for (h, p) in h[i][..=i].iter_mut().zip(&p) {
                    *h += weight * (strain[0] * p[0] + strain[1] * p[1] + strain[2] * p[2]);
                }
            }
            turned.iter_mut().zip(n).for_each(|(turned, n)| *turned += weight * n);
        }
    }

    let (mut g, mut drilling) = ([[0.0; 12]; STRESSES], [0.0; 12]);
    for i in 0..4 {
        let j = (i + 1) % 4;
        let (a, b) = (corners[i], corners[j]);
        let chord = [b[0] - a[0], b[1] - a[1]];
        // n L.
        let normal = [chord[1], -chord[0]];
        for (s, weight) in GAUSS.map(|(x, w)| (0.5 * (1.0 + x), 0.5 * w)) {
            let bubble = 0.5 * s * (1.0 - s);
            for (g, p) in g.iter_mut().zip(stresses(a[0] + s * chord[0], a[1] + s * chord[1])) {
                let traction = [p[0] * normal[0] + p[2] * normal[1], p[2] * normal[0] + p[1] * normal[1]];
                let swing = weight * bubble * (traction[0] * normal[0] + traction[1] * normal[1]);
                for (corner, share, swing) in [(i, 1.0 - s, -swing), (j, s, swing)] {
                    g[3 * corner] += weight * share * traction[0];
                    g[3 * corner + 1] += weight * share * traction[1];
                    g[3 * corner + 2] += swing;
                }
            }
        }
        for corner in [i, j] {
            drilling[3 * corner] -= 0.25 * chord[0];
            drilling[3 * corner + 1] -= 0.25 * chord[1];
        }
        drilling[3 * i + 2] += turned[i];
    }

    // H = L Lᵀ, F = L⁻¹ G, K = Fᵀ F.
    for i in 0..STRESSES {
        for j in 0..=i {
            let sum = h[i][j] - (0..j).map(|k| h[i][k] * h[j][k]).sum::<f64>();
            h[i][j] = if i == j { sum.sqrt() } else { sum / h[j][j] };
        }
        let (done, rest) = g.split_at_mut(i);
        for (g_i, &l) in done.iter().zip(&h[i]) {
            rest[0].iter_mut().zip(g_i).for_each(|(x, y)| *x -= l * y);
        }
        rest[0].iter_mut().for_each(|x| *x /= h[i][i]);
    }
    let mut k = [[0.0; 12]; 12];
    let add = |k: &mut Matrix12, row: &[f64; 12], factor: f64| {
        for (k, a) in k.iter_mut().zip(row) {
            k.iter_mut().zip(row).for_each(|(k, b)| *k += factor * a * b);
        }
    };
    for (i, row) in g.iter().enumerate() {
        add(&mut k, row, plate.thickness * if i < LINEAR { 1.0 } else { QUADRATIC });
    }
    add(&mut k, &drilling, DRILLING * plate.shear_modulus() * plate.thickness);
    // Back from lengths in units of `size`: forces stay, moments and rotations scale.
    for (i, row) in k.iter_mut().enumerate() {
        for (j, k) in row.iter_mut().enumerate() {
            *k *= if i % 3 == 2 { size } else { 1.0 } * if j % 3 == 2 { size } else { 1.0 };
        }
    }
    k
}

/// Shapes, place and Jacobian at (ξ, η).
pub(super) fn bilinear(corners: &[[f64; 2]; 4], xi: f64, eta: f64) -> ([f64; 4], [f64; 2], f64) {
    let (n, [dx, dy]) = shapes(xi, eta);
    let sum = |weights: &[f64; 4], axis: usize| weights.iter().zip(corners).map(|(n, p)| n * p[axis]).sum::<f64>();
    let jacobian = sum(&dx, 0) * sum(&dy, 1) - sum(&dx, 1) * sum(&dy, 0);
    (n, [sum(&n, 0), sum(&n, 1)], jacobian)
}

/// N at (ξ, η) and its derivatives by both.
pub(super) fn shapes(xi: f64, eta: f64) -> ([f64; 4], [[f64; 4]; 2]) {
    let (mut n, mut d) = ([0.0; 4], [[0.0; 4]; 2]);
    for (i, (a, b)) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].into_iter().enumerate() {
        n[i] = 0.25 * (1.0 + a * xi) * (1.0 + b * eta);
        d[0][i] = 0.25 * a * (1.0 + b * eta);
        d[1][i] = 0.25 * b * (1.0 + a * xi);
    }
    (n, d)
}

/// Area of a polygon, positive when its corners run counter-clockwise.
pub(super) fn area<const N: usize>(corners: &[[f64; 2]; N]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    0.5 * corners.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
}
