//! What lies above the modes: pseudo-modes, or, where the forces are many, [`crate::local`]'s poles.

use std::sync::Arc;

use ttb_dynamics::dense::Dense;
use ttb_dynamics::near::Near;
use ttb_dynamics::newmark::Newmark;
use ttb_dynamics::reduction::{Answers, Shifted, reduce};
use ttb_sparse::excited::{Excited, Ritz, Vectors};
use ttb_sparse::{Factor, FactorError, Pencil};

use super::Supports;
use crate::compliance::Compliance;
use crate::deck::Row;
use crate::law::Law;
use crate::lazy::Lazy;
use crate::local::Local;
use crate::rows::Rows;

/// Up to so many forces pseudo-modes are made: up to three vectors a force, and errors several times smaller.
const MANY: usize = 600;
/// Poles stand for many modes, which must overlap: damping ratio at the modes' highest frequency that this takes.
const OVERLAP: f64 = 0.02;
/// Pseudo-modes with a smaller share in every compliance are left out.
const NEGLIGIBLE: f64 = 1e-6;
/// Numbers of Gᵢ/λᵢ below this part of the geometric mean of H at both supports are left out.
const FAR: f64 = 1e-3;
/// About the ratio of neighbouring σₐ up to that of a step.
const RATIO: f64 = 4.0;
/// The σₐ beyond, in multiples of a step's.
const BEYOND: [f64; 3] = [4.0, 16.0, 64.0];
/// The first pole lies above the modes by this factor in ω²; the others follow in equal ratios.
const FIRST_POLE: f64 = 1.3;
/// The last pole's λ in multiples of the last σₐ.
const LAST_POLE: f64 = 2.0;
/// Vectors that are no modes yet are taken up to this multiple of the modes' highest frequency.
const REACH: f64 = 4.0;

/// What is sampled of the large model before modes are sought.
pub enum Above {
    /// Answers that pseudo-modes are made of.
    Pseudo(Answers),
    /// H(σₐ) at rising σₐ, by rows over all that is seen.
    Samples(Vec<(f64, Dense)>),
}

/// A reduced model's coordinates.
pub struct Coordinates {
    /// ω² of all, (rad/s)².
    pub omega2: Vec<f64>,
    /// Supports and monitored points, seen in them.
    pub rows: Rows,
    /// Number of pseudo-modes.
    pub pseudo_modes: usize,
    /// Number of poles in their place.
    pub local_poles: usize,
}

impl Above {
    /// Samples the model between statics and a step for modes up to `hertz` or more.
    ///
    /// # Errors
    /// A combination is not positive definite.
    pub fn new(
        pencil: &Arc<Pencil>,
        stiffness: &Factor,
        rows: &[Row],
        supports: Supports,
        (law, newmark): (&Law, &Newmark),
        hertz: f64,
    ) -> Result<Self, FactorError> {
        let [c_k, c_m] = law.effective(newmark);
        let (highest, step) = (std::f64::consts::TAU * hertz, c_m / c_k);
        let overlap = 0.5 * (law.alpha / highest + law.beta * highest) >= OVERLAP;
        // A small model has no factor by panels, which the samples need.
        if overlap && supports.ports > MANY.max(supports.stations.len()) && stiffness.panels().is_some() {
            return Self::samples(pencil, rows, supports.ports, highest * highest, step);
        }
        // Between statics and a step, on a logarithmic scale.
        let between = highest * step.sqrt();
        let mut answers = Answers::default();
        answers.add(pencil, Shifted { factor: stiffness, stiffness: 1.0, mass: 0.0 }, rows, supports.ports);
        for [stiffness, mass] in [[1.0, between], [c_k, c_m]] {
            let factor = pencil.factor(stiffness, mass, 0.0)?;
            answers.add(pencil, Shifted { factor: &factor, stiffness, mass }, rows, supports.ports);
        }
        Ok(Self::Pseudo(answers))
    }

    /// From the lowest σ, where the modes end, to a step's, and beyond.
    fn samples(pencil: &Pencil, rows: &[Row], ports: usize, lowest: f64, step: f64) -> Result<Self, FactorError> {
        let lowest = lowest.min(step / RATIO);
        let intervals = (step / lowest).log(RATIO).round().max(1.0);
        let below = (0..=intervals as u32).map(|i| lowest * (step / lowest).powf(f64::from(i) / intervals));
        let sparse = Rows::new(rows);
        let mut samples = Vec::new();
        for sigma in below.chain(BEYOND.map(|times| times * step)) {
            let factor = pencil.factor(1.0, sigma, 0.0)?;
            if let Some(Compliance::Dense(answer)) =
                Lazy::new(&factor, &sparse, ports, &[], &[]).map(Lazy::into_compliance)
            {
                samples.push((sigma, answer));
            }
        }
        Ok(Self::Samples(samples))
    }

    /// The model with the modes found up to `highest`, rad/s.
    pub fn coordinates(&self, excited: &Excited, ritz: &Ritz, rows: &[Row], highest: f64) -> Coordinates {
        match self {
            Self::Pseudo(answers) => {
                let basis = reduce(answers, excited, &ritz.modes, rows, NEGLIGIBLE);
                let pseudo_modes = basis.omega2.len() - basis.modes;
                let rows = Rows::Single(basis.shapes.single());
                Coordinates { omega2: basis.omega2, rows, pseudo_modes, local_poles: 0 }
            }
            Self::Samples(samples) => {
                let first = FIRST_POLE * highest * highest;
                let last = samples.last().map_or(first, |(sigma, _)| sigma * LAST_POLE).max(2.0 * first);
                let ratio = (last / first).powf(1.0 / (samples.len() - 1).max(1) as f64);
                let poles: Vec<f64> = (0..samples.len()).map(|i| first * ratio.powi(i as i32)).collect();
                // T101 stays right at the σₐ with any vectors: those that are no modes yet show what resonates above.
                let vectors = ritz.up_to(REACH * highest);
                let local = local(samples, &poles, excited, &vectors, rows);
                let omega2 = local.omega2(&vectors.omega2, &poles);
                Coordinates { omega2, rows: Rows::Local(local), pseudo_modes: 0, local_poles: poles.len() }
            }
        }
    }
}

/// φⱼ, gⱼᵢ and Gᵢ.
fn local(samples: &[(f64, Dense)], poles: &[f64], excited: &Excited, vectors: &Vectors, rows: &[Row]) -> Local {
    let seen = excited.seen(vectors, rows);
    let shapes = (0..vectors.omega2.len()).flat_map(|j| (0..rows.len()).map(move |r| (r, j)));
    let shapes = Dense::new(rows.len(), shapes.map(|place| seen[place]).collect()).single();
    let sigma: Vec<f64> = samples.iter().map(|(sigma, _)| *sigma).collect();
    let c = |a: usize, i: usize| inverse_cauchy(poles, &sigma, a, i);
    let share = |w2: f64, i: usize| (0..sigma.len()).map(|a| c(a, i) / (w2 + sigma[a])).sum::<f64>();
    let shares = vectors.omega2.iter().flat_map(|w2| (0..poles.len()).map(move |i| (*w2, i)));
    let shares = Dense::new(poles.len(), shares.map(|(w2, i)| share(w2, i)).collect());
    let forces = samples.first().map_or(0, |(_, answer)| answer.columns());
    let scale: Vec<f64> =
        samples.first().map_or(Vec::new(), |(_, h)| (0..forces).map(|q| h.row(q)[q].sqrt()).collect());
    let near = poles.iter().enumerate().map(|(i, pole)| {
        let weights: Vec<f64> = (0..sigma.len()).map(|a| c(a, i)).collect();
        let mut near = Near::new(rows.len());
        let mut row = vec![0.0; rows.len()];
        for q in 0..forces {
            row.fill(0.0);
            for ((_, answer), weight) in samples.iter().zip(&weights) {
                // H is symmetric among the supports; the monitored points come after them.
                row.iter_mut().zip(answer.row(q)).for_each(|(g, h)| *g += weight * h);
                (forces..rows.len()).for_each(|r| row[r] += weight * answer.row(r)[q]);
            }
            let matters = |r: usize| r >= forces || row[r].abs() > FAR * pole * scale[r] * scale[q];
            near.push(&row, matters);
        }
        near.single()
    });
    let near = near.collect();
    Local::new(shapes, shares, near)
}

/// Entry (a, i) of the inverse of [1/(λᵢ + σₐ)], a Cauchy matrix, in closed form.
fn inverse_cauchy(poles: &[f64], sigma: &[f64], a: usize, i: usize) -> f64 {
    let (s, pole) = (sigma[a], poles[i]);
    let of_poles = poles.iter().enumerate().filter(|(k, _)| *k != i).map(|(_, other)| (s + other) / (other - pole));
    let of_sigma = sigma.iter().enumerate().filter(|(k, _)| *k != a).map(|(_, other)| (pole + other) / (other - s));
    (pole + s) * of_poles.chain(of_sigma).product::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closed_form_is_the_inverse() {
        let (poles, sigma) = ([2.0, 7.0, 30.0, 400.0], [1.0, 5.0, 11.0, 90.0]);
        for a in 0..4 {
            for b in 0..4 {
                let product: f64 = (0..4).map(|i| inverse_cauchy(&poles, &sigma, a, i) / (poles[i] + sigma[b])).sum();
                let expected = f64::from(u8::from(a == b));
                assert!((product - expected).abs() < 1e-11, "{a} {b}: {product}");
            }
        }
    }
}
