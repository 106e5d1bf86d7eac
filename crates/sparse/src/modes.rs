//! Lowest natural modes, K φ = ω² M φ, none missing.
//!
//! b start vectors run in a queue (`lanczos.rs`, one vector at a time), so that modes that come up to b times, as on
//! a row of equal spans, are all met. Converged values are accepted only when the count of eigenvalues below the last one,
//! from the inertia of K − σM, agrees; otherwise fresh start vectors join. Everything is deterministic.

use nalgebra::{DMatrix, SymmetricEigen};

use crate::factor::Factor;
use crate::lanczos::Lanczos;
use crate::pencil::Pencil;
use crate::random::Random;

/// Modes, lowest first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Modes {
    /// Squares of the circular frequencies, ω² in (rad/s)².
    pub omega2: Vec<f64>,
    /// φ, M-normalised (φᵀMφ = 1 kg), each with its largest entry positive.
    pub shapes: Vec<Vec<f64>>,
}

impl Modes {
    /// Natural frequencies, Hz.
    pub fn frequencies(&self) -> impl Iterator<Item = f64> {
        self.omega2.iter().map(|w2| w2.sqrt() / std::f64::consts::TAU)
    }
}

/// Why modes were not found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ModesError {
    /// More than there are.
    #[error("{asked} modes were asked for, the model has {available}")]
    TooMany {
        /// Number of modes that were asked for.
        asked: usize,
        /// Degrees of freedom with mass.
        available: usize,
    },
}

/// Start vectors b.
const QUEUE: usize = 4;
/// Residual of A φ = θ φ relative to θ: the error of φ where modes are well apart; that of ω² is its square.
const TOLERANCE: f64 = 1e-11;
/// What rounding leaves of the residual in any case, relative to the largest θ.
const ROUNDING: f64 = 1e-14;

/// The `count` lowest modes; `stiffness` is the factor of K.
///
/// # Errors
/// [`ModesError::TooMany`].
pub fn lowest(pencil: &Pencil, stiffness: &Factor, count: usize) -> Result<Modes, ModesError> {
    let lanczos = Lanczos::new(pencil, stiffness, 1);
    let mut search = Search { pencil, lanczos, random: Random::default() };
    search.invite();
    let mut check_at = 2 * count + 2 * QUEUE;
    loop {
        while search.lanczos.processed() < check_at && search.advance() {}
        let available = search.lanczos.processed();
        let complete = available < check_at;
        if complete && available < count {
            return Err(ModesError::TooMany { asked: count, available });
        }
        if let Some(modes) = search.converged(count, complete) {
            return Ok(modes);
        }
        check_at += check_at / 4 + QUEUE;
    }
}

struct Search<'a> {
    pencil: &'a Pencil,
    lanczos: Lanczos<'a>,
    random: Random,
}

impl Search<'_> {
    /// Adds start vectors to the queue, as many as the space still has room for.
    fn invite(&mut self) {
        for _ in 0..QUEUE {
            let x: Vec<f64> = (0..self.pencil.ndof()).map(|_| self.random.draw()).collect();
            self.lanczos.start_with_mass(&x);
        }
    }

    /// Processes the next vector of the queue; false when the space is complete.
    fn advance(&mut self) -> bool {
        if self.lanczos.is_closed() {
            self.invite();
        }
        self.lanczos.advance()
    }

    /// The modes, if all have converged and none is missing; otherwise new start vectors may have joined.
    fn converged(&mut self, count: usize, complete: bool) -> Option<Modes> {
        let p = self.lanczos.processed();
        let eigen = SymmetricEigen::new(DMatrix::from_fn(p, p, |i, j| self.lanczos.projected(i, j)));
        let mut order: Vec<usize> = (0..p).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        let omega2: Vec<f64> = order.iter().map(|&j| 1.0 / eigen.eigenvalues[j]).collect();
        if !complete {
            let residual = |j: &usize| self.lanczos.residual(eigen.eigenvectors.column(*j).iter().copied());
            let tolerance = |j: &usize| TOLERANCE * eigen.eigenvalues[*j] + ROUNDING * eigen.eigenvalues[order[0]];
            if order[..count].iter().any(|j| residual(j) > tolerance(j)) {
                return None;
            }
            // σ stands in the first clear gap above the last mode asked for.
            let last = (count - 1..p - 1).find(|&j| omega2[j + 1] > 1.001 * omega2[j])?;
            let sigma = (omega2[last] * omega2[last + 1]).sqrt();
            if self.pencil.count_below(sigma) != Some(last + 1) {
                self.invite();
                return None;
            }
        }
        let shapes = order[..count].iter().map(|&j| {
            let mut shape = self.lanczos.combine(eigen.eigenvectors.column(j).iter().copied());
            let largest = shape.iter().fold(0.0_f64, |m, x| if x.abs() > m.abs() { *x } else { m });
            shape.iter_mut().for_each(|x| *x *= largest.signum());
            shape
        });
        let shapes = shapes.collect();
        Some(Modes { omega2: omega2[..count].to_vec(), shapes })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::Assembly;
    use crate::vector::dot;

    /// `copies` separate chains of `n` unit springs and masses, fixed at the left.
    fn chains(copies: u32, n: u32, massless: bool) -> Pencil {
        let mut assembly = Assembly::new((copies * n) as usize);
        for i in 0..copies * n {
            let dofs = [i.checked_sub(1).filter(|_| i % n != 0), Some(i)];
            let m = if massless && i % 2 == 0 { 0.0 } else { 1.0 };
            assembly.add(&dofs, &[[1.0, -1.0], [-1.0, 1.0]], &[[0.0, 0.0], [0.0, m]]);
        }
        assembly.finish().unwrap()
    }

    fn omega2(j: usize, n: u32) -> f64 {
        let angle = (2.0 * j as f64 - 1.0) * std::f64::consts::PI / (4.0 * f64::from(n) + 2.0);
        4.0 * angle.sin().powi(2)
    }

    #[test]
    fn a_chain_has_its_closed_form_modes() {
        let pencil = chains(1, 200, false);
        let modes = lowest(&pencil, &pencil.factor(1.0, 0.0, 0.0).unwrap(), 12).unwrap();
        for (j, w2) in modes.omega2.iter().enumerate() {
            assert!((w2 / omega2(j + 1, 200) - 1.0).abs() < 1e-11, "mode {}: {w2}", j + 1);
        }
        for (i, a) in modes.shapes.iter().enumerate() {
            let mut ma = vec![0.0; a.len()];
            pencil.add_mass(a, &mut ma);
            for (j, b) in modes.shapes.iter().enumerate() {
                assert!((dot(&ma, b) - f64::from(u8::from(i == j))).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn every_copy_of_a_repeated_mode_is_found() {
        let pencil = chains(11, 30, false);
        let modes = lowest(&pencil, &pencil.factor(1.0, 0.0, 0.0).unwrap(), 25).unwrap();
        for (j, w2) in modes.omega2.iter().enumerate() {
            assert!((w2 / omega2(j / 11 + 1, 30) - 1.0).abs() < 1e-10, "mode {}: {w2}", j + 1);
        }
    }

    #[test]
    fn all_modes_of_a_small_system_and_no_more() {
        let pencil = chains(1, 5, false);
        let factor = pencil.factor(1.0, 0.0, 0.0).unwrap();
        let modes = lowest(&pencil, &factor, 5).unwrap();
        assert!(modes.omega2.iter().enumerate().all(|(j, w2)| (w2 / omega2(j + 1, 5) - 1.0).abs() < 1e-12));
        assert_eq!(lowest(&pencil, &factor, 6), Err(ModesError::TooMany { asked: 6, available: 5 }));
    }

    #[test]
    fn what_has_no_mass_has_no_mode() {
        let pencil = chains(1, 8, true);
        let factor = pencil.factor(1.0, 0.0, 0.0).unwrap();
        assert_eq!(lowest(&pencil, &factor, 5), Err(ModesError::TooMany { asked: 5, available: 4 }));
        // Masses 1 at every second of springs 1: a chain of springs 1/2.
        let modes = lowest(&pencil, &factor, 4).unwrap();
        let expected = (1..=4).map(|j| 0.5 * omega2(j, 4));
        assert!(modes.omega2.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-10), "{:?}", modes.omega2);
    }
}
