//! A point of the deck, and the worst of several.

use super::{Asked, Place, PointHistory, Record, Reduced, extreme};
use crate::filter::RAW;
use crate::peak::quantity::{DECK_ACCELERATION, DECK_DISPLACEMENT, DECK_MOMENT};
use crate::peak::{Peak, PlaceKind, Statistic};

pub(super) fn reduce(point: &PointHistory, record: Record, asked: &Asked, out: &mut Reduced) {
    let place = |quantity, unit| Place { quantity, kind: PlaceKind::Point, name: point.name.clone(), unit };
    if !point.acceleration.is_empty() {
        let place = place(DECK_ACCELERATION, "m/s2");
        for filter in asked.of(DECK_ACCELERATION) {
            let Some(filtered) = out.filtered(DECK_ACCELERATION, &filter, &point.acceleration, record, 0.0) else {
                continue;
            };
            let at = extreme(&filtered, f64::abs);
            let row = place.row(&filter.label(), Statistic::AbsMax, filtered[at].abs());
            out.peaks.push(Peak { x: point.x, time: Some(record.time[at]), ..row });
        }
    }
    for (signal, quantity, unit) in [(&point.displacement, DECK_DISPLACEMENT, "m"), (&point.moment, DECK_MOMENT, "N.m")]
    {
        if signal.is_empty() {
            continue;
        }
        let place = place(quantity, unit);
        let greatest = extreme(signal, |value| value);
        let least = extreme(signal, |value| -value);
        for (statistic, at) in [(Statistic::Max, greatest), (Statistic::Min, least)] {
            let row = place.row(RAW, statistic, signal[at]);
            out.peaks.push(Peak { x: point.x, time: Some(record.time[at]), ..row });
        }
    }
}

/// Of every quantity, filter and statistic the worst of all points on the deck, where it is.
pub(super) fn worst(rows: &[Peak]) -> Vec<Peak> {
    let mut worst: Vec<Peak> = Vec::new();
    for row in rows.iter().filter(|row| row.x.is_some()) {
        let same = |kept: &&mut Peak| {
            kept.quantity == row.quantity && kept.filter == row.filter && kept.statistic == row.statistic
        };
        let own = Peak { place_kind: PlaceKind::Deck, place: "".into(), ..row.clone() };
        match worst.iter_mut().find(same) {
            None => worst.push(own),
            Some(kept) => {
                let least = row.statistic == Statistic::Min;
                if (least && row.value < kept.value) || (!least && row.value > kept.value) {
                    *kept = own;
                }
            }
        }
    }
    worst
}
