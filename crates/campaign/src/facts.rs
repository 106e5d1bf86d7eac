//! What criteria have to know of a bridge and its track, as the scenario tells it.
//!
//! ```text
//! simple spans   f_n = ω_n/2π,  ω_n² = (EI/μ) k⁴/(1 + EI k²/κGA),  k = nπ/L;   n₀ the lowest first, f₃ the highest third
//! other decks    n₀ and f₃: first and third mode with max_x |φ_j(x)| ≥ 0.2 max over the modes found, φᵀMφ = 1
//! ```
//!
//! A tower, a cable, a sideways mode moves little of the deck's mass up and down: of modes of equal mass its vertical motion of
//! the deck is small.

use std::f64::consts::PI;

use ttb_assessment::Facts;
use ttb_bridge::Prepared;
use ttb_passage::{ModalBridge, Settings};
use ttb_scenario::Checked;
use ttb_scenario::spec::{BridgeSpec, Span, StructureSpec};
use ttb_scenario::types::Support;

use crate::points::bearings;

/// So many of the lowest modes are looked at, at first and at most.
const MODES: [usize; 2] = [12, 48];
/// A mode moves the deck up and down if it does so by this share of the liveliest.
const VERTICAL: f64 = 0.2;
/// Places of the deck that are looked at.
const PLACES: u32 = 120;
/// More degrees of freedom are not searched for frequencies in passing.
const MANY: usize = 20_000;

/// First and third frequency, Hz, and where they come from.
type Modes = (f64, Option<f64>, String);

/// Facts of a scenario; its bridge is prepared where its frequencies are needed. What cannot be told stays unknown.
pub fn of(checked: &Checked) -> Facts {
    let whole = || BridgeSpec { points: Vec::new(), reduction: None, modes: None, ..checked.bridge.clone() };
    let others = || {
        let bridge = Prepared::new(&whole()).ok()?;
        lowest(&bridge)
    };
    of_own(checked, || vertical(checked).or_else(others))
}

/// Facts of a plan's scenario, whose bridge an FMU may stand for.
pub fn of_plan(checked: &Checked, over_fmu: bool) -> Facts {
    if over_fmu { of_track(checked) } else { of(checked) }
}

/// Facts of a scenario whose bridge is prepared already; frequencies of a large one stay unknown.
pub fn of_prepared(checked: &Checked, bridge: &Prepared) -> Facts {
    let small = bridge.structure.ndof <= MANY;
    of_own(checked, || if small { vertical(checked).or_else(|| lowest(bridge)) } else { None })
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
        Some((first, third, from)) => (Some(first), third, Some(from)),
        None => (None, None, None),
    };
    let spans_m = Some(spans(structure)).filter(|spans| !spans.is_empty());
    let continuous = match structure {
        StructureSpec::Beams { continuous, .. } => Some(*continuous),
        _ => None,
    };
    Facts { n0_hz, third_mode_hz, modes_from, spans_m, continuous, ..of_track(checked) }
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
    Some((first, third, "bending modes of the simple spans, closed form".into()))
}

/// Of a model whose modes are not coupled by dashpots: those that move the deck up and down.
fn vertical(checked: &Checked) -> Option<Modes> {
    let mut found = None;
    for count in MODES {
        let spec = BridgeSpec { points: Vec::new(), reduction: None, modes: Some(count), ..checked.bridge.clone() };
        let bridge = ModalBridge::new(&spec, &Settings::default()).ok()?;
        let frequencies: Vec<f64> = bridge.frequencies().collect();
        let live = lively(&bridge);
        found = told(&frequencies, &live);
        if live.len() > 2 || frequencies.len() < count / 2 {
            break;
        }
    }
    found
}

/// The modes, from 0, that move the deck up and down.
fn lively(bridge: &ModalBridge) -> Vec<usize> {
    let count = bridge.modes().len();
    let mut most = vec![0.0_f64; count];
    for i in 0..=PLACES {
        let row = bridge.lines().at(bridge.length() * f64::from(i) / f64::from(PLACES));
        most.iter_mut().zip(&row).for_each(|(most, y)| *most = most.max(y.abs()));
    }
    let liveliest = most.iter().copied().fold(0.0, f64::max);
    (0..count).filter(|j| most[*j] >= VERTICAL * liveliest).collect()
}

fn told(frequencies: &[f64], live: &[usize]) -> Option<Modes> {
    let hertz = |j: &usize| frequencies[*j];
    let first = live.first().map(hertz)?;
    let numbers: Vec<String> = live.iter().take(3).map(|j| (j + 1).to_string()).collect();
    let last = live.get(2).or(live.last()).copied().unwrap_or(0);
    let passed: Vec<String> =
        (0..last).filter(|j| !live.contains(j)).map(|j| format!("{:.3} Hz", frequencies[j])).collect();
    let mut from = format!(
        "modes with vertical motion of the deck, numbers {} of those that loads on it excite",
        numbers.join(", ")
    );
    if !passed.is_empty() {
        from += &format!("; passed over: {}", passed.join(", "));
    }
    if live.len() < 3 {
        from += &format!("; no third one among the {} lowest", frequencies.len());
    }
    Some((first, live.get(2).map(hertz), from))
}

/// Of any other model.
fn lowest(bridge: &Prepared) -> Option<Modes> {
    let found = bridge.structure.natural_frequencies(3).ok()?;
    let from = "the three lowest natural modes of the model, whatever their shape";
    Some((*found.first()?, found.get(2).copied(), from.into()))
}

/// Frequency of bending mode `n` of a simple span, Hz.
fn frequency(span: &Span, n: u32) -> f64 {
    let k = f64::from(n) * PI / span.length;
    let shear = span.shear_stiffness.map_or(0.0, |shear| span.bending_stiffness * k * k / shear);
    (span.bending_stiffness / span.mass * k.powi(4) / (1.0 + shear)).sqrt() / (2.0 * PI)
}
