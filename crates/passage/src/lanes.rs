//! Numbers that go side by side in a vector, and bounds of them.

/// Modes or lines that are taken together.
pub const QUAD: usize = 4;
/// What rounding may add to a bound, of the sum of magnitudes.
pub const ROUNDING: f64 = 1e-12;

/// The larger number: one instruction, where `f64::max` takes several for the sake of NaN.
#[inline(always)]
pub fn larger(a: f64, b: f64) -> f64 {
    if a < b { b } else { a }
}

/// The smaller number, likewise.
#[inline(always)]
pub fn smaller(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}
