//! Statistics of one value over irregularity seeds.
//!
//! ```text
//! s² = Σ(x − x̄)²/(n − 1),   95 % of type 7,   confidence that the greatest of n values is above the 95 % fractile: 1 − 0.95ⁿ
//! ```
//!
//! The fractile of the sample is an estimate; with n < 59 not even the greatest value is a 95 % fractile at 95 % confidence.

use serde::{Deserialize, Serialize};

use crate::percentile::percentile;

/// A value and the seed that gave it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seeded {
    /// Seed of the irregularity.
    pub seed: u64,
    /// The value.
    pub value: f64,
}

/// What a sample of seeds says.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Number of values.
    pub n: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation with n − 1; none of a single value.
    pub deviation: Option<f64>,
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// 95 % fractile of the sample, type 7.
    pub p95: f64,
    /// Seed of the greatest value; of several the smallest seed.
    pub seed_of_max: u64,
    /// Confidence that the greatest value is not below the 95 % fractile of all rails.
    pub confidence: f64,
}

impl Sample {
    /// Of these values; `None` without values or with one that is not finite.
    pub fn of(values: &[Seeded]) -> Option<Self> {
        let n = values.len();
        let first = values.first()?;
        if values.iter().any(|one| !one.value.is_finite()) {
            return None;
        }
        let plain: Vec<f64> = values.iter().map(|one| one.value).collect();
        let mean = plain.iter().sum::<f64>() / n as f64;
        let squares: f64 = plain.iter().map(|x| (x - mean).powi(2)).sum();
        let greatest = values.iter().fold(first, |greatest, one| {
            let above = one.value > greatest.value || (one.value == greatest.value && one.seed < greatest.seed);
            if above { one } else { greatest }
        });
        Some(Self {
            n,
            mean,
            deviation: (n > 1).then(|| (squares / (n - 1) as f64).sqrt()),
            min: plain.iter().copied().fold(f64::INFINITY, f64::min),
            max: greatest.value,
            p95: percentile(&plain, 95.0)?,
            seed_of_max: greatest.seed,
            confidence: confidence(n, 0.95),
        })
    }
}

/// Confidence that the greatest of `n` values is not below the fractile `p` (0.95 or 0.98) of all.
pub fn confidence(n: usize, p: f64) -> f64 {
    1.0 - p.powf(n as f64)
}

/// The least number of values whose greatest is a fractile `p` at this confidence: 59 for 95 % and 95 %.
pub fn least_number(p: f64, confidence: f64) -> usize {
    ((1.0 - confidence).ln() / p.ln() - 1e-9).ceil() as usize
}
