//! Creep forces of a patch from those of the linear theory.
//!
//! ```text
//! T_x = −G_s ab C₁₁ ξ_x,   T_y = −G_s ab C₂₂ ξ_y − G_s (ab)^{3/2} C₂₃ ξ_s;   T = √(T_x² + T_y²),   u = T/(μN)
//! linear   factor 1
//! Shen     factor 1 − u/3 + u²/27 for u < 3, else 1/u        Shen, Hedrick and Elkins 1983
//! ```

/// How creep forces follow from creepages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Creep {
    /// No creep forces.
    None,
    /// Kalker's linear theory, without a bound.
    Linear,
    /// The linear theory saturated by Shen, Hedrick and Elkins.
    #[default]
    Shen,
    /// Kalker's FASTSIM: the yardstick; slower.
    Fastsim,
}

/// Factor on the linear forces and its derivative by u.
#[must_use]
pub fn shen(u: f64) -> [f64; 2] {
    if u < 3.0 { [1.0 - u / 3.0 + u * u / 27.0, -1.0 / 3.0 + 2.0 * u / 27.0] } else { [1.0 / u, -1.0 / (u * u)] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_saturated_force_reaches_the_bound_without_a_kink() {
        assert!((3.0 * shen(3.0 - 1e-9)[0] - 1.0).abs() < 1e-9);
        assert!((shen(3.0 - 1e-9)[1] - shen(3.0 + 1e-9)[1]).abs() < 1e-8);
        assert_eq!(shen(0.0), [1.0, -1.0 / 3.0]);
        for u in [0.3, 1.7, 4.0] {
            let slope = (shen(u + 1e-6)[0] - shen(u - 1e-6)[0]) / 2e-6;
            assert!((slope - shen(u)[1]).abs() < 1e-9);
        }
    }
}
