//! Sperling's ride index, from the spectral lines of a piece of record, 0.5 to 40 Hz.
//!
//! ```text
//! A_i = 2/N |Σ_k a_k e^{−2πi f_i k/f_s}|                               lines f_i = i/T, rectangular window
//! discrete (GB/T 5599)   W_i = 3.57 (A_i³ F(f_i)/f_i)^{0.1},  W = (Σ W_i¹⁰)^{0.1},  A in m/s²
//!                        F = 0.325 f² (0.5 … 5.9 Hz), 400/f² (5.9 … 20 Hz), 1 above
//! lateral                F = 0.8 f² (0.5 … 5.4 Hz), 650/f² (5.4 … 26 Hz), 1 above
//! continuous             W_z = (Σ ½ A_i² B_i²)^{1/6.67},  A in cm/s²
//!                        B = 0.588 √((1.911 f² + (0.25 f²)²)/((1 − 0.277 f²)² + (1.563 f − 0.0368 f³)²))
//! ```
//!
//! A Hann window corrected for its gain would spread a line over three and add up to 0.2.

use std::f64::consts::PI;

use crate::error::{SignalError, finite};

/// Lowest and highest frequency, Hz.
const BAND: (f64, f64) = (0.5, 40.0);
/// Lines that are summed side by side.
const ABREAST: usize = 8;

/// A line of a spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Hz.
    pub frequency: f64,
    /// Amplitude, in the unit of the record.
    pub amplitude: f64,
}

/// The lines of the whole record from 0.5 to 40 Hz.
///
/// # Errors
/// A value is not finite, the record has fewer than 80 values in a second, or is shorter than 2 s: then there is no line at
/// 0.5 Hz.
pub fn lines(signal: &[f64], rate: f64) -> Result<Vec<Line>, SignalError> {
    finite(signal)?;
    let (what, seconds) = ("Sperling's index", signal.len() as f64 / rate);
    if rate.is_nan() || rate < 2.0 * BAND.1 {
        return Err(SignalError::TooCoarse { what, frequency: BAND.1, needed: 2.0 * BAND.1, found: rate });
    }
    if seconds < (1.0 - 1e-9) / BAND.0 {
        return Err(SignalError::TooShort { what, needed: 1.0 / BAND.0, found: seconds, unit: "s" });
    }
    let (first, last) = ((BAND.0 * seconds - 1e-9).ceil() as usize, (BAND.1 * seconds + 1e-9).floor() as usize);
    let mut lines = Vec::with_capacity(last + 1);
    for begin in (first.max(1)..=last).step_by(ABREAST) {
        let some = (begin..=last).zip(amplitudes(signal, begin));
        lines.extend(some.map(|(i, amplitude)| Line { frequency: i as f64 / seconds, amplitude }));
    }
    Ok(lines)
}

/// Amplitudes of the lines from `first` on: sums by Horner's rule on the unit circle, z = e^{−iθ}. Each sum waits for itself at
/// every value; side by side they take hardly longer than one.
fn amplitudes(signal: &[f64], first: usize) -> [f64; ABREAST] {
    let n = signal.len() as f64;
    let (mut sin, mut cos) = ([0.0; ABREAST], [0.0; ABREAST]);
    for k in 0..ABREAST {
        (sin[k], cos[k]) = libm::sincos(2.0 * PI * (first + k) as f64 / n);
    }
    let (mut re, mut im) = ([0.0; ABREAST], [0.0; ABREAST]);
    for a in signal.iter().rev() {
        for k in 0..ABREAST {
            (re[k], im[k]) = (re[k] * cos[k] + im[k] * sin[k] + a, im[k] * cos[k] - re[k] * sin[k]);
        }
    }
    std::array::from_fn(|k| 2.0 / n * f64::hypot(re[k], im[k]))
}

/// The discrete index of these lines, amplitudes in m/s².
pub fn sperling(lines: &[Line]) -> f64 {
    discrete(lines, [0.325, 5.9, 400.0, 20.0])
}

/// The discrete index of lateral motion, amplitudes in m/s².
pub fn sperling_lateral(lines: &[Line]) -> f64 {
    discrete(lines, [0.8, 5.4, 650.0, 26.0])
}

/// F = `low` f² below `first` Hz, `high`/f² below `last` Hz, 1 above.
fn discrete(lines: &[Line], [low, first, high, last]: [f64; 4]) -> f64 {
    let term = |line: &Line| {
        let f = line.frequency;
        let weight = match f {
            _ if !(BAND.0 - 1e-9..=BAND.1 + 1e-9).contains(&f) => 0.0,
            _ if f < first => low * f * f,
            _ if f < last => high / (f * f),
            _ => 1.0,
        };
        // W_i¹⁰ without the tenth root between.
        3.57_f64.powi(10) * line.amplitude.powi(3) * weight / f
    };
    libm::pow(lines.iter().map(term).sum::<f64>(), 0.1)
}

/// The continuous index W_z of these lines, amplitudes in m/s².
pub fn sperling_continuous(lines: &[Line]) -> f64 {
    let term = |line: &Line| {
        let (f, f2) = (line.frequency, line.frequency.powi(2));
        let upper = 1.911 * f2 + (0.25 * f2).powi(2);
        let lower = (1.0 - 0.277 * f2).powi(2) + (1.563 * f - 0.0368 * f2 * f).powi(2);
        0.5 * (100.0 * line.amplitude).powi(2) * 0.588_f64.powi(2) * upper / lower
    };
    libm::pow(lines.iter().map(term).sum::<f64>(), 1.0 / 6.67)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One line: W = 3.57 (A³ F/f)^{0.1}.
    #[test]
    fn the_lateral_index_of_a_single_line_is_its_formula() {
        let amplitude: f64 = 0.3;
        for (frequency, weight) in [(1.5, 0.8 * 2.25), (8.0, 650.0 / 64.0), (30.0, 1.0)] {
            let expected = 3.57 * (amplitude.powi(3) * weight / frequency).powf(0.1);
            let found = sperling_lateral(&[Line { frequency, amplitude }]);
            assert!((found / expected - 1.0).abs() < 1e-12, "{frequency} Hz: {found} {expected}");
        }
    }
}
