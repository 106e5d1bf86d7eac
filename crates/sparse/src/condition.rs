//! How much of a static solution K x = f rounding leaves.
//!
//! ```text
//! κ = |x|ᵀ|K||x| / xᵀK x          terms of strain energy against their sum
//! δ = K⁻¹ (f − K x)               one step of iterative refinement, residual in twice the precision
//! ```
//!
//! When an element moves rigidly, its terms x_i K_ij x_j cancel; each of them carries an error of ε = 2⁻⁵² at most,
//! and the factor makes errors of the same size. So the compliance fᵀx may be wrong by κε of itself (componentwise
//! condition; Skeel, J. ACM 26, 1979, 494–526). fᵀδ/fᵀx is the factor's share, K itself taken as exact. A beam of n elements
//! has κ ≈ 0.5 n⁴.

use crate::factor::Factor;
use crate::pencil::Pencil;
use crate::vector::dot;

/// What is known of a solution's accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// κ, at least 1.
    pub number: f64,
    /// |fᵀδ|/fᵀx: change of the compliance by one step of refinement, relative.
    pub refined: f64,
}

/// Of the bound κ ε about so much is found, in the steps of a beam of 1,000 to 5,000 elements
/// (`crates/bridge/tests/fine_mesh.rs`).
const TYPICAL: f64 = 0.2;

impl Condition {
    /// Solves for the load f with the factor of K; `None` for a load that does no work.
    pub fn of(pencil: &Pencil, stiffness: &Factor, load: &[f64]) -> Option<Self> {
        let mut scratch = vec![0.0; load.len()];
        let mut x = load.to_vec();
        stiffness.solve_in_place(&mut x, &mut scratch);
        let work = dot(load, &x);
        if work == 0.0 {
            return None;
        }
        let mut correction = pencil.residual(load, &x);
        stiffness.solve_in_place(&mut correction, &mut scratch);
        let refined = dot(load, &correction) / work;
        Some(Self { number: pencil.stiffness_of_magnitudes(&x) / work.abs(), refined: refined.abs() })
    }

    /// Expected error of displacements, relative.
    pub fn error(&self) -> f64 {
        let expected = TYPICAL * self.number * f64::EPSILON;
        if self.refined > expected || self.refined.is_nan() { self.refined } else { expected }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::Assembly;

    /// Springs 1 in a row, fixed at the left.
    fn chain(n: u32) -> Pencil {
        let mut assembly = Assembly::new(n as usize);
        for i in 0..n {
            assembly.add(&[i.checked_sub(1), Some(i)], &[[1.0, -1.0], [-1.0, 1.0]], &[[0.0; 2]; 2]);
        }
        assembly.finish().unwrap()
    }

    #[test]
    fn a_pulled_chain_has_the_condition_of_its_closed_form() {
        // x_i = i under a force at the end: xᵀKx = n, |x|ᵀ|K||x| = Σ (2i−1)².
        let (n, pencil) = (40, chain(40));
        let mut load = vec![0.0; n];
        load[n - 1] = 1.0;
        let found = Condition::of(&pencil, &pencil.factor(1.0, 0.0, 0.0).unwrap(), &load).unwrap();
        let expected = (1..=n).map(|i| (2 * i - 1).pow(2) as f64).sum::<f64>() / n as f64;
        assert!((found.number / expected - 1.0).abs() < 1e-12, "{found:?} {expected}");
        assert!(found.refined < 1e-13);
        assert_eq!(Condition::of(&pencil, &pencil.factor(1.0, 0.0, 0.0).unwrap(), &vec![0.0; n]), None);
    }

    #[test]
    fn a_residual_is_exact_where_a_plain_one_is_rounding() {
        // K = (1, −1; −1, 1 + 2⁻⁵²), x = (3, 3): K x = (0, 3·2⁻⁵²).
        let tiny = f64::EPSILON;
        let mut assembly = Assembly::new(2);
        assembly.add(&[Some(0), Some(1)], &[[1.0, -1.0], [-1.0, 1.0 + tiny]], &[[0.0; 2]; 2]);
        let pencil = assembly.finish().unwrap();
        assert_eq!(pencil.residual(&[tiny, tiny], &[3.0, 3.0]), [tiny, -2.0 * tiny]);
    }
}
