//! Cubic interpolation between values with slopes.

/// The cubic over a step with (value, slope) a at its begin and b at its end, at s = 0…1.
pub fn hermite(s: f64, step: f64, a: [f64; 2], b: [f64; 2]) -> f64 {
    let t = 1.0 - s;
    t * t * ((1.0 + 2.0 * s) * a[0] + s * step * a[1]) + s * s * ((1.0 + 2.0 * t) * b[0] - t * step * b[1])
}
