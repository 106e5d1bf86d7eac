//! Rules between train, track, bridge and time: the train stands and ends on the rail, the bridge lies within the track.

use std::collections::HashSet;

use super::advice;
use super::places::{Passage, Rail};
use crate::deck::Deck;
use crate::limits::{MOST_BAYS, pre_roll_steps};
use crate::pieces::Pieces;
use crate::problem::Report;
use crate::resolve::Resolved;
use crate::step::LONGEST;
use crate::travel::{distance, speed_at, wheel_offsets};
use crate::types::{Bridge, Irregularity, RailPoint, Track};

/// Relative slack for sums of lengths: a bridge may end exactly where the track ends.
const ROUNDING: f64 = 1e-9;
/// So many of the shortest waves fit into the table from which a random irregularity is read.
const MOST_WAVES: f64 = 250_000.0;
/// A random irregularity has at least this length, m.
const LEAST_PASSAGE: f64 = 2048.0;

pub(super) fn check(pieces: &Pieces, resolved: &Resolved, report: &mut Report) {
    let rail = rail(pieces, resolved);
    let passage = passage(pieces, resolved);
    if let (Some(rail), Some(track), Some(bridge), Some(structure)) =
        (&rail, &pieces.track, &pieces.bridge, &resolved.structure)
        && let Some(deck) = Deck::new(structure).filter(|deck| deck.length > 0.0)
    {
        bridge_on_track(rail, track, bridge, &deck, report);
    }
    if let (Some(rail), Some(passage)) = (&rail, &passage) {
        train_on_rail(rail, passage, report);
    }
    points_on_rail(rail.as_ref(), &pieces.rail_points, report);
    if let (Some(train), Some(speed), Some(time)) = (&pieces.train, &resolved.speed, &pieces.time) {
        // A step that is chosen is known, and looked at, only when all names stand for something.
        let step = time.step.given().unwrap_or(LONGEST) / time.substeps.unwrap_or(1).max(1) as f64;
        pre_roll(train.pre_roll, speed_at(speed, 0.0), step, resolved, report);
    }
    if let Some(passage) = &passage
        && let Some(Irregularity::Spectrum { wavelengths: [short, _], .. }) = pieces.irregularity
        && short > 0.0
    {
        resolvable(passage, short, report);
    }
    advice::give(pieces, resolved, rail.as_ref(), passage.as_ref(), report);
}

/// The rail, if its numbers make sense.
fn rail(pieces: &Pieces, resolved: &Resolved) -> Option<Rail> {
    let (laid, track) = (pieces.track.as_ref()?, resolved.track.as_ref()?);
    let to = laid.from + laid.bays as f64 * track.spacing;
    let element = track.spacing / laid.elements_per_bay.max(1) as f64;
    // More bays have been reported, and would take their time here.
    (track.spacing > 0.0 && laid.bays <= MOST_BAYS).then_some(Rail {
        from: laid.from,
        to,
        spacing: track.spacing,
        element,
    })
}

/// The train's run, if its numbers make sense.
fn passage(pieces: &Pieces, resolved: &Resolved) -> Option<Passage> {
    let (train, time) = (pieces.train.as_ref()?, pieces.time.as_ref()?);
    let (cars, speed) = (resolved.cars.as_ref()?, resolved.speed.as_ref()?);
    let sane = cars.iter().all(|car| car.length > 0.0 && car.bogie_distance > 0.0 && car.wheelbase > 0.0);
    let moving = speed.iter().all(|[_, v]| *v >= 0.0) && speed.windows(2).all(|pair| pair[0][0] < pair[1][0]);
    if !sane || !moving || time.end <= 0.0 {
        return None;
    }
    let rear = train.front_wheel - wheel_offsets(cars).last()?;
    let end = train.front_wheel + distance(speed, time.end);
    Some(Passage { rear, front: train.front_wheel, end, pre_roll: train.pre_roll })
}

/// The cars roll over the pre-roll and their own length.
fn pre_roll(distance: f64, speed: f64, step: f64, resolved: &Resolved, report: &mut Report) {
    let length: f64 = resolved.cars.iter().flatten().map(|car| car.length).sum();
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

fn train_on_rail(rail: &Rail, passage: &Passage, report: &mut Report) {
    let (train, track) = (passage.front - passage.rear, rail.to - rail.from);
    if train > track {
        let rule = "the train must not be longer than the track";
        report.problem("$.track.bays", rule, format!("{train:.3} m from first to last wheel > {track:.3} m of rail"));
        return;
    }
    if passage.rear < rail.from {
        let rule = "the whole train must stand on the rail at the start";
        let found = format!("last wheel at {:.3} m, rail begins at {:.3} m", passage.rear, rail.from);
        report.problem("$.train.front_wheel", rule, found);
    }
    if passage.front > rail.to {
        let rule = "the whole train must stand on the rail at the start";
        let found = format!("leading wheel at {:.3} m, rail ends at {:.3} m", passage.front, rail.to);
        report.problem("$.train.front_wheel", rule, found);
    } else if passage.end > rail.to {
        let rule = "the whole train must be on the rail until the end of the run";
        let found = format!("leading wheel at {:.3} m at the end, rail ends at {:.3} m", passage.end, rail.to);
        report.problem("$.time.end", rule, found);
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

fn bridge_on_track(rail: &Rail, track: &Track, bridge: &Bridge, deck: &Deck, report: &mut Report) {
    let slack = ROUNDING * rail.spacing;
    let end = bridge.at + deck.length;
    if bridge.at < rail.from - slack || end > rail.to + slack {
        let rule = "the bridge must lie within the track";
        let found = format!("bridge {} to {} m, track {} to {} m", bridge.at, end, rail.from, rail.to);
        report.problem("$.bridge.at", rule, found);
    } else if deck.supports(bridge.at, rail.from, rail.spacing, track.bays + 1, bridge.over_bearings).is_empty() {
        let rule = "at least one support of the track must rest on the bridge";
        let found = format!("none between {} and {} m every {} m", bridge.at, end, rail.spacing);
        report.problem("$.bridge", rule, found);
    }
}
