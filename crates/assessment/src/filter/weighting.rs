//! Frequency weightings of human response, H = H_hp H_lp H_t H_s:
//!
//! ```text
//! H_hp = s²/(s² + √2 ω₁ s + ω₁²)                        f₁ = 0.4 Hz
//! H_lp = ω₂²/(s² + √2 ω₂ s + ω₂²)                       f₂ = 100 Hz
//! H_t  = (1 + s/ω₃)/(1 + s/(Q₄ω₄) + s²/ω₄²)
//! H_s  = K (1 + s/(Q₅ω₅) + s²/ω₅²)/(1 + s/(Q₆ω₆) + s²/ω₆²)
//!
//!                                     f₃ = f₄    Q₄     f₅    Q₅     f₆    Q₆    K
//! wk          ISO 2631-1              12.5 Hz   0.63   2.37  0.91   3.35  0.91  (2.37/3.35)²
//! wb-en12299  EN 12299:2009, UIC 513  16        0.63   2.5   0.80   4     0.80  0.4
//! wb-iso8041  ISO 8041, BS 6841       16        0.55   2.5   0.90   4     0.95  0.4
//! wd          lateral                  2        0.63   without H_s
//! ```
//!
//! Wk agrees with the table of ISO 2631-1 within 0.1 %; the constants of wb-iso8041 are known from secondary sources. Each
//! factor becomes a section by the bilinear transform without prewarping, which needs 1,000 values a second: at 200 the gain at
//! 80 Hz is 8 times too small.

use std::f64::consts::{PI, SQRT_2};

use serde::{Deserialize, Serialize};

use super::{Cascade, Section};
use crate::error::{SignalError, finite};

/// The least number of values in a second.
const LEAST_RATE: f64 = 1000.0;

/// Which weighting.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Weighting {
    /// Vertical, ISO 2631-1.
    #[serde(rename = "wk")]
    Wk,
    /// Vertical, EN 12299:2009.
    #[serde(rename = "wb-en12299")]
    WbEn12299,
    /// Vertical, ISO 8041.
    #[serde(rename = "wb-iso8041")]
    WbIso8041,
    /// Lateral.
    #[serde(rename = "wd")]
    Wd,
}

impl Weighting {
    /// Its label in tables.
    pub fn label(self) -> &'static str {
        match self {
            Self::Wk => "wk",
            Self::WbEn12299 => "wb-en12299",
            Self::WbIso8041 => "wb-iso8041",
            Self::Wd => "wd",
        }
    }

    /// Numerators and denominators of the factors, ascending in s.
    fn factors(self) -> Vec<([f64; 3], [f64; 3])> {
        let omega = |f: f64| 2.0 * PI * f;
        let quadratic = |f: f64, q: f64| [1.0, 1.0 / (q * omega(f)), 1.0 / omega(f).powi(2)];
        let (w1, w2) = (omega(0.4), omega(100.0));
        let (f3, q4, step) = match self {
            Self::Wk => (12.5, 0.63, Some((2.37, 0.91, 3.35, 0.91, (2.37_f64 / 3.35).powi(2)))),
            Self::WbEn12299 => (16.0, 0.63, Some((2.5, 0.80, 4.0, 0.80, 0.4))),
            Self::WbIso8041 => (16.0, 0.55, Some((2.5, 0.90, 4.0, 0.95, 0.4))),
            Self::Wd => (2.0, 0.63, None),
        };
        let mut factors = vec![
            ([0.0, 0.0, 1.0], [w1 * w1, SQRT_2 * w1, 1.0]),
            ([w2 * w2, 0.0, 0.0], [w2 * w2, SQRT_2 * w2, 1.0]),
            ([1.0, 1.0 / omega(f3), 0.0], quadratic(f3, q4)),
        ];
        if let Some((f5, q5, f6, q6, k)) = step {
            factors.push((quadratic(f5, q5).map(|value| k * value), quadratic(f6, q6)));
        }
        factors
    }

    /// |H| of the definition at `frequency`, Hz.
    pub fn gain(self, frequency: f64) -> f64 {
        let omega = 2.0 * PI * frequency;
        let amount = |[p0, p1, p2]: [f64; 3]| (p0 - p2 * omega * omega).hypot(p1 * omega);
        self.factors().into_iter().map(|(n, d)| amount(n) / amount(d)).product()
    }

    /// The weighted record, from rest.
    ///
    /// # Errors
    /// The record has fewer than 1,000 values in a second, or a value that is not finite.
    pub fn apply(self, signal: &[f64], rate: f64) -> Result<Vec<f64>, SignalError> {
        finite(signal)?;
        // Not by a last bit: a step of 0.001 s is no binary number.
        if rate.is_nan() || rate < LEAST_RATE * (1.0 - 1e-9) {
            let (what, frequency) = ("a frequency weighting with its limit", 100.0);
            return Err(SignalError::TooCoarse { what, frequency, needed: LEAST_RATE, found: rate });
        }
        let sections = self.factors().into_iter().map(|(n, d)| Section::bilinear(n, d, rate)).collect();
        let mut weighted = signal.to_vec();
        Cascade::new(sections).from_rest(weighted.as_chunks_mut::<1>().0);
        Ok(weighted)
    }
}
