//! A random sample of a one-sided spectral density S(Ω) is
//!
//! ```text
//! r(x) = Σ_k √(2 S(Ω_k) ΔΩ) cos(Ω_k x + φ_k),   Ω_k = k ΔΩ,   ΔΩ = 2π/P
//! ```
//!
//! over the wavelengths asked for, with phases φ_k drawn from ChaCha8 in the order of k. P is a power of two of metres, at
//! least 4,096 and at least twice the wheels' passage, and x counts from 0 of the track. So one seed gives one rail: the same for
//! every train, speed, approach and wavelength band (a wider band adds waves and leaves the others), as long as the passage is
//! below 2,048 m; a longer one takes the next P and with it another rail. Nothing but sums and the sines of the crate libm
//! enters, in a fixed order: the sample has the same bits on every system.
//!
//! The sum is transformed once into a table of r and r′ over P with at least 32 points per shortest wave: both together, as real
//! and imaginary part of one sum, to which a wave c = ½a e^{iφ} at Ω gives (1 − Ω) c at k and (1 + Ω) c̄ at −k. Between its points
//! the cubic through both is off by at most (2π/32)⁴/384 = 4e-6 of the amplitude of the shortest wave, and by the fourth
//! power of the ratio less for longer ones.

use std::f64::consts::TAU;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use ttb_scenario::spec::Density;

use super::fourier::{self, Complex};
use super::hermite::hermite;

/// A random rail repeats itself after this length, m, or twice the wheels' passage, rounded up to a power of two.
pub const LEAST_PERIOD: f64 = 4096.0;
/// Points of the table per shortest wave.
const POINTS_PER_WAVE: f64 = 32.0;

/// r and r′ at equal distances over one period.
#[derive(Clone, Debug)]
pub struct Table {
    /// P, m.
    period: f64,
    /// Distance of the points, m.
    step: f64,
    /// (r in m, r′), the first at x = 0.
    points: Vec<Complex>,
}

impl Table {
    /// A sample of `density` with wavelengths from `shortest` to `longest` for a passage of `length` m.
    /// `stream` tells the components of one seed apart; the level is 0.
    pub fn draw(density: &Density, [shortest, longest]: [f64; 2], length: f64, seed: u64, stream: u8) -> Self {
        let period = next_power(LEAST_PERIOD.max(2.0 * length));
        let count = next_power(POINTS_PER_WAVE * period / shortest) as usize;
        let spacing = TAU / period; // ΔΩ
        let band = (period / longest, period / shortest); // in units of ΔΩ
        let (first, last) = (band.0.round() as usize, band.1.round() as usize);

        let mut points = vec![[0.0; 2]; count];
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        key[8] = stream;
        let mut random = ChaCha8Rng::from_seed(key);
        for k in 1..=last {
            let phase = TAU * (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
            if k < first {
                continue; // its phase is drawn all the same: the others must not depend on the band
            }
            let omega = k as f64 * spacing;
            // at the ends of the band a wave carries that part of its ΔΩ which lies within
            let width = spacing * ((k as f64 + 0.5).min(band.1) - (k as f64 - 0.5).max(band.0));
            let amplitude = (2.0 * density.value(omega) * width).sqrt();
            let (sin, cos) = libm::sincos(phase);
            let [re, im] = [cos, sin].map(|part| 0.5 * amplitude * part);
            points[k] = [(1.0 - omega) * re, (1.0 - omega) * im];
            points[count - k] = [(1.0 + omega) * re, -(1.0 + omega) * im];
        }
        fourier::sum(&mut points);
        Self { period, step: period / count as f64, points }
    }

    /// r(x), from the cubic with the values and slopes of the two neighbouring points.
    pub fn at(&self, x: f64) -> f64 {
        let position = x.rem_euclid(self.period) / self.step;
        let i = position as usize % self.points.len();
        let j = (i + 1) % self.points.len();
        hermite(position.fract(), self.step, self.points[i], self.points[j])
    }
}

/// The least power of two that is no smaller than `x`.
fn next_power(x: f64) -> f64 {
    libm::exp2(libm::log2(x).ceil())
}
