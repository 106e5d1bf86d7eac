//! Power spectral densities of track irregularity: values and standard deviations.

use std::f64::consts::TAU;

use crate::spec::Density;

/// Intervals of the quadrature in ln Ω; the densities are power laws in pieces, so few would do.
const INTERVALS: usize = 4096;
/// 1 mm² in m².
const MM2: f64 = 1e-6;

impl Density {
    /// S(Ω), one-sided, in m²/(rad/m), at Ω in rad/m.
    ///
    /// Densities over the spatial frequency n = Ω/2π in 1/m become densities over Ω by S(Ω) = S(n)/2π.
    #[must_use]
    pub fn value(&self, omega: f64) -> f64 {
        let n = omega / TAU;
        match self {
            Self::German { a, omega_c, omega_r } => {
                let (square, c2, r2) = (omega * omega, omega_c * omega_c, omega_r * omega_r);
                a * c2 / ((square + r2) * (square + c2))
            }
            Self::Sncf { a, n0 } => a / (1.0 + n / n0).powi(3) / TAU,
            Self::PowerLaws { pieces } => {
                let piece = pieces.iter().find(|(limit, ..)| limit.is_none_or(|limit| n < limit));
                piece.map_or(0.0, |(_, a, k)| MM2 * a / n.powf(*k) / TAU)
            }
        }
    }

    /// Standard deviation, m, of the irregularity with wavelengths between `shortest` and `longest`, m.
    ///
    /// σ² = ∫ S dΩ = ∫ S Ω d(ln Ω), by the trapezoidal rule in ln Ω.
    #[must_use]
    pub fn sigma(&self, shortest: f64, longest: f64) -> f64 {
        let (low, high) = ((TAU / longest).ln(), (TAU / shortest).ln());
        let step = (high - low) / INTERVALS as f64;
        let integrand = |i: usize| {
            let omega = (low + i as f64 * step).exp();
            self.value(omega) * omega
        };
        let inner: f64 = (1..INTERVALS).map(integrand).sum();
        (step * (0.5 * (integrand(0) + integrand(INTERVALS)) + inner)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use crate::bundled;

    /// docs/theory.md 15, mm.
    #[test]
    fn standard_deviations_of_the_bundled_spectra_are_the_known_ones() {
        let known = [
            ("german-low", 3.0, 25.0, 0.9843),
            ("german-high", 3.0, 25.0, 1.6109),
            ("german-low", 1.0, 80.0, 2.0740),
            ("german-high", 1.0, 80.0, 3.3943),
            ("sncf-good", 2.0, 40.0, 1.2837),
            ("sncf-poor", 2.0, 40.0, 2.4073),
            ("china-ballastless", 2.0, 120.0, 0.7150),
        ];
        for (name, short, long, expected) in known {
            let sigma = 1e3 * bundled::spectrum(name).expect(name).sigma(short, long);
            assert!((sigma - expected).abs() < 1e-4, "{name} {short}–{long} m: {sigma} mm, known {expected} mm");
        }
    }
}
