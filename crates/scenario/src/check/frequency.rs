//! The first natural frequency of a simply supported span against the limits of EN 1991-2 figure 6.10.
//!
//! ```text
//! n₀ = π/(2L²) √(EI/m)
//! ```

use std::f64::consts::FRAC_PI_2;
use std::sync::LazyLock;

use serde::Deserialize;

use crate::problem::{Report, Warning};
use crate::ranges::{Slip, ends, file, shown, slip, within};
use crate::types::Span;

/// factor · L^exponent up to a length in m.
#[derive(Deserialize)]
struct Piece {
    to: Option<f64>,
    factor: f64,
    exponent: f64,
}

#[derive(Deserialize)]
struct Limits {
    source: String,
    /// Shorter and longer spans are not judged, m.
    lengths: [f64; 2],
    upper: Vec<Piece>,
    lower: Vec<Piece>,
    /// A slip is suspected beyond the limits times this.
    slack: f64,
    slips: Vec<Slip>,
}

static LIMITS: LazyLock<Option<Limits>> = LazyLock::new(|| serde_json::from_str(file("frequencies")).ok());

/// Limits at a length, Hz.
fn at(limits: &Limits, length: f64) -> Option<[f64; 2]> {
    let value = |pieces: &[Piece]| {
        let piece = pieces.iter().find(|piece| piece.to.is_none_or(|to| length <= to))?;
        Some(piece.factor * length.powf(piece.exponent))
    };
    Some([value(&limits.lower)?, value(&limits.upper)?])
}

/// Warns of a span far outside.
pub(super) fn check(span: &Span, path: &str, report: &mut Report) {
    let Some(limits) = &*LIMITS else { return };
    let by_stiffness = |stiffness: f64| FRAC_PI_2 / span.length.powi(2) * (stiffness / span.mass).sqrt();
    let (key, n0) = match (span.first_frequency, span.bending_stiffness) {
        (Some(n0), _) => ("first_frequency", n0),
        (None, Some(stiffness)) => ("bending_stiffness", by_stiffness(stiffness)),
        (None, None) => return,
    };
    let judged = limits.lengths[0] <= span.length && span.length <= limits.lengths[1] && n0 > 0.0 && n0.is_finite();
    let Some([low, high]) = at(limits, span.length).filter(|_| judged) else { return };
    let usual = [Some(low), Some(high)];
    if within([Some(low / limits.slack), Some(high * limits.slack)], n0) {
        return;
    }
    let given = key == "first_frequency";
    let meant = slip(&limits.slips, usual, n0).filter(|_| !given);
    let place = format!("{path}.{key}");
    let text = format!(
        "{place}: first natural frequency {} Hz{}, usual {} for {} m (EN 1991-2 figure \
         6.10){}",
        shown(n0),
        if given { "" } else { " by length, bending_stiffness and mass" },
        ends(usual, "Hz"),
        span.length,
        meant.map_or_else(String::new, |meant| format!(": {meant}"))
    );
    report.note(Warning {
        path: place,
        name: "first natural frequency".into(),
        value: Some(n0),
        unit: "Hz".into(),
        usual,
        slip: meant.map(str::to_owned),
        source: limits.source.clone(),
        text,
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_those_of_the_figure() {
        let limits = LIMITS.as_ref().unwrap();
        // 80/10, 94.76·10^-0.748; 23.58·40^-0.592, 94.76·40^-0.748.
        for (length, [low, high]) in [(10.0, [8.0, 16.93]), (40.0, [2.655, 6.002])] {
            let found = at(limits, length).unwrap();
            assert!((found[0] / low - 1.0).abs() < 1e-3 && (found[1] / high - 1.0).abs() < 1e-3, "{found:?}");
        }
    }

    #[test]
    fn a_stiffness_in_other_units_is_told_by_the_frequency() {
        let span = |stiffness| Span {
            length: 32.5,
            bending_stiffness: Some(stiffness),
            first_frequency: None,
            mass: 29720.0,
            shear_stiffness: None,
            elements: Some(50),
        };
        for (stiffness, expected) in [
            (4.39668e11, None),
            (4.39668e8, Some("bending_stiffness in kN m²")),
            (4.39668e5, Some("bending_stiffness in MN m²")),
            (4.39668e14, Some("a thousand times too large")),
        ] {
            let mut report = Report::new("f");
            check(&span(stiffness), "$.s", &mut report);
            let found = report.warnings.first().map(|warning| warning.to_string());
            assert_eq!(found.is_some(), expected.is_some(), "{found:?}");
            assert!(found.unwrap_or_default().contains(expected.unwrap_or_default()));
        }
    }
}
