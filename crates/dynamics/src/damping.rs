//! Damping laws: Rayleigh by two frequencies, and a ratio per mode.
//!
//! ```text
//! Rayleigh   C = αM + βK,   ζ(ω) = α/(2ω) + βω/2,   α = 2ζ ω₁ω₂/(ω₁ + ω₂),   β = 2ζ/(ω₁ + ω₂)
//! modal      C = MΦ diag(2ζω) ΦᵀM,   Φ M-normalised
//! ```
//!
//! (Clough & Penzien, Dynamics of Structures, 2003, section 12.5.) Newmark's matrix with modal damping is a sparse matrix
//! A = K + a₀M plus a low-rank term. Its inverse in closed form (Woodbury, with KΦ = MΦ diag(ω²)), e_j = a₁ 2ζω_j:
//!
//! ```text
//! (A + MΦ diag(e) ΦᵀM)⁻¹ f = A⁻¹f − Φ diag(e_j / ((ω_j² + a₀)(ω_j² + a₀ + e_j))) Φᵀf
//! ```

/// α (1/s) and β (s) that give the ratio `zeta` at the circular frequencies `omega` (rad/s).
pub fn rayleigh(zeta: f64, omega: [f64; 2]) -> (f64, f64) {
    let sum = omega[0] + omega[1];
    (2.0 * zeta * omega[0] * omega[1] / sum, 2.0 * zeta / sum)
}

/// The diagonal of the closed form: what modal damping of 2ζω = `rate` (1/s) takes off the undamped solution in a mode
/// of ω² = `omega2`, with Newmark's a₀ and a₁.
pub fn modal_correction(rate: f64, omega2: f64, a0: f64, a1: f64) -> f64 {
    let (e, undamped) = (a1 * rate, omega2 + a0);
    e / (undamped * (undamped + e))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rayleigh_meets_its_ratio_at_both_frequencies() {
        let (alpha, beta) = rayleigh(0.05, [7.0, 29.0]);
        for omega in [7.0, 29.0] {
            assert!((alpha / (2.0 * omega) + beta * omega / 2.0 - 0.05).abs() < 1e-15);
        }
    }

    #[test]
    fn the_modal_correction_inverts_one_degree_of_freedom() {
        // M = 1, K = ω²: (ω² + a₀ + a₁c)⁻¹ = (ω² + a₀)⁻¹ − correction.
        let (omega2, a0, a1, c) = (50.0, 400.0, 20.0, 1.3);
        let exact = 1.0 / (omega2 + a0 + a1 * c);
        assert!((1.0 / (omega2 + a0) - modal_correction(c, omega2, a0, a1) - exact).abs() < 1e-16);
    }
}
