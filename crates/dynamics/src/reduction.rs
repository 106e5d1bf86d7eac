//! Reduced models that see a structure through a few rows: the modes that the loads excite, corrected statically and for
//! one step size.
//!
//! ```text
//! Φ: K Φ = M Φ Λ up to a highest frequency        P = Φᵀ Bᵀ
//! X = K⁻¹Bᵀ − Φ Λ⁻¹ P                             what the modes leave of the static compliance B K⁻¹ Bᵀ
//! Y = K̂⁻¹Bᵀ − Φ Λ̂⁻¹ P,  K̂ = c_K K + c_M M         what they leave of a step's compliance S = B K̂⁻¹ Bᵀ
//! ```
//!
//! The model spanned by Φ, X and Y answers static loads and each single step exactly, and vibrates exactly in all modes of
//! Φ. Since K X and K̂ Y are known in advance, its matrices need almost no work; only XᵀMX and YᵀMY do:
//!
//! ```text
//! XᵀKX = B X       XᵀKY = B Y                      YᵀK̂Y = B Y          (each less its part in Φ)
//! XᵀMY = (B X − c_K B Y)/c_M                        ΦᵀKX = ΦᵀMX = ΦᵀKY = ΦᵀMY = 0
//! ```
//!
//! A small eigenproblem then turns X and Y into pseudo-modes, so that every equation stands alone. (Craig & Kurdila,
//! Fundamentals of Structural Dynamics, 2006, chapter 17; MacNeal, Computers & Structures 1, 1971, 581–601.)

use faer::{Mat, MatRef, Side};

use crate::blocks::{inner, solve};
use crate::dense::Dense;
use crate::factor::Factor;
use crate::krylov::{Krylov, Ritz};
use crate::sparse::Pencil;

/// A reduced model: m η̈_j + … + ω_j² η_j = φ_jᵀ f with unit modal mass.
#[derive(Clone, Debug)]
pub struct Basis {
    /// ω², modes first, then pseudo-modes.
    pub omega2: Vec<f64>,
    /// R Φ.
    pub rows: Dense,
    /// Number of true modes.
    pub modes: usize,
}

/// A step's matrix K̂ = c_K K + c_M M.
pub struct StepMatrix<'a> {
    /// Its factor.
    pub factor: &'a Factor,
    /// c_K.
    pub stiffness: f64,
    /// c_M.
    pub mass: f64,
}

/// Vectors whose strain energy is below this part of the largest are combinations of the others.
const DEPENDENT: f64 = 1e-10;
/// Least 1/ω² of a pseudo-mode relative to the largest: below, rounding.
const STIFFEST: f64 = 1e-14;

/// R Z and ZᵀMZ of Z = K⁻¹Bᵀ and of Z = K̂⁻¹Bᵀ: all that a reduction needs of the large model besides its modes.
pub struct Answers {
    x: (Mat<f64>, Mat<f64>),
    y: (Mat<f64>, Mat<f64>),
    stiffness: f64,
    mass: f64,
}

impl Answers {
    /// B are the first `supports` of the `rows`; `stiffness` is the factor of K.
    pub fn new(
        pencil: &Pencil,
        stiffness: &Factor,
        step: &StepMatrix,
        rows: &[Vec<(u32, f64)>],
        supports: usize,
    ) -> Self {
        let x = responses(pencil, stiffness, &rows[..supports], rows);
        let y = responses(pencil, step.factor, &rows[..supports], rows);
        Self { x, y, stiffness: step.stiffness, mass: step.mass }
    }
}

/// The model.
pub fn reduce(answers: &Answers, krylov: &Krylov, ritz: &Ritz, rows: &[Vec<(u32, f64)>]) -> Basis {
    let Answers { x: (x_seen, x_mass), y: (y_seen, y_mass), stiffness: c_k, mass: c_m } = answers;
    let (c_k, c_m, supports) = (*c_k, *c_m, x_mass.ncols());
    let seen = krylov.seen(ritz, rows);
    // Less Φ diag((c_K ω² + shift)^power) P, seen through the rows.
    let less = |matrix: &Mat<f64>, power: f64, shift: f64, factor: f64| -> Mat<f64> {
        let weights: Vec<f64> = ritz.omega2.iter().map(|w2| (factor * w2 + shift).powf(power)).collect();
        let weighted = Mat::from_fn(weights.len(), supports, |k, j| weights[k] * seen[(j, k)]);
        let part = seen.subrows(0, matrix.nrows()) * &weighted;
        matrix - part
    };
    // R X and R Y, less their part in the modes.
    let (rx, ry) = (less(x_seen, -1.0, 0.0, 1.0), less(y_seen, -1.0, c_m, c_k));
    let (kxx, kxy) = (rx.subrows(0, supports).to_owned(), ry.subrows(0, supports).to_owned());
    let (mxx, myy) = (less(x_mass, -2.0, 0.0, 1.0), less(y_mass, -2.0, c_m, c_k));
    let s = supports;
    let k = symmetric(2 * s, |i, j| match (i < s, j < s) {
        (true, true) => kxx[(i, j)],
        (false, false) => (kxy[(i - s, j - s)] - c_m * myy[(i - s, j - s)]) / c_k,
        (true, false) => kxy[(i, j - s)],
        (false, true) => kxy[(j, i - s)],
    });
    let m = symmetric(2 * s, |i, j| match (i < s, j < s) {
        (true, true) => mxx[(i, j)],
        (false, false) => myy[(i - s, j - s)],
        (true, false) => (kxx[(i, j - s)] - c_k * kxy[(i, j - s)]) / c_m,
        (false, true) => (kxx[(j, i - s)] - c_k * kxy[(j, i - s)]) / c_m,
    });
    let (pseudo, shapes) = pseudo_modes(&k, &m);
    let both = Mat::from_fn(rows.len(), 2 * s, |i, j| if j < s { rx[(i, j)] } else { ry[(i, j - s)] });
    let pseudo_rows = &both * &shapes;
    let modes = ritz.omega2.len();
    let columns = modes + pseudo.len();
    let number = |i: usize, j: usize| if j < modes { seen[(i, j)] } else { pseudo_rows[(i, j - modes)] };
    let data = (0..rows.len()).flat_map(|i| (0..columns).map(move |j| (i, j))).map(|(i, j)| number(i, j));
    let rows = Dense::new(columns, data.collect());
    Basis { omega2: ritz.omega2.iter().copied().chain(pseudo).collect(), rows, modes }
}

/// R Z and ZᵀMZ of Z = A⁻¹Bᵀ.
fn responses(
    pencil: &Pencil,
    factor: &Factor,
    loads: &[Vec<(u32, f64)>],
    rows: &[Vec<(u32, f64)>],
) -> (Mat<f64>, Mat<f64>) {
    /// Columns of M Z at a time.
    const BLOCK: usize = 32;
    let (n, s) = (pencil.ndof(), loads.len());
    let mut z = vec![0.0; n * s];
    for (column, load) in z.chunks_exact_mut(n).zip(loads) {
        load.iter().for_each(|(dof, w)| column[*dof as usize] += w);
    }
    z.chunks_mut(n * BLOCK).for_each(|block| solve(factor, block));
    let seen =
        Mat::from_fn(rows.len(), s, |i, j| rows[i].iter().map(|(dof, w)| w * z[j * n + *dof as usize]).sum::<f64>());
    let mut mass = Mat::zeros(s, s);
    let all = MatRef::from_column_major_slice(&z, n, s);
    for first in (0..s).step_by(BLOCK) {
        let width = BLOCK.min(s - first);
        let mut product = vec![0.0; n * width];
        for (x, y) in z[first * n..].chunks_exact(n).zip(product.chunks_exact_mut(n)) {
            pencil.add_mass(x, y);
        }
        let columns = inner(all, MatRef::from_column_major_slice(&product, n, width));
        mass.subcols_mut(first, width).copy_from(columns);
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
