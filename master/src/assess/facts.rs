//! What a scenario tells of its bridge and track to those who judge.
//!
//! ```text
//! simple spans   f_n = ω_n/2π,  ω_n² = (EI/μ) k⁴/(1 + EI k²/κGA),  k = nπ/L;   n₀ the lowest first, f₃ the highest third
//! other decks    natural frequencies of the model, in order
//! ```

use std::f64::consts::PI;

use ttb_assessment::Facts;
use ttb_bridge::Prepared;
use ttb_scenario::Checked;
use ttb_scenario::deck::Deck;
use ttb_scenario::spec::{Span, StructureSpec};
use ttb_scenario::types::Support;

/// More degrees of freedom are not searched for frequencies in passing.
const MANY: usize = 20_000;

/// The facts of a scenario with this bridge; `None`: the bridge is an FMU of the user.
pub fn of(checked: &Checked, bridge: Option<&Prepared>) -> Facts {
    let (n0_hz, third_mode_hz, modes_from) = bridge
        .and_then(|bridge| modes(checked, bridge))
        .map_or_else(|| (None, None, None), |(first, third, from)| (Some(first), third, Some(from)));
    let spans_m = bridge.map(|_| spans(&checked.bridge.structure)).filter(|spans| !spans.is_empty());
    Facts { n0_hz, third_mode_hz, modes_from, track: Some(track(checked).into()), spans_m, ..Facts::default() }
}

/// A track with sleepers on ballast, or one without.
fn track(checked: &Checked) -> &'static str {
    match checked.train_track.track.support {
        Support::SingleLayer { .. } => "ballastless",
        _ => "ballast",
    }
}

fn spans(structure: &StructureSpec) -> Vec<f64> {
    if let StructureSpec::Beams { spans, .. } = structure {
        return spans.iter().map(|span| span.length).collect();
    }
    let Some(deck) = Deck::new(structure) else { return Vec::new() };
    let ends: Vec<f64> = deck.inner_bearings.iter().copied().chain([deck.length]).collect();
    let begins = std::iter::once(0.0).chain(deck.inner_bearings.iter().copied());
    ends.iter().zip(begins).map(|(end, begin)| end - begin).collect()
}

/// First and third frequency of the member, and what they are.
fn modes(checked: &Checked, bridge: &Prepared) -> Option<(f64, Option<f64>, String)> {
    if let StructureSpec::Beams { spans, continuous } = &checked.bridge.structure
        && (!continuous || spans.len() == 1)
    {
        let first = spans.iter().map(|span| frequency(span, 1)).reduce(f64::min)?;
        let third = spans.iter().map(|span| frequency(span, 3)).reduce(f64::max);
        return Some((first, third, "bending modes of the simple spans, closed form".into()));
    }
    if bridge.structure.ndof > MANY {
        return None;
    }
    let found = bridge.structure.natural_frequencies(3).ok()?;
    let from = "the three lowest natural modes of the model, whatever their shape".to_string();
    Some((*found.first()?, found.get(2).copied(), from))
}

/// Frequency of bending mode `n` of a simple span, Hz.
fn frequency(span: &Span, n: u32) -> f64 {
    let k = f64::from(n) * PI / span.length;
    let shear = span.shear_stiffness.map_or(0.0, |shear| span.bending_stiffness * k * k / shear);
    (span.bending_stiffness / span.mass * k.powi(4) / (1.0 + shear)).sqrt() / (2.0 * PI)
}
