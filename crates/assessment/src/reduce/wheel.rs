//! A wheelset: unloading, wheel load, losses of contact.

use super::{Asked, AxleHistory, Histories, LossAt, Place, Record, Reduced, extreme};
use crate::filter::{Filter, RAW};
use crate::index::{Loss, losses};
use crate::peak::quantity::{CONTACT_LOSS, CONTACT_LOSS_ON_BRIDGE, CONTACT_LOSS_WAY, WHEEL_LOAD, WHEEL_UNLOADING};
use crate::peak::{Peak, PlaceKind, Statistic};
use crate::percentile::percentile;

/// Distance of the values of which a percentile is taken, m.
const EVERY: f64 = 2.0;

pub(super) fn reduce(axle: &AxleHistory, histories: &Histories, record: Record, asked: &Asked, out: &mut Reduced) {
    if axle.force.is_empty() || axle.static_load.is_nan() || axle.static_load <= 0.0 {
        return;
    }
    let q0 = 0.5 * axle.static_load;
    let x = |at: usize| axle.position.get(at).copied();
    // Way between two values; where the speed changes, its mean, which a filter over way needs only roughly.
    let way = match axle.position[..] {
        [first, .., last] => (last - first) / (axle.position.len() - 1) as f64,
        _ => f64::NAN,
    };
    // The dynamic part is filtered, not the load itself.
    let unloading: Vec<f64> = axle.force.iter().map(|force| (q0 - 0.5 * force) / q0).collect();
    for (quantity, unit) in [(WHEEL_UNLOADING, "1"), (WHEEL_LOAD, "N")] {
        let place = place(quantity, axle.number, unit);
        for filter in asked.of(quantity) {
            let Some(filtered) = out.filtered(quantity, &filter, &unloading, record, way) else { continue };
            let is_load = quantity == WHEEL_LOAD;
            let at = if is_load { extreme(&filtered, |u| -u) } else { extreme(&filtered, |u| u) };
            let value = if is_load { q0 * (1.0 - filtered[at]) } else { filtered[at] };
            let row = place.row(&filter.label(), Statistic::Max, value);
            let static_value = is_load.then_some(q0);
            out.peaks.push(Peak { x: x(at), time: Some(record.time[at]), static_value, ..row });
            if !is_load && matches!(filter, Filter::SlidingMean { .. }) {
                let values = every(&filtered, way);
                if let Some(value) = percentile(&values, 99.85) {
                    out.peaks.push(place.row(&filter.label(), Statistic::Percentile9985, value));
                }
            }
        }
    }
    contact(axle, histories, record, way, out);
}

fn place<'a>(quantity: &'a str, number: usize, unit: &'static str) -> Place<'a> {
    Place { quantity, kind: PlaceKind::Axle, name: number.to_string(), unit }
}

/// Values at every 2 m of way.
fn every(signal: &[f64], way: f64) -> Vec<f64> {
    let step = (EVERY / way).max(1.0);
    let count = ((signal.len() - 1) as f64 / step) as usize + 1;
    (0..count)
        .map(|k| {
            let s = k as f64 * step;
            let (i, r) = (s as usize, s.fract());
            let next = signal[(i + 1).min(signal.len() - 1)];
            signal[i] + r * (next - signal[i])
        })
        .collect()
}

/// Losses of contact: all, those that begin on the bridge, and the longest way.
fn contact(axle: &AxleHistory, histories: &Histories, record: Record, way: f64, out: &mut Reduced) {
    let all = losses(&axle.force);
    let at = |i: usize| axle.position.get(i.min(axle.position.len().saturating_sub(1))).copied();
    out.losses.extend(all.iter().map(|loss| LossAt {
        axle: axle.number,
        time_s: record.time[loss.first],
        seconds: loss.seconds(record.rate),
        x_m: at(loss.first).zip(at(loss.first + loss.count)).map(|(a, b)| [a, b]),
    }));
    let on_bridge = |loss: &&Loss| {
        histories.bridge.zip(axle.position.get(loss.first)).is_some_and(|([a, b], x)| (a..=b).contains(x))
    };
    let rows = |quantity, of: &[Loss], out: &mut Reduced| {
        let place = place(quantity, axle.number, "s");
        let seconds = of.iter().map(|loss| loss.seconds(record.rate)).fold(0.0, |sum, one| sum + one);
        out.peaks.push(Peak { unit: "1".into(), ..place.row(RAW, Statistic::Count, of.len() as f64) });
        out.peaks.push(place.row(RAW, Statistic::Sum, seconds));
        let longest = of.iter().reduce(|longest, one| if one.count > longest.count { one } else { longest });
        let row = place.row(RAW, Statistic::Max, longest.map_or(0.0, |loss| loss.seconds(record.rate)));
        let (time, x) =
            (longest.map(|loss| record.time[loss.first]), longest.and_then(|l| axle.position.get(l.first).copied()));
        out.peaks.push(Peak { time, x, ..row });
    };
    rows(CONTACT_LOSS, &all, out);
    if histories.bridge.is_some() && !axle.position.is_empty() {
        let on: Vec<Loss> = all.iter().filter(on_bridge).copied().collect();
        rows(CONTACT_LOSS_ON_BRIDGE, &on, out);
        let longest = all.iter().map(|loss| loss.count).max().unwrap_or(0) as f64 * way;
        out.peaks.push(place(CONTACT_LOSS_WAY, axle.number, "m").row(RAW, Statistic::Max, longest));
    }
}
