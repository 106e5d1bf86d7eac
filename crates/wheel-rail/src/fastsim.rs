//! Kalker's simplified theory: FASTSIM.
//!
//! ```text
//! L₁ = 8a/(3G_s C₁₁),   L₂ = 8a/(3G_s C₂₂),   L₃ = π a √(a/b)/(4G_s C₂₃)
//! bound g = μ (2N/(πab)) (1 − x²/a² − y²/b²)
//! in strips along x from the leading edge x = +a backwards:
//!     p_x ← p_x − (ξ_x/L₁ − y ξ_s/L₃) dx,   p_y ← p_y − (ξ_y/L₂ + x ξ_s/L₃) dx,   shortened to |p| = g where it is longer
//! T = Σ p dx dy
//! ```
//!
//! Kalker, Vehicle System Dynamics 11, 1982, 1–13.

use std::f64::consts::PI;

use crate::kalker::Coefficients;

/// Strips across, and elements along each of them, of a patch.
pub const STRIPS: usize = 20;

/// One elliptic patch.
#[derive(Clone, Copy, Debug)]
pub struct Patch {
    /// Semi-axis along x, m.
    pub along: f64,
    /// Semi-axis across, m.
    pub across: f64,
    /// Normal force, N.
    pub normal: f64,
    /// Friction coefficient.
    pub friction: f64,
    /// Shear modulus, N/m².
    pub shear: f64,
    /// Kalker's coefficients of the ellipse.
    pub kalker: Coefficients,
}

/// T_x and T_y, N, of the creepages ξ_x, ξ_y and ξ_s (1/m), with `strips` strips of `strips` elements.
#[must_use]
pub fn fastsim(patch: &Patch, [x_creep, y_creep, spin]: [f64; 3], strips: usize) -> [f64; 2] {
    let Patch { along: a, across: b, normal, friction, shear, kalker } = *patch;
    let l1 = 8.0 * a / (3.0 * shear * kalker.c11);
    let l2 = 8.0 * a / (3.0 * shear * kalker.c22);
    let l3 = PI * a * (a / b).sqrt() / (4.0 * shear * kalker.c23);
    let bound = friction * 2.0 * normal / (PI * a * b);
    let n = strips as f64;
    let dy = 2.0 * b / n;
    let mut total = [0.0; 2];
    for strip in 0..strips {
        let y = -b + (strip as f64 + 0.5) * dy;
        let edge = a * (1.0 - (y / b).powi(2)).sqrt();
        let dx = 2.0 * edge / n;
        let mut p = [0.0; 2];
        for element in 0..strips {
            // Traction grows by a whole element; slip and bound are those of its middle.
            let x = edge - (element as f64 + 0.5) * dx;
            p[0] -= (x_creep / l1 - y * spin / l3) * dx;
            p[1] -= (y_creep / l2 + x * spin / l3) * dx;
            let g = bound * (1.0 - (x / a).powi(2) - (y / b).powi(2));
            let size = libm::hypot(p[0], p[1]);
            if size > g {
                p = p.map(|p| p * g / size);
            }
            total = [total[0] + p[0] * dx * dy, total[1] + p[1] * dx * dy];
        }
    }
    total
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::creep::shen;

    fn patch() -> Patch {
        let kalker = Coefficients::new(1.5, 0.28);
        Patch { along: 6e-3, across: 4e-3, normal: 70e3, friction: 0.3, shear: 2.1e11 / 2.56, kalker }
    }

    /// −T/(μN) of an independent program with 50 × 50 strips, and of the saturated linear theory.
    const REFERENCE: [([f64; 3], [f64; 2], [f64; 2]); 7] = [
        ([1e-3, 0.0, 0.0], [0.3862, 0.0], [0.3807, 0.0]),
        ([0.0, 1e-3, 0.0], [0.0, 0.3609], [0.0, 0.3556]),
        ([0.0, 0.0, 0.1], [0.0, 0.0949], [0.0, 0.0921]),
        ([2e-3, 2e-3, 0.0], [0.5810, 0.5362], [0.5775, 0.5331]),
        ([1e-3, 1e-3, 0.3], [0.3321, 0.5862], [0.3325, 0.5210]),
        ([0.0, 3e-3, 1.0], [0.0, 0.9032], [0.0, 0.9794]),
        ([0.0, 5e-3, 5.0], [0.0, 0.5211], [0.0, 1.0]),
    ];

    #[test]
    fn forces_are_those_of_an_independent_program() {
        let patch = patch();
        let limit = patch.friction * patch.normal;
        for (creep, expected, _) in REFERENCE {
            let t = fastsim(&patch, creep, 50).map(|t| -t / limit);
            assert!((t[0] - expected[0]).abs() < 6e-5 && (t[1] - expected[1]).abs() < 6e-5, "{creep:?}: {t:?}");
        }
    }

    #[test]
    fn the_saturated_linear_theory_has_its_reference_values() {
        let patch = patch();
        let (area, limit) = (patch.along * patch.across, patch.friction * patch.normal);
        for (creep, _, expected) in REFERENCE {
            let x = patch.shear * area * patch.kalker.c11 * creep[0];
            let spin = area * area.sqrt() * patch.kalker.c23 * creep[2];
            let y = patch.shear * (area * patch.kalker.c22 * creep[1] + spin);
            let factor = shen(libm::hypot(x, y) / limit)[0] / limit;
            let t = [factor * x, factor * y];
            assert!((t[0] - expected[0]).abs() < 6e-5 && (t[1] - expected[1]).abs() < 6e-5, "{creep:?}: {t:?}");
        }
    }

    #[test]
    fn creep_without_spin_never_gives_power() {
        for i in 0..40 {
            let angle = f64::from(i) * 0.157;
            let creep = [3e-3 * angle.cos(), 3e-3 * angle.sin(), 0.0];
            let t = fastsim(&patch(), creep, 10);
            assert!(t[0] * creep[0] + t[1] * creep[1] < 0.0);
        }
    }
}
