//! The simple accelerations: none, and Aitken's relaxation.

use crate::acceleration::verbs::Acceleration;

/// λ^k = G(λ^{k−1}): the paper's iteration.
#[derive(Debug, Default)]
pub struct FixedPoint;

impl Acceleration for FixedPoint {
    fn begin_step(&mut self) {}
    fn update(&mut self, lambda: &mut [f64], residual: &[f64]) {
        lambda.iter_mut().zip(residual).for_each(|(l, r)| *l += r);
    }
    fn end_step(&mut self, _lambda: &[f64], _residual: &[f64]) {}
}

/// Aitken's dynamic relaxation (Küttler & Wall, Comput. Mech. 43, 2008, eq. 44):
///
/// ```text
/// λ^k = λ^{k−1} + ω_k r_k,     ω_k = −ω_{k−1} r_{k−1}·(r_k − r_{k−1}) / |r_k − r_{k−1}|²
/// ```
///
/// ω is kept in [0.05, 1]: all eigenvalues of −∂G/∂λ are real and not negative (a deck that yields takes load off its
/// supports), so the best factor 1/(1 + ρ) lies there. The last ω of a step begins the next one.
#[derive(Debug)]
pub struct Aitken {
    omega: f64,
    previous: Vec<f64>,
    first: bool,
}

impl Aitken {
    /// For `n` coupled forces, ω₀ = 1.
    pub fn new(n: usize) -> Self {
        Self { omega: 1.0, previous: vec![0.0; n], first: true }
    }
}

impl Acceleration for Aitken {
    fn begin_step(&mut self) {
        self.first = true;
    }
    fn update(&mut self, lambda: &mut [f64], residual: &[f64]) {
        if !self.first {
            self.omega = relaxation(self.omega, &self.previous, residual);
        }
        lambda.iter_mut().zip(residual).for_each(|(l, r)| *l += self.omega * r);
        self.previous.copy_from_slice(residual);
        self.first = false;
    }
    fn end_step(&mut self, _lambda: &[f64], _residual: &[f64]) {}
}

/// Aitken's next ω, in [0.05, 1], from the last one, the residual before it and the one after it.
pub(crate) fn relaxation(omega: f64, before: &[f64], after: &[f64]) -> f64 {
    let (mut product, mut square) = (0.0, 0.0);
    for (r, p) in after.iter().zip(before) {
        let change = r - p;
        product += p * change;
        square += change * change;
    }
    let next = if square > 0.0 { omega * (-product / square) } else { omega };
    next.clamp(0.05, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Trials until |r| ≤ 1e-10 for the scalar map G(λ) = 1 − ρ λ.
    fn trials(acceleration: &mut dyn Acceleration, rho: f64) -> usize {
        let mut lambda = [0.0];
        acceleration.begin_step();
        for k in 1..100 {
            let r = 1.0 - rho * lambda[0] - lambda[0];
            if r.abs() <= 1e-10 {
                return k;
            }
            acceleration.update(&mut lambda, &[r]);
        }
        100
    }

    #[test]
    fn aitken_needs_three_trials_for_one_unknown_even_where_the_fixed_point_diverges() {
        assert_eq!(trials(&mut Aitken::new(1), 1.15), 3);
        assert_eq!(trials(&mut FixedPoint, 1.15), 100);
        assert!(trials(&mut FixedPoint, 0.1) <= 12);
    }
}
