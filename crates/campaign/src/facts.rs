//! What criteria have to know of a bridge and its track, as the scenario tells it.
//!
//! ```text
//! simple spans   f_n = ω_n/2π,  ω_n² = (EI/μ) k⁴/(1 + EI k²/κGA),  k = nπ/L;   n₀ the lowest first, f₃ the highest third
//! other decks    the three lowest natural frequencies of the model
//! ```

use std::f64::consts::PI;

use ttb_assessment::Facts;
use ttb_scenario::Checked;
use ttb_scenario::spec::{BridgeSpec, Span, StructureSpec};
use ttb_scenario::types::Support;

use crate::points::bearings;

/// Facts of a scenario. What cannot be told stays unknown.
pub fn of(checked: &Checked) -> Facts {
    let (n0_hz, third_mode_hz, modes_from) = match modes(&checked.bridge) {
        Some((first, third, from)) => (Some(first), third, Some(from.into())),
        None => (None, None, None),
    };
    let spans: Vec<f64> = bearings(&checked.bridge.structure).windows(2).map(|span| span[1] - span[0]).collect();
    let track = match checked.train_track.track.support {
        Support::SingleLayer { .. } => "ballastless",
        Support::TwoLayer { .. } | Support::ThreeLayer { .. } => "ballast",
    };
    let spans_m = (!spans.is_empty()).then_some(spans);
    Facts { n0_hz, third_mode_hz, modes_from, track: Some(track.into()), spans_m, ..Facts::default() }
}

/// First and third frequency, Hz, and where they come from.
fn modes(bridge: &BridgeSpec) -> Option<(f64, Option<f64>, &'static str)> {
    if let StructureSpec::Beams { spans, continuous } = &bridge.structure
        && (!continuous || spans.len() == 1)
    {
        let first = spans.iter().map(|span| frequency(span, 1)).reduce(f64::min)?;
        let third = spans.iter().map(|span| frequency(span, 3)).reduce(f64::max);
        return Some((first, third, "bending modes of the simple spans, closed form"));
    }
    let whole = BridgeSpec { points: Vec::new(), reduction: None, modes: None, ..bridge.clone() };
    let found = ttb_bridge::Prepared::new(&whole).ok()?.structure.natural_frequencies(3).ok()?;
    Some((*found.first()?, found.get(2).copied(), "the three lowest natural modes of the model, whatever their shape"))
}

/// Frequency of bending mode `n` of a simple span, Hz.
fn frequency(span: &Span, n: u32) -> f64 {
    let k = f64::from(n) * PI / span.length;
    let shear = span.shear_stiffness.map_or(0.0, |shear| span.bending_stiffness * k * k / shear);
    (span.bending_stiffness / span.mass * k.powi(4) / (1.0 + shear)).sqrt() / (2.0 * PI)
}
