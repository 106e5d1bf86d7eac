//! What criteria have to know of a bridge and its track, as the scenario tells it.
//!
//! ```text
//! simple spans   f_n = ω_n/2π,  ω_n² = (EI/μ) k⁴/(1 + EI k²/κGA),  k = nπ/L;   n₀ the lowest first, f₃ the highest third
//! other decks    the three lowest natural frequencies of the model
//! ```

use std::f64::consts::PI;

use ttb_assessment::Facts;
use ttb_bridge::Prepared;
use ttb_scenario::Checked;
use ttb_scenario::spec::{BridgeSpec, Span, StructureSpec};
use ttb_scenario::types::Support;

use crate::points::bearings;

/// More degrees of freedom are not searched for frequencies in passing.
const MANY: usize = 20_000;

/// First and third frequency, Hz, and where they come from.
type Modes = (f64, Option<f64>, &'static str);

/// Facts of a scenario; its bridge is prepared where its frequencies are needed. What cannot be told stays unknown.
pub fn of(checked: &Checked) -> Facts {
    let whole = || BridgeSpec { points: Vec::new(), reduction: None, modes: None, ..checked.bridge.clone() };
    of_own(checked, || {
        let bridge = Prepared::new(&whole()).ok()?;
        lowest(&bridge)
    })
}

/// Facts of a scenario whose bridge is prepared already; frequencies of a large one stay unknown.
pub fn of_prepared(checked: &Checked, bridge: &Prepared) -> Facts {
    of_own(checked, || if bridge.structure.ndof > MANY { None } else { lowest(bridge) })
}

/// Facts of a scenario whose bridge is an FMU of the user: those of the track.
pub fn of_track(checked: &Checked) -> Facts {
    let track = match checked.train_track.track.support {
        Support::SingleLayer { .. } => "ballastless",
        Support::TwoLayer { .. } | Support::ThreeLayer { .. } => "ballast",
    };
    Facts { track: Some(track.into()), ..Facts::default() }
}

/// Facts of a scenario's own bridge; `others` knows the modes of what is no row of simple spans.
fn of_own(checked: &Checked, others: impl FnOnce() -> Option<Modes>) -> Facts {
    let structure = &checked.bridge.structure;
    let (n0_hz, third_mode_hz, modes_from) = match simple(structure).or_else(others) {
        Some((first, third, from)) => (Some(first), third, Some(from.into())),
        None => (None, None, None),
    };
    let spans_m = Some(spans(structure)).filter(|spans| !spans.is_empty());
    Facts { n0_hz, third_mode_hz, modes_from, spans_m, ..of_track(checked) }
}

fn spans(structure: &StructureSpec) -> Vec<f64> {
    match structure {
        StructureSpec::Beams { spans, .. } => spans.iter().map(|span| span.length).collect(),
        _ => bearings(structure).windows(2).map(|span| span[1] - span[0]).collect(),
    }
}

/// Of simple spans, each a member of its own.
fn simple(structure: &StructureSpec) -> Option<Modes> {
    let StructureSpec::Beams { spans, continuous } = structure else { return None };
    if *continuous && spans.len() > 1 {
        return None;
    }
    let first = spans.iter().map(|span| frequency(span, 1)).reduce(f64::min)?;
    let third = spans.iter().map(|span| frequency(span, 3)).reduce(f64::max);
    Some((first, third, "bending modes of the simple spans, closed form"))
}

/// Of any other model.
fn lowest(bridge: &Prepared) -> Option<Modes> {
    let found = bridge.structure.natural_frequencies(3).ok()?;
    Some((*found.first()?, found.get(2).copied(), "the three lowest natural modes of the model, whatever their shape"))
}

/// Frequency of bending mode `n` of a simple span, Hz.
fn frequency(span: &Span, n: u32) -> f64 {
    let k = f64::from(n) * PI / span.length;
    let shear = span.shear_stiffness.map_or(0.0, |shear| span.bending_stiffness * k * k / shear);
    (span.bending_stiffness / span.mass * k.powi(4) / (1.0 + shear)).sqrt() / (2.0 * PI)
}
