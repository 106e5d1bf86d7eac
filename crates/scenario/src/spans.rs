//! Spans of beams: their bending stiffness from a first frequency, and the first frequency that a row of them has.
//!
//! ```text
//! simply supported   ω² = p⁴ EI/m / (1 + p² EI/κGA),  p = π/L          exact without rotary inertia
//! continuous         A(ω) θ = 0: rotations over the bearings, by slope and deflection of vibrating spans
//!                    near end  EI/L · λ (cosh λ sin λ − sinh λ cos λ)/(1 − cosh λ cos λ),   λ⁴ = ω² m L⁴/EI
//!                    far end   EI/L · λ (sinh λ − sin λ)/(1 − cosh λ cos λ)
//! ```
//!
//! Cutting a continuous beam over its bearings makes it softer, holding its rotations there stiffer: its first frequency lies
//! between the least of its spans simply supported and the least of them clamped at both ends. Below it A is positive
//! definite, above it is not, and in between no span has a frequency of its own with both ends clamped (Wittrick & Williams).

use std::f64::consts::{PI, TAU};

use crate::problem::Report;
use crate::spec::{Span, StructureSpec};
use crate::types;

/// Elements of a span that says nothing.
const ELEMENTS: usize = 50;
/// λ of the first frequency of a beam with both ends clamped.
const CLAMPED: f64 = 4.730_040_744_862_704;
/// Below this λ the series is exact to rounding, and the closed form is not.
const SMALL: f64 = 0.3;
/// Halvings of the interval that holds a frequency.
const HALVINGS: usize = 60;

/// The spans with their stiffnesses; which of EI and first frequency is missing or too much is reported.
pub(crate) fn resolve(
    given: &[types::Span],
    continuous: bool,
    first_frequency: Option<f64>,
    report: &mut Report,
) -> Option<Vec<Span>> {
    let before = report.problems.len();
    let path = "$.bridge.structure";
    if let Some(n0) = first_frequency.filter(|_| !continuous) {
        let rule = "simply supported spans have a first frequency each: first_frequency belongs into the spans";
        report.problem(format!("{path}.first_frequency"), rule, format!("{n0} Hz"));
    }
    let mut spans = Vec::with_capacity(given.len());
    for (i, span) in given.iter().enumerate() {
        let here = format!("{path}.spans[{i}]");
        let stiffness = match (span.bending_stiffness, span.first_frequency) {
            (Some(_), Some(_)) => {
                report.problem(&here, "a span has either bending_stiffness or first_frequency", "both");
                f64::NAN
            }
            (None, Some(n0)) if continuous => {
                let rule = "a continuous beam has one first frequency: it belongs beside the spans";
                report.problem(format!("{here}.first_frequency"), rule, format!("{n0} Hz"));
                f64::NAN
            }
            (Some(stiffness), None) => stiffness,
            (None, Some(n0)) => by_frequency(span, n0, &here, report),
            (None, None) if continuous && first_frequency.is_some() => 1.0,
            (None, None) => {
                let rule = "a span needs its bending_stiffness or its first_frequency";
                report.problem(&here, rule, "neither");
                f64::NAN
            }
        };
        spans.push(Span {
            length: span.length,
            bending_stiffness: stiffness,
            mass: span.mass,
            shear_stiffness: span.shear_stiffness,
            elements: span.elements.unwrap_or(ELEMENTS),
        });
    }
    if let Some(n0) = first_frequency.filter(|_| continuous && report.problems.len() == before) {
        if spans.iter().any(|span| span.shear_stiffness.is_some()) {
            let rule = "of spans that are soft in shear give the bending_stiffness, not the first frequency";
            report.problem(format!("{path}.first_frequency"), rule, format!("{n0} Hz"));
        } else if let Some(known) = continuous_frequency(&spans) {
            spans.iter_mut().for_each(|span| span.bending_stiffness *= (n0 / known).powi(2));
        }
    }
    (report.problems.len() == before).then_some(spans)
}

/// EI of a simply supported span of first frequency `n0`, Hz.
fn by_frequency(span: &types::Span, n0: f64, path: &str, report: &mut Report) -> f64 {
    let (p, omega2) = (PI / span.length, (TAU * n0).powi(2));
    let shear = span.shear_stiffness.map_or(0.0, |shear| omega2 * p * p / shear);
    let rigid = p.powi(4) / span.mass;
    if shear >= rigid {
        let most = (rigid / shear).sqrt() * n0;
        let rule = "a span that is so soft in shear cannot have this first frequency";
        let found = format!("{n0} Hz; with this shear_stiffness it stays below {most:.3} Hz");
        report.problem(format!("{path}.first_frequency"), rule, found);
    }
    omega2 / (rigid - shear)
}

/// First natural frequency of spans of beams in Hz; of several simply supported ones the lowest. `None` for other structures
/// and for numbers that make no beam.
#[must_use]
pub fn first_frequency(structure: &StructureSpec) -> Option<f64> {
    let StructureSpec::Beams { spans, continuous } = structure else { return None };
    if *continuous { continuous_frequency(spans) } else { least(spans, simple_frequency) }
}

/// First frequency of a simply supported span, Hz.
fn simple_frequency(span: &Span) -> f64 {
    let p = PI / span.length;
    let shear = span.shear_stiffness.map_or(0.0, |shear| p * p * span.bending_stiffness / shear);
    (p.powi(4) * span.bending_stiffness / span.mass / (1.0 + shear)).sqrt() / TAU
}

fn least(spans: &[Span], of: impl Fn(&Span) -> f64) -> Option<f64> {
    spans.iter().map(of).reduce(f64::min).filter(|hertz| *hertz > 0.0 && hertz.is_finite())
}

/// First frequency of a continuous beam without shear, Hz.
fn continuous_frequency(spans: &[Span]) -> Option<f64> {
    let rigid = |span: &Span| Span { shear_stiffness: None, ..span.clone() };
    let mut low = least(spans, |span| simple_frequency(&rigid(span)))?;
    let mut high = least(spans, |span| simple_frequency(&rigid(span)) * (CLAMPED / PI).powi(2))?;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if below_the_first(spans, TAU * middle) { low = middle } else { high = middle }
    }
    Some(low)
}

/// Whether A(ω) is positive definite, by its pivots.
fn below_the_first(spans: &[Span], omega: f64) -> bool {
    let mut pivot = 0.0; // over the bearing where the span begins
    for span in spans {
        let lambda = span.length * (omega * omega * span.mass / span.bending_stiffness).sqrt().sqrt();
        let scale = span.bending_stiffness / span.length;
        let [near, far] = ends(lambda).map(|factor| scale * factor);
        let begin = pivot + near;
        if begin <= 0.0 {
            return false;
        }
        pivot = near - far * far / begin;
    }
    pivot > 0.0
}

/// Stiffness of a vibrating beam against rotations of its near and its far end, times L/EI.
fn ends(lambda: f64) -> [f64; 2] {
    if lambda < SMALL {
        let fourth = lambda.powi(4);
        return [4.0 - fourth / 105.0, 2.0 + fourth / 140.0];
    }
    let ((sin, cos), sinh, cosh) = (libm::sincos(lambda), libm::sinh(lambda), libm::cosh(lambda));
    let below = 1.0 - cosh * cos;
    [lambda * (cosh * sin - sinh * cos) / below, lambda * (sinh - sin) / below]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(length: f64) -> Span {
        Span { length, bending_stiffness: 3e10, mass: 15e3, shear_stiffness: None, elements: 2 }
    }

    /// λ₁ = π of any number of equal spans; 3.926602 of a span with one end clamped.
    #[test]
    fn continuous_beams_have_the_frequencies_of_the_tables() {
        let simple = simple_frequency(&span(25.0));
        for n in 1..=5 {
            // All equal spans swing as simply supported ones do.
            let found = continuous_frequency(&vec![span(25.0); n]).unwrap();
            assert!((found / simple - 1.0).abs() < 1e-9, "{n}: {found}");
        }
        // A very short neighbour clamps: λ₁ of clamped–pinned is 3.926602.
        let clamped = continuous_frequency(&[span(25.0), span(0.01)]).unwrap();
        assert!((clamped / simple / (3.926_602 / PI).powi(2) - 1.0).abs() < 1e-3, "{clamped}");
        // Spans 1 : 1.5 : 1, λ of the middle one by the determinant of the 2 × 2 problem of the symmetric mode.
        let found = continuous_frequency(&[span(20.0), span(30.0), span(20.0)]).unwrap();
        let of = |l: f64| ends(l * (TAU * found).sqrt() * (15e3_f64 / 3e10).powf(0.25)).map(|x| x / l);
        let ([outer, carried], [inner, through]) = (of(20.0), of(30.0));
        let determinant = outer - carried * carried / outer + inner - through;
        assert!(determinant.abs() < 1e-9 * outer, "{determinant:e}");
    }

    #[test]
    fn the_series_joins_the_closed_form() {
        let ([a, b], [c, d]) = (ends(SMALL * (1.0 - 1e-12)), ends(SMALL));
        assert!((a - c).abs() < 1e-7 && (b - d).abs() < 1e-7, "{a} {c} {b} {d}");
    }
}
