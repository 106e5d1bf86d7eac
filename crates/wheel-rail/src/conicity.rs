//! Equivalent conicity: the conicity of the cone on which a free wheelset has the same wavelength.
//!
//! ```text
//! y″ = −Δr(y)/(e r0),   Δr(y) = r(y) − r(−y);   started at rest from the amplitude ŷ
//! ½ y′² = ∫_y^ŷ Δr/(e r0) dy,   L = 4 ∫_0^ŷ dy/|y′|;   tan γ_e = (2π/L)² e r0/2
//! ```
//!
//! EN 15302; the integral over y is made regular by y = ŷ sin τ. Δr is odd: both wheels have the same profile.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::geometry::{Geometry, Region};

/// Distance of the contacts that the standard reckons with, m.
pub const CONTACT_DISTANCE: f64 = 1.5;
/// Points of the integrals over a quarter of the wave.
const POINTS: usize = 2000;

/// tan γ_e of a wheelset with rolling radius `radius` on `geometry` for the `amplitude`, m.
#[must_use]
pub fn equivalent_conicity(geometry: &Geometry, radius: f64, amplitude: f64) -> f64 {
    let change = |d: f64| geometry.region(Region::Tread).radius_change(d);
    of_difference(|y| change(y) - change(-y), radius, amplitude)
}

/// tan γ_e for a given difference of the rolling radii over the lateral displacement, both in m.
#[must_use]
pub fn of_difference(difference: impl Fn(f64) -> f64, radius: f64, amplitude: f64) -> f64 {
    let step = FRAC_PI_2 / POINTS as f64;
    // ∫ Δr dy from ŷ inwards, by the trapezoidal rule on τ = π/2 … 0; the slope at the middle of each step by the mean.
    let (mut work, mut wave) = (0.0, 0.0);
    let mut before = None;
    for i in (0..POINTS).rev() {
        let tau = (i as f64 + 0.5) * step;
        // Δr dy/dτ at the middle of the step
        let density = difference(amplitude * libm::sin(tau)) * amplitude * libm::cos(tau);
        // Δr dy/dτ is odd about the turning point.
        let middle = work + 0.5 * step * (0.75 * density + 0.25 * before.unwrap_or(-density));
        work += step * density;
        before = Some(density);
        let slope = (2.0 * middle / (CONTACT_DISTANCE * radius)).sqrt();
        wave += step * amplitude * libm::cos(tau) / slope;
    }
    let length = 4.0 * wave;
    (TAU / length).powi(2) * CONTACT_DISTANCE * radius / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_has_its_own_conicity() {
        for amplitude in [1e-3, 5e-3] {
            let conicity = of_difference(|y| 2.0 * 0.05 * y, 0.46, amplitude);
            assert!((conicity - 0.05).abs() < 1e-4, "{conicity}");
        }
    }
}
