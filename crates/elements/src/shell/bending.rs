//! Plate in bending with shear deformation: discrete Kirchhoff–Mindlin elements (Katili, Int. J. Numer. Methods Eng. 36,
//! 1993, 1859–1883 and 1885–1908). For thin plates they become the discrete Kirchhoff elements (Batoz, Bathe & Ho,
//! ibid. 15, 1980; Batoz & Ben Tahar, ibid. 18, 1982) and do not lock.
//!
//! A fibre turns by β (u = zβ_x, v = zβ_y; β_x = r_y, β_y = −r_x). Along the edge from corner i to j, tangent (C, S):
//!
//! ```text
//! β = Σ N_i β_i + Σ P_k Δβ_k (C, S)_k        P_k quadratic, 1 in the middle of edge k, 0 on the others
//! γ_k = −⅔ φ_k Δβ_k,   φ_k = 12 D/(κGt L_k²) = 2t²/(κ(1−ν) L_k²)     shear strain along the edge, from equilibrium
//! ∫ (w,s + β_s − γ_k) ds = 0   →   Δβ_k = −3/(2L_k(1+φ_k)) [w_j − w_i + ½L_k (β_i + β_j)·(C, S)]
//! K = ∫ κᵀ D κ dA + ∫ γᵀ κGt γ dA,   κ = [β_x,x  β_y,y  β_x,y+β_y,x],   γ: between the edges' γ_k, see `Point`
//! ```
//!
//! φ_k is the Timoshenko beam's, and on the edge so is the solution.

use super::membrane4::shapes;
use super::plate::{Plate, SHEAR_FACTOR};

/// Integration point of an element with N corners and N edges.
struct Point<const N: usize> {
    /// dA.
    area: f64,
    /// Derivatives of N_i by x and y.
    n: [[f64; 2]; N],
    /// Derivatives of P_k.
    p: [[f64; 2]; N],
    /// (γ_x, γ_y) from each γ_k L_k.
    shear: [[f64; 2]; N],
}

/// K of a quadrilateral over w, r_x, r_y of its corners.
pub(super) fn quadrilateral(corners: &[[f64; 2]; 4], plate: &Plate) -> [[f64; 12]; 12] {
    let g = 1.0 / 3.0_f64.sqrt();
    let points = [(-g, -g), (g, -g), (g, g), (-g, g)].map(|(xi, eta)| {
        let (_, d) = shapes(xi, eta);
        let sum = |i: usize, axis: usize| d[i].iter().zip(corners).map(|(d, p)| d * p[axis]).sum::<f64>();
        let [[a, b], [c, e]] = [[sum(0, 0), sum(0, 1)], [sum(1, 0), sum(1, 1)]];
        let area = a * e - b * c;
        // Covariant components to x and y, by J⁻¹.
        let xy = |[by_xi, by_eta]: [f64; 2]| [(e * by_xi - b * by_eta) / area, (a * by_eta - c * by_xi) / area];
        let p = [
            [-xi * (1.0 - eta), -0.5 * (1.0 - xi * xi)],
            [0.5 * (1.0 - eta * eta), -eta * (1.0 + xi)],
            [-xi * (1.0 + eta), 0.5 * (1.0 - xi * xi)],
            [-0.5 * (1.0 - eta * eta), -eta * (1.0 - xi)],
        ];
        // Linear between opposite edges; L/2 of an edge lies on each unit of ξ or η.
        let shear = [
            [0.25 * (1.0 - eta), 0.0],
            [0.0, 0.25 * (1.0 + xi)],
            [-0.25 * (1.0 + eta), 0.0],
            [0.0, -0.25 * (1.0 - xi)],
        ];
        Point { area, n: [0, 1, 2, 3].map(|i| xy([d[0][i], d[1][i]])), p: p.map(xy), shear: shear.map(xy) }
    });
    stiffness(corners, plate, &points)
}

/// K of a triangle over w, r_x, r_y of its corners.
pub(super) fn triangle(corners: &[[f64; 2]; 3], plate: &Plate) -> [[f64; 9]; 9] {
    let [a, b, c] = corners;
    let double = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    let gradient = |p: &[f64; 2], q: &[f64; 2]| [(p[1] - q[1]) / double, (q[0] - p[0]) / double];
    let n = [gradient(b, c), gradient(c, a), gradient(a, b)];
    let points = [[4.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0]].map(|sixths: [f64; 3]| {
        let lambda = sixths.map(|s| s / 6.0);
        let edges = [(0, 1), (1, 2), (2, 0)];
        let p = edges.map(|(i, j)| [0, 1].map(|axis| 4.0 * (lambda[i] * n[j][axis] + lambda[j] * n[i][axis])));
        // Constant tangential component γ_k on each edge.
        let shear = edges.map(|(i, j)| [0, 1].map(|axis| lambda[i] * n[j][axis] - lambda[j] * n[i][axis]));
        Point { area: double / 6.0, n, p, shear }
    });
    stiffness(corners, plate, &points)
}

fn stiffness<const N: usize, const D: usize>(
    corners: &[[f64; 2]; N],
    plate: &Plate,
    points: &[Point<N>],
) -> [[f64; D]; D] {
    let (nu, t) = (plate.poisson, plate.thickness);
    let [direct, coupled, twist] = plate.plane_stress().map(|e| e * t * t * t / 12.0);
    let shear = SHEAR_FACTOR * plate.shear_modulus() * t;

    // Rows of Δβ_k and γ_k L_k.
    let (mut tangents, mut swings, mut strains) = ([[0.0; 2]; N], [[0.0; D]; N], [[0.0; D]; N]);
    for i in 0..N {
        let j = (i + 1) % N;
        let chord = [corners[j][0] - corners[i][0], corners[j][1] - corners[i][1]];
        let l = chord[0].hypot(chord[1]);
        let [c, s] = chord.map(|x| x / l);
        let phi = 2.0 * t * t / (SHEAR_FACTOR * (1.0 - nu) * l * l);
        let (jump, mean) = (-1.5 / (l * (1.0 + phi)), -0.75 / (1.0 + phi));
        for (corner, sign) in [(i, -1.0), (j, 1.0)] {
            swings[i][3 * corner] = sign * jump;
            swings[i][3 * corner + 1] = -mean * s;
            swings[i][3 * corner + 2] = mean * c;
        }
        strains[i] = swings[i].map(|x| -2.0 / 3.0 * phi * l * x);
        tangents[i] = [c, s];
    }

    let mut k = [[0.0; D]; D];
    for point in points {
        let mut b = [[0.0; D]; 5];
        for i in 0..N {
            let [nx, ny] = point.n[i];
            let (rx, ry) = (3 * i + 1, 3 * i + 2);
            b[0][ry] += nx;
            b[1][rx] -= ny;
            b[2][ry] += ny;
            b[2][rx] -= nx;
            let ([px, py], [c, s], [gx, gy]) = (point.p[i], tangents[i], point.shear[i]);
            for j in 0..D {
                let (swing, strain) = (swings[i][j], strains[i][j]);
                b[0][j] += px * c * swing;
                b[1][j] += py * s * swing;
                b[2][j] += (py * c + px * s) * swing;
                b[3][j] += gx * strain;
                b[4][j] += gy * strain;
            }
        }
        for i in 0..D {
            let moments = [
                direct * b[0][i] + coupled * b[1][i],
                coupled * b[0][i] + direct * b[1][i],
                twist * b[2][i],
                shear * b[3][i],
                shear * b[4][i],
            ];
            for (row, moment) in b.iter().zip(moments) {
                k[i].iter_mut().zip(row).for_each(|(k, b)| *k += point.area * moment * b);
            }
        }
    }
    k
}
