//! Root of the mean square, over the whole record and running.
//!
//! ```text
//! rms = √(1/n Σ a_k²),     running: the same over each window of τ seconds; its greatest value is MTVV for τ = 1 s
//! ```

use super::count;
use crate::error::{SignalError, finite};

/// Over the whole record; 0 without values.
pub fn rms(signal: &[f64]) -> f64 {
    if signal.is_empty() {
        return 0.0;
    }
    (signal.iter().map(|a| a * a).sum::<f64>() / signal.len() as f64).sqrt()
}

/// The greatest over any window of `seconds`, and the index of the last value of that window.
///
/// # Errors
/// The record is shorter than the window, or a value is not finite.
pub fn running_rms(signal: &[f64], rate: f64, seconds: f64) -> Result<(f64, usize), SignalError> {
    finite(signal)?;
    let n = count(seconds, rate);
    if signal.len() < n {
        let (what, found) = ("a running root mean square", signal.len() as f64 / rate);
        return Err(SignalError::TooShort { what, needed: seconds, found, unit: "s" });
    }
    let mut sums = Vec::with_capacity(signal.len() + 1);
    let mut sum = 0.0;
    sums.push(sum);
    for a in signal {
        sum += a * a;
        sums.push(sum);
    }
    let mut greatest = (0.0, n - 1);
    for end in n..=signal.len() {
        let window = sums[end] - sums[end - n];
        if window > greatest.0 {
            greatest = (window, end - 1);
        }
    }
    Ok(((greatest.0 / n as f64).sqrt(), greatest.1))
}
