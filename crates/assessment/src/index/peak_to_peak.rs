//! Peak to peak within any second, peaks shorter than 50 ms left out (49 CFR 299.313, 213.333).
//!
//! A level counts where the record stays beyond it for 50 ms: with windows of τ = 50 ms inside each second,
//!
//! ```text
//! p = max over seconds of ( max_t min_{[t, t+τ]} a − min_t max_{[t, t+τ]} a )
//! ```

use std::collections::VecDeque;

use super::count;
use crate::error::{SignalError, finite};

/// Greatest value of every window of `n` values, by the order of `beyond`.
fn sliding(signal: &[f64], n: usize, beyond: impl Fn(f64, f64) -> bool) -> Vec<f64> {
    let mut kept: VecDeque<usize> = VecDeque::new();
    let mut out = Vec::with_capacity(signal.len().saturating_sub(n - 1));
    for (i, value) in signal.iter().enumerate() {
        while kept.back().is_some_and(|j| !beyond(signal[*j], *value)) {
            kept.pop_back();
        }
        kept.push_back(i);
        if kept.front().is_some_and(|j| j + n <= i) {
            kept.pop_front();
        }
        if i + 1 >= n {
            out.extend(kept.front().map(|j| signal[*j]));
        }
    }
    out
}

/// The greatest peak to peak within any second of the record (within all of it if it is shorter), with peaks shorter than
/// `least` seconds left out, and the index of the end of that second.
///
/// # Errors
/// The record is shorter than `least`, or a value is not finite.
pub fn peak_to_peak(signal: &[f64], rate: f64, least: f64) -> Result<(f64, usize), SignalError> {
    finite(signal)?;
    let tau = if least > 0.0 { count(least, rate) + 1 } else { 1 };
    if signal.len() < tau {
        let (what, found) = ("peak to peak", signal.len() as f64 / rate);
        return Err(SignalError::TooShort { what, needed: least, found, unit: "s" });
    }
    let above = sliding(signal, tau, |a, b| a < b);
    let below = sliding(signal, tau, |a, b| a > b);
    let second = (count(1.0, rate) + 1).min(signal.len()) + 1 - tau;
    let second = second.clamp(1, above.len());
    let top = sliding(&above, second, |a, b| a > b);
    let bottom = sliding(&below, second, |a, b| a < b);
    let mut greatest = (0.0, tau + second - 2);
    for (i, (top, bottom)) in top.iter().zip(&bottom).enumerate() {
        if top - bottom > greatest.0 {
            greatest = (top - bottom, i + second - 1 + tau - 1);
        }
    }
    Ok(greatest)
}
