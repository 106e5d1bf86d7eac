//! Percentiles, linear between neighbours (type 7, the default of numpy and R).
//!
//! ```text
//! p = q/100,  k = (n − 1) p,  x = x_⌊k⌋ + (k − ⌊k⌋)(x_⌊k⌋₊₁ − x_⌊k⌋)      x_0 ≤ x_1 ≤ … sorted
//! ```

/// Percentile `q` (0 to 100) of values in any order; `None` without values, with a NaN among them, or with `q` outside its range.
pub fn percentile(values: &[f64], q: f64) -> Option<f64> {
    if values.is_empty() || !(0.0..=100.0).contains(&q) || values.iter().any(|value| value.is_nan()) {
        return None;
    }
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let k = (sorted.len() - 1) as f64 * q / 100.0;
    let below = k.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    Some(sorted[below] + (k - below as f64) * (sorted[above] - sorted[below]))
}
