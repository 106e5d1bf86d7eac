//! Reduced models that see a structure through a few rows: the modes that the loads excite, corrected
//! statically, for one step size, and in between.
//!
//! ```text
//! Φ: K Φ = M Φ Λ up to a highest frequency        P = Φᵀ Bᵀ
//! Z = (c K + m M)⁻¹Bᵀ − Φ (cΛ + m)⁻¹ P             what the modes leave of the compliance B (c K + m M)⁻¹ Bᵀ
//! ```
//!
//! for a few combinations (c, m): statics (1, 0), a step (c_K, c_M) and, between them, others that represent all modes
//! above the highest frequency. The model spanned by Φ and all Z answers static loads and each single step exactly, and
//! vibrates exactly in the modes of Φ. Its matrices need almost no work, because (c K + m M) Z is known in advance:
//!
//! ```text
//! ZₐᵀKZ_b = (mₐ B Zₐ − m_b B Z_b)/(c_b mₐ − cₐ m_b)      ZₐᵀMZ_b = (c_b B Z_b − cₐ B Zₐ)/(c_b mₐ − cₐ m_b)
//! ZₐᵀKZₐ = (B Zₐ − mₐ ZₐᵀMZₐ)/cₐ                          ΦᵀKZ = ΦᵀMZ = 0
//! ```
//!
//! A small eigenproblem then turns all Z into pseudo-modes, so that every equation stands alone. (Craig & Kurdila,
//! Fundamentals of Structural Dynamics, 2006, chapter 17; MacNeal, Computers & Structures 1, 1971, 581–601.)

use faer::{Mat, MatRef, Side};

use crate::dense::Dense;
use ttb_sparse::Factor;
use ttb_sparse::Pencil;
use ttb_sparse::blocks::{inner, solve_loads};
use ttb_sparse::excited::{Excited, Vectors};

/// A reduced model: m η̈_j + … + ω_j² η_j = φ_jᵀ f with unit modal mass.
#[derive(Clone, Debug)]
pub struct Basis {
    /// ω², modes first, then pseudo-modes.
    pub omega2: Vec<f64>,
    /// Row j: R φ_j.
    pub shapes: Dense,
    /// Number of true modes.
    pub modes: usize,
}

/// A combination c_K K + c_M M.
pub struct Shifted<'a> {
    /// Factor of the combination.
    pub factor: &'a Factor,
    /// The factor c_K on K.
    pub stiffness: f64,
    /// The factor c_M on M.
    pub mass: f64,
}

/// Vectors whose strain energy is below this part of the largest are combinations of the others.
const DEPENDENT: f64 = 1e-10;
/// Least 1/ω² of a pseudo-mode relative to the largest: below, rounding.
const STIFFEST: f64 = 1e-14;

/// R Z and ZᵀMZ of Z = (c_K K + c_M M)⁻¹Bᵀ for one combination.
struct Answer {
    stiffness: f64,
    mass: f64,
    seen: Mat<f64>,
    inertia: Mat<f64>,
}

/// All that a reduction needs of the large model besides its modes.
#[derive(Default)]
pub struct Answers(Vec<Answer>);

impl Answers {
    /// Adds those to loads through B, the first `supports` of the `rows`, under a combination.
    pub fn add(&mut self, pencil: &Pencil, shifted: Shifted, rows: &[Vec<(u32, f64)>], supports: usize) {
        let (seen, inertia) = responses(pencil, shifted.factor, &rows[..supports], rows);
        self.0.push(Answer { stiffness: shifted.stiffness, mass: shifted.mass, seen, inertia });
    }
}

/// The model. Pseudo-modes that matter less than `negligible` (relative, in every combination's compliance) are left out.
pub fn reduce(
    answers: &Answers,
    excited: &Excited,
    found: &Vectors,
    rows: &[Vec<(u32, f64)>],
    negligible: f64,
) -> Basis {
    let s = answers.0.first().map_or(0, |answer| answer.inertia.ncols());
    let seen = excited.seen(found, rows);
    // Each less its part in the modes, Φ diag((c_K ω² + c_M)^power) P seen through the rows.
    let less = |matrix: &Mat<f64>, power: i32, answer: &Answer| -> Mat<f64> {
        let weight = |w2: &f64| (answer.stiffness * w2 + answer.mass).powi(power);
        let weights: Vec<f64> = found.omega2.iter().map(weight).collect();
        let weighted = Mat::from_fn(weights.len(), s, |k, j| weights[k] * seen[(j, k)]);
        let part = seen.subrows(0, matrix.nrows()) * &weighted;
        matrix - part
    };
    let of_rows: Vec<Mat<f64>> = answers.0.iter().map(|answer| less(&answer.seen, -1, answer)).collect();
    let inertia: Vec<Mat<f64>> = answers.0.iter().map(|answer| less(&answer.inertia, -2, answer)).collect();
    // Entries (i, j) of ZₐᵀKZ_b and ZₐᵀMZ_b from Zₐᵀ(c_b K + m_b M)Z_b = B Zₐ and its counterpart.
    let pair = |a: usize, b: usize, i: usize, j: usize| -> (f64, f64) {
        let [(ca, ma), (cb, mb)] = [a, b].map(|x| (answers.0[x].stiffness, answers.0[x].mass));
        let (ga, gb) = (of_rows[a][(i, j)], of_rows[b][(i, j)]);
        if a == b {
            let m = inertia[a][(i, j)];
            ((ga - ma * m) / ca, m)
        } else {
            let determinant = cb * ma - ca * mb;
            ((ma * ga - mb * gb) / determinant, (cb * gb - ca * ga) / determinant)
        }
    };
    let n = s * answers.0.len();
    let k = symmetric(n, |i, j| pair(i / s, j / s, i % s, j % s).0);
    let m = symmetric(n, |i, j| pair(i / s, j / s, i % s, j % s).1);
    let (omega2, shapes) = pseudo_modes(&k, &m);
    let all = Mat::from_fn(rows.len(), n, |i, j| of_rows[j / s][(i, j % s)]);
    let pseudo_rows = &all * &shapes;
    let kept = significant(answers, &omega2, &pseudo_rows, s, negligible);
    let modes = found.omega2.len();
    let columns = modes + kept.len();
    let number = |i: usize, j: usize| if j < modes { seen[(i, j)] } else { pseudo_rows[(i, kept[j - modes])] };
    let data = (0..columns).flat_map(|j| (0..rows.len()).map(move |i| (i, j))).map(|(i, j)| number(i, j));
    let shapes = Dense::new(rows.len(), data.collect());
    let pseudo = kept.iter().map(|&j| omega2[j]);
    Basis { omega2: found.omega2.iter().copied().chain(pseudo).collect(), shapes, modes }
}

/// Pseudo-modes whose share in some combination's compliance, at some support, is not negligible.
fn significant(answers: &Answers, omega2: &[f64], rows: &Mat<f64>, supports: usize, negligible: f64) -> Vec<usize> {
    let matters = |j: usize| {
        answers.0.iter().any(|answer| {
            let impedance = answer.stiffness * omega2[j] + answer.mass;
            (0..supports).any(|i| rows[(i, j)].powi(2) > negligible * answer.seen[(i, i)] * impedance)
        })
    };
    (0..omega2.len()).filter(|&j| matters(j)).collect()
}

/// R Z and ZᵀMZ of Z = A⁻¹Bᵀ.
fn responses(
    pencil: &Pencil,
    factor: &Factor,
    loads: &[Vec<(u32, f64)>],
    rows: &[Vec<(u32, f64)>],
) -> (Mat<f64>, Mat<f64>) {
    /// Columns of M Z at a time.
    const BLOCK: usize = 64;
    let (n, s) = (pencil.ndof(), loads.len());
    let mut z = vec![0.0; n * s];
    for (block, loads) in z.chunks_mut(n * BLOCK).zip(loads.chunks(BLOCK)) {
        for (column, load) in block.chunks_exact_mut(n).zip(loads) {
            load.iter().for_each(|(dof, w)| column[*dof as usize] += w);
        }
        solve_loads(factor, block, loads.iter().flatten().map(|(dof, _)| *dof));
    }
    let seen =
        Mat::from_fn(rows.len(), s, |i, j| rows[i].iter().map(|(dof, w)| w * z[j * n + *dof as usize]).sum::<f64>());
    // ZᵀMZ is symmetric: its upper half by blocks of columns, the other mirrored.
    let mut mass = Mat::zeros(s, s);
    for first in (0..s).step_by(BLOCK) {
        let (width, end) = (BLOCK.min(s - first), (first + BLOCK).min(s));
        let mut product = vec![0.0; n * width];
        for (x, y) in z[first * n..].chunks_exact(n).zip(product.chunks_exact_mut(n)) {
            pencil.add_mass(x, y);
        }
        let above = MatRef::from_column_major_slice(&z[..end * n], n, end);
        let columns = inner(above, MatRef::from_column_major_slice(&product, n, width));
        mass.submatrix_mut(0, first, end, width).copy_from(&columns);
        mass.submatrix_mut(first, 0, width, end).copy_from(columns.transpose());
    }
    (seen, mass)
}

fn symmetric(n: usize, entry: impl Fn(usize, usize) -> f64) -> Mat<f64> {
    Mat::from_fn(n, n, |i, j| 0.5 * (entry(i, j) + entry(j, i)))
}

/// ω² and M-normalised shapes of a small pencil whose matrices may be singular: first by strain energy, then by mass.
fn pseudo_modes(k: &Mat<f64>, m: &Mat<f64>) -> (Vec<f64>, Mat<f64>) {
    let n = k.nrows();
    let scale: Vec<f64> = (0..n).map(|i| if k[(i, i)] > 0.0 { k[(i, i)].sqrt().recip() } else { 0.0 }).collect();
    let scaled = Mat::from_fn(n, n, |i, j| scale[i] * k[(i, j)] * scale[j]);
    let Ok(eigen) = scaled.self_adjoint_eigen(Side::Lower) else { return (Vec::new(), Mat::zeros(n, 0)) };
    let values = eigen.S().column_vector();
    let largest = values.iter().fold(0.0_f64, |a, b| a.max(*b));
    let kept: Vec<usize> = (0..n).filter(|&j| values[j] > DEPENDENT * largest).collect();
    // Unit strain energy each.
    let v = Mat::from_fn(n, kept.len(), |i, j| scale[i] * eigen.U()[(i, kept[j])] / values[kept[j]].sqrt());
    let mass = v.transpose() * m * &v;
    let mass = symmetric(kept.len(), |i, j| mass[(i, j)]);
    let Ok(eigen) = mass.self_adjoint_eigen(Side::Lower) else { return (Vec::new(), Mat::zeros(n, 0)) };
    let values = eigen.S().column_vector();
    let largest = values.iter().fold(0.0_f64, |a, b| a.max(*b));
    // μ = 1/ω², in falling order.
    let mu: Vec<f64> = (0..kept.len()).rev().map(|j| values[j].max(STIFFEST * largest)).collect();
    let last = kept.len();
    let z = Mat::from_fn(last, last, |i, j| eigen.U()[(i, last - 1 - j)] / mu[j].sqrt());
    (mu.iter().map(|mu| 1.0 / mu).collect(), &v * &z)
}
