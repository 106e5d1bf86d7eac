//! Places a passage: what a scenario leaves out of start, track and end follows from train, speed and bridge.
//!
//! ```text
//!        rear ──── train ──── front            bridge
//! ═══════╪═════════════════════╪═══════════╤═════════════╤════════════════════════════╪═══
//! from   │◄─ pre-roll          │◄─ approach ►             │◄── train, free vibration ──►│  from + bays · spacing
//!
//! approach        ⌈max(20 m, v · 0.5 s)⌉        front = at − approach
//! free vibration  ln 2/(2πζ f₁), from 2 to 20 periods, at most 10 s
//! end             the last wheel leaves the bridge, free vibration; up to the next 10 ms
//! pre-roll        v · 5 s, up to the next 10 m; 0 on a smooth rail; not before the first sample of a measured one
//! rail            15 m beyond the wheels at the start and at the end; a support stands over the abutment
//! ```
//!
//! f₁ is that of spans of beams, the lower of two given for Rayleigh damping, or EN 1991-2's lower limit for the deck's longest
//! span, which takes the longer time.

use serde_json::{Value, json};

use crate::deck::Deck;
use crate::limits::{LONGEST_PRE_ROLL, MOST_BAYS};
use crate::pieces::Pieces;
use crate::placement::Placement;
use crate::problem::Report;
use crate::resolve::Resolved;
use crate::spans::first_frequency;
use crate::spec::Profile;
use crate::travel::{distance, speed_at, time_of, vehicle_offsets};
use crate::types::{Damping, Irregularity, Point, RayleighAt, Structure};

/// Shortest approach, m, and its duration, s.
const APPROACH: (f64, f64) = (20.0, 0.5);
/// The pre-roll's duration, s: body motions that begin with it have then died out.
const PRE_ROLL: f64 = 5.0;
/// Rail beyond the outermost wheels, m: its free end is not felt there.
pub(crate) const BEYOND: f64 = 15.0;
/// Periods and seconds of a free vibration.
const PERIODS: [f64; 2] = [2.0, 20.0];
const LONGEST: f64 = 10.0;

/// Chooses what is left out; what cannot be chosen is reported.
pub(crate) fn place(pieces: &Pieces, resolved: &Resolved, report: &mut Report) -> Placement {
    let mut placed = Placement::default();
    for (present, key, value) in
        [(pieces.has_track_type, "track.type", json!("slab")), (pieces.has_step, "time.step", json!(1e-3))]
    {
        if !present {
            placed.chose(key, value, if key == "time.step" { "s" } else { "" }, "default");
        }
    }
    let deck = resolved.structure.as_ref().and_then(Deck::new).filter(|deck| deck.length > 0.0);
    points(pieces, &mut placed);
    space(pieces, resolved, &mut placed);
    placed.free_vibration = free_vibration(pieces, resolved, deck.as_ref(), &mut placed);
    let (Some(train), Some(laid), Some(time)) = (&pieces.train, &pieces.track, &pieces.time) else { return placed };
    let moving = |speed: &&Vec<[f64; 2]>| {
        speed.iter().all(|[_, v]| *v >= 0.0) && speed.windows(2).all(|pair| pair[0][0] < pair[1][0])
    };
    let Some(speed) = resolved.speed.as_ref().filter(moving) else { return placed };
    let length = resolved.cars.as_ref().and_then(|cars| vehicle_offsets(cars).last().copied());
    let v = speed_at(speed, 0.0);
    let bridge = pieces.at.zip(deck.as_ref().map(|deck| deck.length));

    placed.front_wheel = train.front_wheel.or_else(|| {
        let (at, approach) = (pieces.at?, APPROACH.0.max(APPROACH.1 * v).ceil());
        placed.chose("train.front_wheel", at - approach, "m", format!("{approach} m before the bridge"));
        Some(at - approach)
    });
    placed.end = time.end.or_else(|| {
        let (front, (at, deck), free) = (placed.front_wheel?, bridge?, placed.free_vibration?);
        let Some(off) = time_of(speed, at + deck + length? - front) else {
            let rule = "must be given: the train comes to a stop before its last wheel has left the bridge";
            report.problem("$.time.end", rule, format!("it runs {:.3} m", distance(speed, 1e9)));
            return None;
        };
        let end = 0.01 * (100.0 * (off + free)).ceil().max(1.0);
        let end = end.to_string().parse().map_or(end, |end: f64| (end * 1e3).round() / 1e3);
        placed.chose(
            "time.end",
            end,
            "s",
            format!("the last wheel leaves the bridge at {off:.3} s, {free} s free vibration"),
        );
        Some(end)
    });
    placed.pre_roll = train.pre_roll.or_else(|| {
        let rough = !matches!(pieces.irregularity.as_ref()?, Irregularity::None);
        let front = placed.front_wheel?;
        let asked = if rough { (0.1 * PRE_ROLL * v).ceil() * 10.0 } else { 0.0 };
        let covered = match &resolved.profile {
            Some(Profile::Samples { x, .. }) => (front - length? - x.first()?).max(0.0).floor(),
            _ => LONGEST_PRE_ROLL,
        };
        let chosen = asked.min(LONGEST_PRE_ROLL).min(covered);
        if chosen > 0.0 {
            placed.chose("train.pre_roll", chosen, "m", format!("{:.1} s on the irregular rail", chosen / v));
        }
        Some(chosen)
    });
    let Some(spacing) = resolved.track.as_ref().map(|track| track.spacing).filter(|spacing| *spacing > 0.0) else {
        return placed;
    };
    placed.from = laid.from.or_else(|| {
        if laid.bays.is_some() && train.front_wheel.is_some() {
            return Some(0.0);
        }
        let (at, rear) = (pieces.at?, placed.front_wheel? - length?);
        let before = (at.min(rear) - BEYOND - at).min(-spacing);
        let from = at - (-before / spacing).ceil() * spacing;
        placed.chose("track.from", from, "m", format!("{BEYOND} m behind the last wheel, a support over the abutment"));
        Some(from)
    });
    placed.bays = laid.bays.or_else(|| {
        let (from, front, (at, deck)) = (placed.from?, placed.front_wheel?, bridge?);
        let far = (front + distance(speed, placed.end?)).max(front).max(at + deck);
        let bays = ((far + BEYOND - from) / spacing).ceil().max(2.0);
        if bays.is_nan() || bays > MOST_BAYS as f64 {
            let rule = format!("the run must need a track of at most {MOST_BAYS} bays");
            report.problem(
                "$.track",
                rule,
                format!("{bays:.3e} bays of {spacing} m from {from} m to {:.3e} m", far + BEYOND),
            );
            return None;
        }
        placed.chose("track.bays", bays as usize, "", format!("{BEYOND} m ahead of the leading wheel at the end"));
        Some(bays as usize)
    });
    placed
}

/// What a run in space leaves out, key by key.
fn space(pieces: &Pieces, resolved: &Resolved, placed: &mut Placement) {
    let (Some(given), Some(spatial)) = (&pieces.space, &resolved.spatial) else { return };
    let (filled, default) = (&spatial.filled, crate::types::ContactInSpace::default());
    if given.contact == default {
        placed.chose("space.contact", json!(filled.contact), "", "default");
    }
    if given.track != filled.track {
        placed.chose("space.track", json!(filled.track), "", "defaults for the track's type");
    }
    if given.irregularity.is_none() {
        let why = match &filled.irregularity {
            Some(crate::types::IrregularityInSpace::Spectrum { .. }) => "the components that belong to the level",
            _ => "the level alone",
        };
        placed.chose("space.irregularity", json!(filled.irregularity), "", why);
    }
    placed.space = Some(filled.clone());
}

/// Without points the middle of every span is one.
fn points(pieces: &Pieces, placed: &mut Placement) {
    let Some(Structure::Beams { spans, .. }) = &pieces.structure else { return };
    if pieces.has_points {
        return;
    }
    let mut begin = 0.0;
    let middle = |(i, span): (usize, &crate::types::Span)| {
        let name = if spans.len() == 1 { "mid".to_string() } else { format!("mid{}", i + 1) };
        let x = begin + 0.5 * span.length;
        begin += span.length;
        Point { name, x: Some(x), node: None, direction: Default::default() }
    };
    let points: Vec<Point> = spans.iter().enumerate().map(middle).collect();
    let told: Vec<Value> = points.iter().map(|point| json!({ "name": point.name, "x": point.x })).collect();
    placed.chose("bridge.points", told, "", "the middle of every span");
    placed.points = Some(points);
}

/// How long the bridge is watched after the last wheel has left it, s.
fn free_vibration(pieces: &Pieces, resolved: &Resolved, deck: Option<&Deck>, placed: &mut Placement) -> Option<f64> {
    if let Some(given) = pieces.time.as_ref()?.free_vibration {
        return Some(given);
    }
    let (ratio, given) = match pieces.damping.as_ref()? {
        Damping::None => (0.0, None),
        Damping::Rayleigh { ratio, at: RayleighAt::Hz([a, b]) } => (*ratio, Some(a.min(*b))),
        Damping::Rayleigh { ratio, .. } | Damping::Modal { ratio, .. } => (*ratio, None),
    };
    let by_length = || {
        let mut ends = vec![0.0];
        ends.extend(&deck?.inner_bearings);
        ends.push(deck?.length);
        let span = ends.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        Some(if span > 20.0 { 23.58 * span.powf(-0.592) } else { 80.0 / span.max(4.0) })
    };
    let f1 = resolved.structure.as_ref().and_then(first_frequency).or(given).or_else(by_length)?;
    let periods = (std::f64::consts::LN_2 / (std::f64::consts::TAU * ratio)).clamp(PERIODS[0], PERIODS[1]);
    let time = (100.0 * periods / f1).ceil().min(100.0 * LONGEST) / 100.0;
    if !time.is_finite() {
        return None;
    }
    placed.chose("time.free_vibration", time, "s", format!("{periods:.1} periods of {f1:.3} Hz, ζ = {ratio}"));
    Some(time)
}
