//! Triangular membrane with drilling rotations: the optimal triangle (Felippa, Comput. Methods Appl. Mech. Eng. 192, 2003,
//! 2125–2168), exact for in-plane bending of rectangles split into triangles, of any aspect ratio.
//!
//! ```text
//! K = L E Lᵀ t/A + ¾ β₀ Θᵀ K_θ Θ                    basic part: constant stress; higher part: deviation from it
//! K_θ = A t Σ Q_mᵀ E_n Q_m,   m = midpoints          natural strains along the edges from rotations θ̃ = Θ q
//! θ̃: corner rotation less that of the linear displacement
//! ```

use super::plate::Plate;

/// Over u, v, θ of three corners.
pub(super) type Matrix9 = [[f64; 9]; 9];
type Matrix3 = [[f64; 3]; 3];

/// α_b, share of the drilling rotations in the edges' displacement of the basic part.
const ALPHA: f64 = 1.5;
/// β₁ … β₉ arranged as the first of the three matrices Q.
const BETA: Matrix3 = [[1.0, 2.0, 1.0], [0.0, 1.0, -1.0], [-1.0, -1.0, -2.0]];
/// Least β₀: for ν towards ½ the optimal one vanishes.
const LEAST_BETA_0: f64 = 0.01;

/// K.
pub(super) fn stiffness(p: &[[f64; 2]; 3], plate: &Plate) -> Matrix9 {
    let x = |i: usize, j: usize| p[i - 1][0] - p[j - 1][0];
    let y = |i: usize, j: usize| p[i - 1][1] - p[j - 1][1];
    let double = x(2, 1) * y(3, 1) - x(3, 1) * y(2, 1);
    let area = 0.5 * double;
    let [direct, coupled, shear] = plate.plane_stress();
    let elastic = [[direct, coupled, 0.0], [coupled, direct, 0.0], [0.0, 0.0, shear]];

    let mut lumping = [[0.0; 3]; 9];
    for (corner, (i, j, k)) in [(1, 2, 3), (2, 3, 1), (3, 1, 2)].into_iter().enumerate() {
        lumping[3 * corner] = [0.5 * y(j, k), 0.0, 0.5 * x(k, j)];
        lumping[3 * corner + 1] = [0.0, 0.5 * x(k, j), 0.5 * y(j, k)];
        let rotation = [
            y(j, k) * (y(i, k) - y(j, i)),
            x(k, j) * (x(j, i) - x(i, k)),
            2.0 * (x(k, i) * y(i, k) - x(i, j) * y(j, i)),
        ];
        lumping[3 * corner + 2] = rotation.map(|r| ALPHA / 12.0 * r);
    }
    let mut k = [[0.0; 9]; 9];
    congruent(&mut k, &lumping, &elastic, plate.thickness / area);

    // Squared lengths of the edges 1–2, 2–3, 3–1, and strains from natural ones.
    let square = |i, j| x(i, j) * x(i, j) + y(i, j) * y(i, j);
    let squares = [square(2, 1), square(3, 2), square(1, 3)];
    let mut natural = [[0.0; 3]; 3];
    for (edge, (i, j, k)) in [(1, 2, 3), (2, 3, 1), (3, 1, 2)].into_iter().enumerate() {
        let factor = squares[edge] / (double * double);
        natural[0][edge] = factor * y(j, k) * y(i, k);
        natural[1][edge] = factor * x(j, k) * x(i, k);
        natural[2][edge] = factor * (y(j, k) * x(k, i) + x(k, j) * y(i, k));
    }
    let mut elastic_natural = [[0.0; 3]; 3];
    for (i, row) in elastic_natural.iter_mut().enumerate() {
        for (j, value) in row.iter_mut().enumerate() {
            *value = (0..3)
                .flat_map(|a| (0..3).map(move |b| (a, b)))
                .map(|(a, b)| natural[a][i] * elastic[a][b] * natural[b][j])
                .sum();
        }
    }

    // Q₁ as listed; Q₂ and Q₃ are it with corners and edges turned on by one and two.
    let q = [0, 1, 2].map(|turn| {
        let mut q = [[0.0; 3]; 3];
        for (edge, row) in BETA.iter().enumerate() {
            for (corner, beta) in row.iter().enumerate() {
                let (e, c) = ((edge + turn) % 3, (corner + turn) % 3);
                q[e][c] = double / 3.0 / squares[e] * beta;
            }
        }
        q
    });
    let mut bending = [[0.0; 3]; 3];
    for (a, b) in [(0, 1), (1, 2), (2, 0)] {
        let mut middle = [[0.0; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                // Transposed: `congruent` wants one row per result.
                middle[j][i] = 0.5 * (q[a][i][j] + q[b][i][j]);
            }
        }
        congruent(&mut bending, &middle, &elastic_natural, area * plate.thickness);
    }

    let mut deviation = [[0.0; 3]; 9];
    for (corner, (j, k)) in [(3, 2), (1, 3), (2, 1)].into_iter().enumerate() {
        deviation[3 * corner] = [x(j, k) / (2.0 * double); 3];
        deviation[3 * corner + 1] = [y(j, k) / (2.0 * double); 3];
        deviation[3 * corner + 2][corner] = 1.0;
    }
    let nu = plate.poisson;
    let beta_0 = (0.5 * (1.0 - 4.0 * nu * nu)).max(LEAST_BETA_0);
    congruent(&mut k, &deviation, &bending, 0.75 * beta_0);
    k
}

/// K += factor B E Bᵀ.
fn congruent<const N: usize>(k: &mut [[f64; N]; N], b: &[[f64; 3]; N], e: &Matrix3, factor: f64) {
    for (k, left) in k.iter_mut().zip(b) {
        let row = [0, 1, 2].map(|j| factor * (left[0] * e[0][j] + left[1] * e[1][j] + left[2] * e[2][j]));
        k.iter_mut().zip(b).for_each(|(k, right)| *k += row[0] * right[0] + row[1] * right[1] + row[2] * right[2]);
    }
}
