//! A car body: at its centre and over both bogies.

use super::{Asked, CarHistory, Place, Record, Reduced, extreme};
use crate::error::SignalError;
use crate::filter::{Filter, RAW, Weighting};
use crate::index::{BLOCK, Line, lines, n_mv, peak_to_peak, rms, running_rms, sperling, sperling_continuous};
use crate::peak::quantity::{
    BODY_ACCELERATION, COMFORT_N_MV, SPERLING, SPERLING_CONTINUOUS, SPERLING_CONTINUOUS_WHOLE, SPERLING_WHOLE,
};
use crate::peak::{Peak, PlaceKind, Statistic};

/// Peaks that last less are left out of the peak to peak, s.
const LEAST: f64 = 0.05;
/// The longest record whose lines are also taken as a whole, s.
const WHOLE: f64 = 30.0;

pub(super) fn reduce(car: &CarHistory, record: Record, asked: &Asked, out: &mut Reduced) {
    if car.acceleration.is_empty() {
        return;
    }
    let mut places = vec![(car.number.to_string(), car.acceleration.clone())];
    if let Some(half) = car.half_base.filter(|_| car.pitch_acceleration.len() == car.acceleration.len()) {
        for (name, arm) in [("front", half), ("rear", -half)] {
            let over = car.acceleration.iter().zip(&car.pitch_acceleration).map(|(z, phi)| z + arm * phi).collect();
            places.push((format!("{} {name}", car.number), over));
        }
    }
    for (name, signal) in &places {
        accelerations(name, signal, record, asked, out);
        ride(name, signal, record, out);
    }
}

fn place<'a>(quantity: &'a str, name: &str, unit: &'static str) -> Place<'a> {
    Place { quantity, kind: PlaceKind::Car, name: name.into(), unit }
}

fn accelerations(name: &str, signal: &[f64], record: Record, asked: &Asked, out: &mut Reduced) {
    let place = place(BODY_ACCELERATION, name, "m/s2");
    for filter in asked.of(BODY_ACCELERATION) {
        let Some(filtered) = out.filtered(BODY_ACCELERATION, &filter, signal, record, f64::NAN) else { continue };
        let label = filter.label();
        let mut push = |statistic, value, at: Option<usize>| {
            let time = at.map(|at| record.time[at]);
            out.peaks.push(Peak { time, ..place.row(&label, statistic, value) });
        };
        let Filter::Weighting { curve } = filter else {
            let at = extreme(&filtered, f64::abs);
            push(Statistic::AbsMax, filtered[at].abs(), Some(at));
            match peak_to_peak(&filtered, record.rate, LEAST) {
                Ok((value, at)) => push(Statistic::PeakToPeak, value, Some(at)),
                Err(reason) => out.miss(BODY_ACCELERATION, &filter, &reason),
            }
            continue;
        };
        push(Statistic::Rms, rms(&filtered), None);
        let mut short = Vec::new();
        for (statistic, seconds) in [(Statistic::Rms1sMax, 1.0), (Statistic::Rms5sMax, BLOCK)] {
            match running_rms(&filtered, record.rate, seconds) {
                Ok((value, at)) => push(statistic, value, Some(at)),
                Err(reason) => short.push((statistic, reason)),
            }
        }
        for (statistic, reason) in short {
            out.miss_statistic(BODY_ACCELERATION, &filter, Some(statistic), &reason);
        }
        if curve == Weighting::WbEn12299 {
            match n_mv(&filtered, record.rate) {
                Ok(value) => out.peaks.push(self::place(COMFORT_N_MV, name, "1").row(&label, Statistic::Value, value)),
                Err(reason) => out.miss(COMFORT_N_MV, &filter, &reason),
            }
        }
    }
}

/// Sperling's indices: of pieces of 5 s, the greatest; of the whole record, if it is not long.
fn ride(name: &str, signal: &[f64], record: Record, out: &mut Reduced) {
    let n = (BLOCK * record.rate).round() as usize;
    let pieces: Vec<Vec<Line>> =
        signal.chunks_exact(n.max(1)).filter_map(|piece| lines(piece, record.rate).ok()).collect();
    let greatest = |index: fn(&[Line]) -> f64| pieces.iter().map(|piece| index(piece)).reduce(f64::max);
    for (quantity, index) in [(SPERLING, sperling as fn(&[Line]) -> f64), (SPERLING_CONTINUOUS, sperling_continuous)] {
        match greatest(index) {
            Some(value) => out.peaks.push(place(quantity, name, "1").row(RAW, Statistic::Value, value)),
            None => {
                let found = record.seconds();
                let reason = match lines(signal, record.rate) {
                    Err(reason) => reason,
                    Ok(_) => {
                        SignalError::TooShort { what: "a piece of Sperling's index", needed: BLOCK, found, unit: "s" }
                    }
                };
                out.miss(quantity, &Filter::Raw, &reason);
            }
        }
    }
    if record.seconds() <= WHOLE
        && let Ok(whole) = lines(signal, record.rate)
    {
        for (quantity, value) in
            [(SPERLING_WHOLE, sperling(&whole)), (SPERLING_CONTINUOUS_WHOLE, sperling_continuous(&whole))]
        {
            out.peaks.push(place(quantity, name, "1").row(RAW, Statistic::Value, value));
        }
    }
}
