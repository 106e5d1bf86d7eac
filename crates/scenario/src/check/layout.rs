//! Rules between train, track, bridge and time: the train stands and ends on the rail, the bridge lies within the track.
//! Each problem names a value that would do, with the other keys as they are.

use std::collections::HashSet;

use super::advice;
use super::places::{Passage, Rail};
use crate::deck::Deck;
use crate::limits::{MOST_BAYS, pre_roll_steps};
use crate::pieces::Pieces;
use crate::place::BEYOND;
use crate::placement::Placement;
use crate::problem::Report;
use crate::resolve::Resolved;
use crate::spec::Vehicle;
use crate::step::LONGEST;
use crate::travel::{distance, speed_at, time_of, vehicle_offsets};
use crate::types::{Bridge, Irregularity, RailPoint};

/// Relative slack for sums of lengths: a bridge may end exactly where the track ends.
const ROUNDING: f64 = 1e-9;
/// So many of the shortest waves fit into the table from which a random irregularity is read.
const MOST_WAVES: f64 = 250_000.0;
/// A random irregularity has at least this length, m.
const LEAST_PASSAGE: f64 = 2048.0;

pub(super) fn check(pieces: &Pieces, resolved: &Resolved, placed: &Placement, report: &mut Report) {
    let rail = rail(pieces, resolved, placed);
    let passage = passage(pieces, resolved, placed);
    let deck = resolved.structure.as_ref().and_then(Deck::new).filter(|deck| deck.length > 0.0);
    if let (Some(rail), Some(bridge), Some(deck)) = (&rail, &pieces.bridge, &deck) {
        bridge_on_track(rail, bridge, deck, report);
    }
    if let (Some(rail), Some(passage)) = (&rail, &passage) {
        let latest = resolved.speed.as_ref().and_then(|speed| time_of(speed, rail.to - BEYOND - passage.front));
        train_on_rail(rail, passage, latest, report);
    }
    points_on_rail(rail.as_ref(), &pieces.rail_points, report);
    if let (Some(pre_rolled), Some(speed), Some(time)) = (placed.pre_roll, &resolved.speed, &pieces.time) {
        // A step that is chosen is known, and looked at, only when all names stand for something.
        let step = time.step.given().unwrap_or(LONGEST) / time.substeps.unwrap_or(1).max(1) as f64;
        pre_roll(pre_rolled, speed_at(speed, 0.0), step, resolved, report);
    }
    if let Some(passage) = &passage
        && let Some(Irregularity::Spectrum { wavelengths: [short, _], .. }) = pieces.irregularity
        && short > 0.0
    {
        resolvable(passage, short, report);
    }
    let bridge = pieces.at.zip(deck).map(|(at, deck)| [at, at + deck.length]);
    advice::give(pieces, resolved, &advice::Places { rail: rail.as_ref(), passage: passage.as_ref(), bridge }, report);
}

/// The rail, if its numbers make sense.
fn rail(pieces: &Pieces, resolved: &Resolved, placed: &Placement) -> Option<Rail> {
    let (laid, track) = (pieces.track.as_ref()?, resolved.track.as_ref()?);
    let (from, bays) = (placed.from?, placed.bays?);
    let to = from + bays as f64 * track.spacing;
    let element = track.spacing / laid.elements_per_bay.max(1) as f64;
    // More bays have been reported, and would take their time here.
    (track.spacing > 0.0 && bays <= MOST_BAYS).then_some(Rail { from, to, bays, spacing: track.spacing, element })
}

/// The train's run, if its numbers make sense.
fn passage(pieces: &Pieces, resolved: &Resolved, placed: &Placement) -> Option<Passage> {
    let train = pieces.train.as_ref()?;
    let (front, end) = (placed.front_wheel?, placed.end?);
    let (cars, speed) = (resolved.cars.as_ref()?, resolved.speed.as_ref()?);
    let sane = cars.iter().all(|vehicle| match vehicle {
        Vehicle::Car(car) => car.length > 0.0 && car.bogie_distance > 0.0 && car.wheelbase > 0.0,
        Vehicle::Bodies(vehicle) => vehicle.length() >= 0.0,
    });
    let moving = speed.iter().all(|[_, v]| *v >= 0.0) && speed.windows(2).all(|pair| pair[0][0] < pair[1][0]);
    if !sane || !moving || end <= 0.0 {
        return None;
    }
    Some(Passage {
        rear: front - vehicle_offsets(cars).last()?,
        front,
        end: front + distance(speed, end),
        pre_roll: placed.pre_roll.unwrap_or(0.0),
        length: cars.iter().map(Vehicle::length).sum(),
        start_given: train.front_wheel.is_some(),
        end_given: pieces.time.as_ref()?.end.is_some(),
    })
}

/// The cars roll over the pre-roll and their own length.
fn pre_roll(distance: f64, speed: f64, step: f64, resolved: &Resolved, report: &mut Report) {
    let length: f64 = resolved.cars.iter().flatten().map(Vehicle::length).sum();
    if distance > 0.0
        && speed >= 0.0
        && step > 0.0
        && let Err(exceeded) = pre_roll_steps(distance + length, speed, step)
    {
        report.problem("$.train.pre_roll", exceeded.rule, exceeded.found);
    }
}

fn resolvable(passage: &Passage, shortest: f64, report: &mut Report) {
    let limit = (passage.end - passage.rear + passage.pre_roll).max(LEAST_PASSAGE) / MOST_WAVES;
    if shortest < limit {
        let rule = format!("the shortest wavelength must be at least {limit:.3} m on a passage of this length");
        report.problem("$.irregularity.wavelengths", rule, format!("{shortest} m"));
    }
}

/// `latest` is when the leading wheel comes close to the rail's end, s.
fn train_on_rail(rail: &Rail, passage: &Passage, latest: Option<f64>, report: &mut Report) {
    let Passage { rear, front, end, .. } = *passage;
    let start = if passage.start_given { "$.train.front_wheel" } else { "$.track.from" };
    let at_start = "the whole train must stand on the rail at the start";
    let (train, track) = (front - rear, rail.to - rail.from);
    let begin = rail.from.min(rear - BEYOND);
    let bays = ((front.max(end) + BEYOND - begin) / rail.spacing).ceil();
    if rear < rail.from {
        let (later, earlier) = (rail.from + BEYOND + train, rear - BEYOND);
        let found = format!(
            "last wheel at {rear:.3} m, rail begins at {:.3} m; front_wheel {later:.3} or track.from {earlier:.3} would do",
            rail.from
        );
        report.problem(start, at_start, found);
    }
    if train > track {
        let rule = "the train must not be longer than the track";
        let found = format!("{train:.3} m from first to last wheel > {track:.3} m of rail; {bays} bays would do");
        report.problem("$.track.bays", rule, found);
    } else if front > rail.to {
        let found = format!("leading wheel at {front:.3} m, rail ends at {:.3} m; track.bays {bays} would do", rail.to);
        report.problem(start, at_start, found);
    } else if end > rail.to {
        let rule = "the whole train must be on the rail until the end of the run";
        let earlier = latest.filter(|t| *t > 0.0).map_or(String::new(), |t| format!(" or time.end {t:.3}"));
        let found = format!(
            "leading wheel at {end:.3} m at the end, rail ends at {:.3} m; track.bays {bays}{earlier} would do",
            rail.to
        );
        report.problem(if passage.end_given { "$.time.end" } else { "$.track.bays" }, rule, found);
    }
}

fn points_on_rail(rail: Option<&Rail>, points: &[Option<RailPoint>], report: &mut Report) {
    let mut names = HashSet::new();
    for (i, point) in points.iter().enumerate() {
        let Some(point) = point else { continue };
        let path = format!("$.track.points[{i}]");
        if !names.insert(&point.name) {
            report.problem(format!("{path}.name"), "names of points must differ", format!("`{}`", point.name));
        }
        if let Some(rail) = rail.filter(|rail| !(rail.from..=rail.to).contains(&point.x)) {
            let found = format!("{} m, the rail lies from {} to {} m", point.x, rail.from, rail.to);
            report.problem(format!("{path}.x"), "a point must lie on the rail", found);
        }
    }
}

fn bridge_on_track(rail: &Rail, bridge: &Bridge, deck: &Deck, report: &mut Report) {
    let slack = ROUNDING * rail.spacing;
    let end = bridge.at + deck.length;
    if bridge.at < rail.from - slack || end > rail.to + slack {
        let rule = "the bridge must lie within the track";
        let track = rail.to - rail.from;
        let would_do = if deck.length <= track {
            format!("bridge.at from {} to {:.3}", rail.from, rail.to - deck.length)
        } else {
            format!("track.bays {}", ((deck.length + BEYOND) / rail.spacing).ceil())
        };
        let found =
            format!("bridge {} to {end} m, track {} to {} m; {would_do} would do", bridge.at, rail.from, rail.to);
        report.problem("$.bridge.at", rule, found);
    } else if deck.supports(bridge.at, rail.from, rail.spacing, rail.bays + 1, bridge.over_bearings).is_empty() {
        let rule = "at least one support of the track must rest on the bridge";
        let shift = bridge.at + 0.5 * deck.length;
        let from = shift - ((shift - rail.from) / rail.spacing).ceil() * rail.spacing;
        let found =
            format!("none between {} and {end} m every {} m; track.from {from:.3} would do", bridge.at, rail.spacing);
        report.problem("$.bridge", rule, found);
    }
}
