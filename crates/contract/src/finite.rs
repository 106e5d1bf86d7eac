//! Numbers that are none: found, and never lost in a maximum.

/// The first number that is NaN or infinite.
pub fn not_finite(values: &[f64]) -> Option<usize> {
    // Nearly always there is none: without a way out of the loop it is done several numbers at a time.
    let any = values.iter().fold(false, |any, x| any | !x.is_finite());
    if any { values.iter().position(|x| !x.is_finite()) } else { None }
}

/// The greatest of some numbers, at least 0; NaN if one of them is NaN. (`f64::max` would pass over it.)
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, larger)
}

/// The greater of two numbers; NaN if one of them is NaN.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a >= b { a } else { b }
}

/// The smaller of two numbers; NaN if one of them is NaN.
pub fn smaller(a: f64, b: f64) -> f64 {
    if a.is_nan() || a <= b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_nan_is_not_lost_wherever_it_stands() {
        for at in 0..3 {
            let mut values = [1.0, 3.0, 2.0];
            assert_eq!((largest(values), not_finite(&values)), (3.0, None));
            values[at] = f64::NAN;
            assert!(largest(values).is_nan());
            assert_eq!(not_finite(&values), Some(at));
        }
        assert_eq!(largest([]), 0.0);
    }
}
