//! What only a run in space has: derailment quotient and track shift of wheelsets, lateral acceleration of car bodies.
//!
//! ```text
//! Y/Q     outward force of a wheel on its rail over its load, where Q > Q₀/100, else 0
//! ΣY      lateral force of a wheelset on the track; static value 2Q₀/3, Prud'homme's limit k₁ (10 kN + 2Q₀/3)
//! ```
//!
//! Both raw and behind the sliding means that are asked for, usually over 2 m.

use super::{Asked, AxleHistory, CarHistory, Place, Record, Reduced, extreme};
use crate::filter::{Filter, RAW, Weighting};
use crate::index::{BLOCK, Line, lines, rms, running_rms, sperling_lateral};
use crate::peak::quantity::{BODY_LATERAL, DERAILMENT, SPERLING_LATERAL, TRACK_SHIFT};
use crate::peak::{Peak, PlaceKind, Statistic};

/// Below this part of its static load a wheel has no quotient.
const UNLOADED: f64 = 0.01;

/// Names of a run's outputs: lateral and vertical force of the left and the right wheel.
pub const SIDES: [[&str; 2]; 2] =
    [["left.lateral_force", "left.vertical_force"], ["right.lateral_force", "right.vertical_force"]];
/// Of ΣY.
pub const SHIFT: &str = "track_shift_force";
/// Of a body's lateral acceleration.
pub const LATERAL: &str = "acceleration_y";

/// Forces of the wheels of a wheelset on their rails; empty in a plane run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sides {
    /// Y of the left and the right wheel, outward positive, N.
    pub lateral: [Vec<f64>; 2],
    /// Q of both, N.
    pub vertical: [Vec<f64>; 2],
    /// ΣY, N.
    pub shift: Vec<f64>,
}

pub(super) fn axle(axle: &AxleHistory, record: Record, asked: &Asked, out: &mut Reduced) {
    let sides = &axle.sides;
    let way = match axle.position[..] {
        [first, .., last] => (last - first) / (axle.position.len() - 1) as f64,
        _ => f64::NAN,
    };
    let q0 = 0.5 * axle.static_load;
    for (name, y, q) in
        [("left", &sides.lateral[0], &sides.vertical[0]), ("right", &sides.lateral[1], &sides.vertical[1])]
    {
        if y.is_empty() || y.len() != q.len() || q0.is_nan() || q0 <= 0.0 {
            continue;
        }
        let quotient = |(y, q): (&f64, &f64)| if *q > UNLOADED * q0 { y / q } else { 0.0 };
        let signal: Vec<f64> = y.iter().zip(q).map(quotient).collect();
        let place =
            Place { quantity: DERAILMENT, kind: PlaceKind::Axle, name: format!("{} {name}", axle.number), unit: "1" };
        rows(&place, &signal, false, axle, (record, way), asked, None, out);
    }
    if !sides.shift.is_empty() {
        let place = Place { quantity: TRACK_SHIFT, kind: PlaceKind::Axle, name: axle.number.to_string(), unit: "N" };
        let static_value = (q0 > 0.0).then_some(2.0 * q0 / 3.0);
        rows(&place, &sides.shift, true, axle, (record, way), asked, static_value, out);
    }
}

/// The greatest value, or amount, behind every filter that is asked for.
#[expect(clippy::too_many_arguments, reason = "one row's whole origin")]
fn rows(
    place: &Place,
    signal: &[f64],
    amount: bool,
    axle: &AxleHistory,
    (record, way): (Record, f64),
    asked: &Asked,
    static_value: Option<f64>,
    out: &mut Reduced,
) {
    for filter in asked.of(place.quantity) {
        let Some(filtered) = out.filtered(place.quantity, &filter, signal, record, way) else { continue };
        let at = if amount { extreme(&filtered, f64::abs) } else { extreme(&filtered, |value| value) };
        let value = if amount { filtered[at].abs() } else { filtered[at] };
        let row = place.row(&filter.label(), Statistic::Max, value);
        let (x, time) = (axle.position.get(at).copied(), Some(record.time[at]));
        out.peaks.push(Peak { x, time, static_value, ..row });
    }
}

pub(super) fn car(car: &CarHistory, record: Record, asked: &Asked, out: &mut Reduced) {
    let signal = &car.lateral_acceleration;
    if signal.is_empty() {
        return;
    }
    let name = car.number.to_string();
    let place = |quantity, unit| Place { quantity, kind: PlaceKind::Car, name: name.clone(), unit };
    for filter in asked.of(BODY_LATERAL) {
        let Some(filtered) = out.filtered(BODY_LATERAL, &filter, signal, record, f64::NAN) else { continue };
        let (label, place) = (filter.label(), place(BODY_LATERAL, "m/s2"));
        if !matches!(filter, Filter::Weighting { curve: Weighting::Wd }) {
            let at = extreme(&filtered, f64::abs);
            let row = place.row(&label, Statistic::AbsMax, filtered[at].abs());
            out.peaks.push(Peak { time: Some(record.time[at]), ..row });
            continue;
        }
        out.peaks.push(place.row(&label, Statistic::Rms, rms(&filtered)));
        match running_rms(&filtered, record.rate, BLOCK) {
            Ok((value, at)) => {
                let row = place.row(&label, Statistic::Rms5sMax, value);
                out.peaks.push(Peak { time: Some(record.time[at]), ..row });
            }
            Err(reason) => out.miss_statistic(BODY_LATERAL, &filter, Some(Statistic::Rms5sMax), &reason),
        }
    }
    let n = ((BLOCK * record.rate).round() as usize).max(1);
    let pieces: Vec<Vec<Line>> = signal.chunks_exact(n).filter_map(|piece| lines(piece, record.rate).ok()).collect();
    match pieces.iter().map(|piece| sperling_lateral(piece)).reduce(f64::max) {
        Some(value) => out.peaks.push(place(SPERLING_LATERAL, "1").row(RAW, Statistic::Value, value)),
        None => {
            let (what, found) = ("a piece of Sperling's index", record.seconds());
            let short = crate::error::SignalError::TooShort { what, needed: BLOCK, found, unit: "s" };
            let reason = lines(signal, record.rate).err().unwrap_or(short);
            out.miss(SPERLING_LATERAL, &Filter::Raw, &reason);
        }
    }
}
