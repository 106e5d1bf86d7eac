//! Mean over a length of way, centred.
//!
//! ```text
//! m(s) = 1/(b − a) ∫_a^b x ds,   a = max(s − ℓ/2, 0), b = min(s + ℓ/2, S)
//! ```
//!
//! x is straight between two values, so that the integral is exact: with C_k = ∫_0^{s_k} x ds by trapezoids, the value between
//! two of them is a parabola. The window is cut at the ends of the record.

use crate::error::{SignalError, finite};

/// The mean over `length` m of a record with a value every `way` m.
///
/// # Errors
/// A length is not positive, or a value is not finite.
pub fn sliding_mean(signal: &[f64], way: f64, length: f64) -> Result<Vec<f64>, SignalError> {
    finite(signal)?;
    for (what, value) in [("the distance between two values", way), ("the length of a sliding mean", length)] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(SignalError::OutOfRange { what, rule: "positive and finite", value });
        }
    }
    let Some(last) = signal.len().checked_sub(1).filter(|last| *last > 0) else { return Ok(signal.to_vec()) };
    let mut sums = vec![0.0; last + 1];
    for k in 0..last {
        sums[k + 1] = sums[k] + 0.5 * (signal[k] + signal[k + 1]);
    }
    // In units of the distance between two values.
    let integral = |s: f64| {
        let k = (s as usize).min(last - 1);
        let r = s - k as f64;
        sums[k] + r * signal[k] + 0.5 * r * r * (signal[k + 1] - signal[k])
    };
    let half = 0.5 * length / way;
    Ok((0..=last)
        .map(|k| {
            let (a, b) = ((k as f64 - half).max(0.0), (k as f64 + half).min(last as f64));
            (integral(b) - integral(a)) / (b - a)
        })
        .collect())
}
