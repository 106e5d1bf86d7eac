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
            Self::GermanTwist { a, omega_c, omega_r, omega_s } => {
                let (square, c2) = (omega * omega, omega_c * omega_c);
                a * c2 * square / ((square + omega_r * omega_r) * (square + c2) * (square + omega_s * omega_s))
            }
            Self::Sncf { a, n0 } => a / (1.0 + n / n0).powi(3) / TAU,
            Self::PowerLaws { pieces } => {
                let piece = pieces.iter().find(|(limit, ..)| limit.is_none_or(|limit| n < limit));
                piece.map_or(0.0, |(_, a, k)| MM2 * a / libm::pow(n, *k) / TAU)
            }
        }
    }

    /// Standard deviation, m, of the irregularity with wavelengths between `shortest` and `longest`, m.
    ///
    /// σ² = ∫ S dΩ = ∫ S Ω d(ln Ω), by the trapezoidal rule in ln Ω.
    #[must_use]
    pub fn sigma(&self, shortest: f64, longest: f64) -> f64 {
        let (low, high) = (libm::log(TAU / longest), libm::log(TAU / shortest));
        let step = (high - low) / INTERVALS as f64;
        let integrand = |i: usize| {
            let omega = libm::exp(low + i as f64 * step);
            self.value(omega) * omega
        };
        let inner: f64 = (1..INTERVALS).map(integrand).sum();
        (step * (0.5 * (integrand(0) + integrand(INTERVALS)) + inner)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use crate::bundled;

    /// Components beside the level, by an independent quadrature, mm.
    #[test]
    fn standard_deviations_of_the_lateral_components_are_the_known_ones() {
        let known = [
            ("german-low", 3.0, 25.0, [0.7135, 1.3680, 0.2485]),
            ("german-high", 3.0, 25.0, [1.2131, 2.2389, 0.3461]),
            ("china-ballastless", 2.0, 120.0, [0.5336, 0.4485, 0.3261]),
            ("fra-6", 3.0, 25.0, [1.4291, 1.9856, 1.9856]),
        ];
        for (name, short, long, expected) in known {
            let all = bundled::lateral(name).expect(name);
            let sigma = [all.alignment, all.cross_level, all.gauge].map(|density| 1e3 * density.sigma(short, long));
            for (sigma, expected) in sigma.into_iter().zip(expected) {
                assert!((sigma - expected).abs() < 1e-4, "{name} {short}–{long} m: {sigma} mm, known {expected} mm");
            }
        }
        let level = 1e3 * bundled::spectrum("fra-6").expect("bundled").sigma(3.0, 25.0);
        assert!((level - 1.4291).abs() < 1e-4, "{level}");
    }

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
