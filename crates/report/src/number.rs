//! Numbers as engineers read them: units of people, digits that matter.

/// Factor and unit in which people read a quantity of an SI unit.
pub fn readable(unit: &str) -> (f64, &str) {
    match unit {
        "m" => (1e3, "mm"),
        "N" => (1e-3, "kN"),
        "N.m" => (1e-3, "kN m"),
        "m/s2" => (1.0, "m/s²"),
        "rad" => (1e3, "mrad"),
        "s" => (1e3, "ms"),
        "1" => (1.0, ""),
        other => (1.0, other),
    }
}

/// A number with this many significant digits, without exponent.
pub fn digits(value: f64, significant: i32) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    let decimals = (significant - 1 - value.abs().log10().floor() as i32).clamp(0, 12) as usize;
    format!("{value:.decimals$}")
}

/// Four digits, or as many more as are needed to tell the value from `limit`.
pub fn beside(value: f64, limit: Option<f64>) -> String {
    let Some(limit) = limit.filter(|limit| *limit != value) else { return digits(value, 4) };
    (4..=12)
        .map(|n| digits(value, n))
        .find(|text| text.parse::<f64>().is_ok_and(|told| told != limit && (told > limit) == (value > limit)))
        .unwrap_or_else(|| value.to_string())
}

/// Without trailing zeros.
pub fn short(value: f64) -> String {
    let text = digits(value, 6);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

/// A value of an SI unit with the unit of people.
pub fn with_unit(value: f64, unit: &str) -> String {
    let (factor, name) = readable(unit);
    format!("{} {name}", digits(value * factor, 4)).trim_end().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_just_above_its_limit_is_shown_above_it() {
        assert_eq!(beside(3.500_1, Some(3.5)), "3.5001");
        assert_eq!(beside(3.499_999_9, Some(3.5)), "3.4999999");
        assert_eq!((beside(3.5, Some(3.5)), beside(2.0, None)), ("3.500".into(), "2.000".into()));
        assert_eq!(
            (digits(0.001_234_56, 3), digits(-12_345.6, 3), short(2.50)),
            ("0.00123".into(), "-12346".into(), "2.5".into())
        );
        assert_eq!(with_unit(0.012_345, "m"), "12.35 mm");
    }
}
