//! Complete elliptic integrals by the arithmetic–geometric mean.
//!
//! ```text
//! a₀ = 1, b₀ = k, c₀ = e;   a_{n+1} = (a + b)/2,  b_{n+1} = √(ab),  c_{n+1} = (a − b)/2;   k² + e² = 1
//! K = π/(2a_∞),   E = K (1 − Σ 2^{n−1} c_n²)
//! ```
//!
//! Abramowitz and Stegun, Handbook of Mathematical Functions, 17.6.

use std::f64::consts::FRAC_PI_2;

/// K and E of one modulus, and Σ 2^{n−1} c_n² = 1 − E/K, which is exact also where K and E nearly agree.
#[derive(Clone, Copy, Debug)]
pub struct Integrals {
    /// K(e).
    pub k: f64,
    /// E(e).
    pub e: f64,
    /// 1 − E/K.
    pub deficit: f64,
}

/// The integrals for the complementary modulus `k` = √(1 − e²), 0 < k ≤ 1.
#[must_use]
pub fn integrals(k: f64) -> Integrals {
    let (mut a, mut b) = (1.0_f64, k);
    let (mut c_squared, mut weight) = ((1.0 - k) * (1.0 + k), 0.5);
    let mut deficit = 0.0;
    // Convergence is quadratic; what is left at the end is below the square of rounding.
    while c_squared > 1e-30 * a * a {
        deficit += weight * c_squared;
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        (c_squared, weight) = (c * c, 2.0 * weight);
    }
    let integral = FRAC_PI_2 / a;
    Integrals { k: integral, e: integral * (1.0 - deficit), deficit }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz and Stegun, table 17.1: m = e² = 0.5 and 0.99.
    #[test]
    fn the_integrals_have_their_tabulated_values() {
        let half = integrals(0.5_f64.sqrt());
        assert!((half.k - 1.854_074_677_301_372).abs() < 1e-14, "{half:?}");
        assert!((half.e - 1.350_643_881_047_675).abs() < 1e-14, "{half:?}");
        let slender = integrals(0.1);
        assert!((slender.k - 3.695_637_362_989_875).abs() < 1e-13, "{slender:?}");
        assert!((slender.e - 1.015_993_545_025_224).abs() < 1e-14, "{slender:?}");
        let round = integrals(1.0);
        assert_eq!((round.k, round.e, round.deficit), (FRAC_PI_2, FRAC_PI_2, 0.0));
    }
}
