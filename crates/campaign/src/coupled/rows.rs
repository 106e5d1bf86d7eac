//! Histories of a run reduced to rows and envelopes.
//!
//! Points of the deck that were added for the sweep are no places of their own in the rows: of each quantity, filter and statistic
//! the greatest along the deck stays, with where it is. Of wheelsets and cars, too, the worst stays, with its number.

use std::borrow::Cow;
use std::collections::BTreeMap;

use ttb_assessment::peak::quantity::{DECK_ACCELERATION, DECK_DISPLACEMENT, DECK_MOMENT};
use ttb_assessment::reduce::{AxleHistory, CarHistory, LATERAL, PointHistory, SHIFT, SIDES, Sides};
use ttb_assessment::{Criteria, Facts, Filter, Histories, Peak, PlaceKind, Statistic, reduce};
use ttb_scenario::Checked;
use ttb_scenario::types::{Car, Direction};
use ttb_session::column::Kind;
use ttb_session::{Column, Of, Quantity, Table};

use crate::history::History;
use crate::record::Envelope;

/// What the names of added points begin with; a scenario's names cannot.
pub const ADDED: &str = "@";

/// Which columns rows are made of.
pub fn wanted(column: &Column) -> bool {
    use Quantity::{Acceleration, ContactForce, Displacement, Moment, PitchAcceleration, Position};
    let is = |kind, any: &[Quantity]| column.of.kind() == kind && any.contains(&column.quantity);
    is(Kind::Point, &[Displacement, Acceleration, Moment])
        || is(Kind::Wheel, &[ContactForce, Position])
        || is(Kind::Car, &[Acceleration, PitchAcceleration])
}

/// The columns of a table that are kept as a run's history: all of the scenario, and of the added points the two where the deck
/// moves most and is accelerated most, named by their place: `deck[10.5].acceleration`.
pub fn kept(table: Table, checked: &Checked) -> History {
    let mut chosen: Vec<Of> = Vec::new();
    for quantity in [Quantity::Acceleration, Quantity::Displacement] {
        let most = |i: &usize| table.values[*i].iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let of = (0..table.columns.len()).filter(|i| table.columns[*i].is(Kind::Point, &quantity));
        let best = of.max_by(|a, b| most(a).total_cmp(&most(b)));
        chosen.extend(best.map(|best| table.columns[best].of.clone()));
    }
    let mut values = Vec::new();
    for (column, history) in table.columns.iter().zip(table.values) {
        let name = match &column.of {
            Of::Point(name) if name.starts_with(ADDED) => {
                let point = checked.bridge.points.iter().find(|point| point.name == *name);
                let Some(x) = point.and_then(|point| point.x).filter(|_| chosen.contains(&column.of)) else { continue };
                format!("deck[{x}].{}", column.quantity)
            }
            _ => column.to_string(),
        };
        values.push((name, column.unit.clone(), history));
    }
    History { time: table.time, values }
}

/// A table as histories between two times, s: equal steps, the last one left out if it was shortened.
pub fn histories(table: &Table, checked: &Checked, [from, to]: [f64; 2]) -> Histories {
    let h = checked.steps().step;
    let begin = table.time.partition_point(|t| *t < from - 1e-9 * h);
    let mut end = table.time.partition_point(|t| *t <= to + 1e-9 * h);
    if end > begin + 1 && (table.time[end - 1] - table.time[end - 2] - h).abs() > 1e-6 * h {
        end -= 1;
    }
    let history = |of: &Of, quantity: &Quantity| -> Vec<f64> {
        let at = table.columns.iter().position(|column| column.of == *of && column.quantity == *quantity);
        at.map(|at| table.values[at][begin..end].to_vec()).unwrap_or_default()
    };
    let mut histories = Histories { time: table.time[begin..end].to_vec(), ..Histories::default() };
    for point in checked.bridge.points.iter().filter(|point| point.direction != Direction::Y) {
        let of = Of::Point(point.name.clone());
        histories.points.push(PointHistory {
            name: point.name.clone(),
            x: point.x,
            displacement: history(&of, &Quantity::Displacement),
            acceleration: history(&of, &Quantity::Acceleration),
            moment: history(&of, &Quantity::Moment),
        });
    }
    let cars = &checked.train_track.cars;
    let loads = cars.iter().flat_map(|car| [car.axle_load(); 4]);
    for (i, static_load) in loads.enumerate() {
        let of = Of::Wheel(i + 1);
        let (force, position) = (history(&of, &Quantity::ContactForce), history(&of, &Quantity::Position));
        let side = |name: &str| history(&of, &Quantity::named(name));
        let sides = Sides {
            lateral: SIDES.map(|[lateral, _]| side(lateral)),
            vertical: SIDES.map(|[_, vertical]| side(vertical)),
            shift: side(SHIFT),
        };
        histories.axles.push(AxleHistory { number: i + 1, force, position, static_load, sides });
    }
    for (i, car) in cars.iter().enumerate() {
        histories.cars.push(of_car(i, car, &history));
    }
    let at = checked.scenario.bridge.at;
    let deck = ttb_scenario::deck::Deck::new(&checked.bridge.structure);
    histories.bridge = deck.map(|deck| [at, at + deck.length]);
    histories
}

fn of_car(i: usize, car: &Car, history: &dyn Fn(&Of, &Quantity) -> Vec<f64>) -> CarHistory {
    let of = Of::Car(i + 1);
    CarHistory {
        number: i + 1,
        acceleration: history(&of, &Quantity::Acceleration),
        pitch_acceleration: history(&of, &Quantity::PitchAcceleration),
        lateral_acceleration: history(&of, &Quantity::named(LATERAL)),
        half_base: Some(0.5 * car.bogie_distance),
    }
}

/// The rows of histories: those of the scenario's own points, and the worst of all others.
pub fn peaks(histories: &Histories, criteria: &Criteria, facts: &Facts) -> Vec<Peak> {
    worst(reduce(histories, criteria, facts).peaks)
}

/// Of all rows those of named points, and the worst of all others.
pub fn worst(all: Vec<Peak>) -> Vec<Peak> {
    let mut own = Vec::new();
    let mut worst: BTreeMap<(PlaceKind, Cow<'static, str>, Cow<'static, str>, Statistic), Peak> = BTreeMap::new();
    for peak in all {
        let along_deck = peak.place_kind == PlaceKind::Point && peak.x.is_some();
        if along_deck || matches!(peak.place_kind, PlaceKind::Axle | PlaceKind::Car) {
            let kind = if along_deck { PlaceKind::Deck } else { peak.place_kind };
            let place = if along_deck { Cow::Borrowed("") } else { peak.place.clone() };
            let one = Peak { place_kind: kind, place, ..peak.clone() };
            let key = (kind, peak.quantity.clone(), peak.filter.clone(), peak.statistic);
            let least = peak.statistic == Statistic::Min;
            let beats = |kept: &Peak| if least { one.value < kept.value } else { one.value > kept.value };
            if worst.get(&key).is_none_or(beats) {
                worst.insert(key, one);
            }
        }
        if peak.place_kind == PlaceKind::Point && !peak.place.starts_with(ADDED) {
            own.push(peak);
        }
    }
    worst.into_values().chain(own).collect()
}

/// One of the histories of a point.
type OfPoint = fn(&PointHistory) -> &[f64];

/// Extremes along the deck: displacement, moment and acceleration raw, and acceleration behind the filter that judges it.
pub fn envelopes(histories: &Histories, judged: &Filter) -> Vec<Envelope> {
    let mut points: Vec<&PointHistory> = histories.points.iter().filter(|point| point.x.is_some()).collect();
    points.sort_by(|a, b| a.x.unwrap_or(0.0).total_cmp(&b.x.unwrap_or(0.0)));
    points.dedup_by_key(|point| point.x.map(f64::to_bits));
    let rate = match histories.time[..] {
        [first, .., last] => (histories.time.len() - 1) as f64 / (last - first),
        _ => return Vec::new(),
    };
    let raw: [(_, _, OfPoint); 3] = [
        (DECK_DISPLACEMENT, "m", |point| &point.displacement),
        (DECK_MOMENT, "N.m", |point| &point.moment),
        (DECK_ACCELERATION, "m/s2", |point| &point.acceleration),
    ];
    let mut envelopes = Vec::new();
    for (quantity, unit, of) in raw {
        let here: Vec<_> = points.iter().filter(|point| !of(point).is_empty()).collect();
        envelopes.extend(envelope(quantity, &Filter::Raw, unit, here.iter().map(|p| (p.x, Some(of(p).to_vec())))));
    }
    let filtered = |point: &&PointHistory| judged.apply(&point.acceleration, rate, 0.0).ok();
    let here: Vec<_> = points.iter().filter(|point| !point.acceleration.is_empty()).collect();
    envelopes.extend(envelope(DECK_ACCELERATION, judged, "m/s2", here.iter().map(|p| (p.x, filtered(p)))));
    envelopes
}

fn envelope(
    quantity: &'static str,
    filter: &Filter,
    unit: &'static str,
    points: impl Iterator<Item = (Option<f64>, Option<Vec<f64>>)>,
) -> Option<Envelope> {
    let (mut x, mut min, mut max) = (Vec::new(), Vec::new(), Vec::new());
    for (at, values) in points {
        let values = values?;
        x.push(at?);
        min.push(values.iter().copied().fold(f64::INFINITY, f64::min));
        max.push(values.iter().copied().fold(f64::NEG_INFINITY, f64::max));
    }
    let filter = filter.label().into();
    (!x.is_empty()).then(|| Envelope { quantity: quantity.into(), filter, unit: unit.into(), x, min, max })
}
