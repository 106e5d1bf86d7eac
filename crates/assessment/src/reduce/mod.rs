//! Histories of one run reduced to [`Peak`] rows.
//!
//! ```text
//! deck points    ẅ behind every filter that is asked for; w, M raw, with their static values left to others; of points without
//!                a name the worst along the deck
//! wheelsets      (Q₀ − Q)/Q₀ and Q behind every filter, Q = F/2; losses of contact raw, on the bridge and in all
//! cars           z̈ at the body's centre and over both bogies: z̈ ± φ̈ L/2; weighted; Sperling; N_MV
//! ```
//!
//! What a record is too short or too coarse for is told with its reason, not left out.

mod alignment;
mod body;
mod deck;
mod derivative;
mod lateral;
mod wheel;

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::criterion::Criteria;
use crate::error::SignalError;
use crate::facts::Facts;
use crate::filter::{Butterworth, Filter, Phase, Weighting};
use crate::peak::{Peak, PlaceKind, Statistic};
use crate::run::Missing;

pub use alignment::Supports;
pub use derivative::acceleration;
pub use lateral::{LATERAL, SHIFT, SIDES, Sides};

/// Histories of one run, one value at every internal step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Histories {
    /// t, s, equal steps.
    pub time: Vec<f64>,
    /// Points of the deck.
    pub points: Vec<PointHistory>,
    /// Further points of the deck, without names: of all points together the worst along the deck stays.
    pub deck: Vec<PointHistory>,
    /// Wheelsets from the front.
    pub axles: Vec<AxleHistory>,
    /// Cars from the front.
    pub cars: Vec<CarHistory>,
    /// In space: the deck under the supports.
    pub supports: Supports,
    /// Where the bridge begins and ends, m, if that is known.
    pub bridge: Option<[f64; 2]>,
}

/// Motion of a point of the bridge; what is not observed is empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointHistory {
    /// Its name.
    pub name: String,
    /// Abscissa from the begin of the bridge, m.
    pub x: Option<f64>,
    /// m, down.
    pub displacement: Vec<f64>,
    /// m/s².
    pub acceleration: Vec<f64>,
    /// N m.
    pub moment: Vec<f64>,
}

/// A wheelset.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AxleHistory {
    /// From 1 at the front.
    pub number: usize,
    /// Contact force, N.
    pub force: Vec<f64>,
    /// Abscissa, m; empty if it is not observed.
    pub position: Vec<f64>,
    /// Static load of the wheelset, N.
    pub static_load: f64,
    /// In space: both wheels.
    pub sides: Sides,
}

/// A car body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CarHistory {
    /// From 1 at the front.
    pub number: usize,
    /// At its centre, m/s².
    pub acceleration: Vec<f64>,
    /// rad/s²; empty if it is not observed.
    pub pitch_acceleration: Vec<f64>,
    /// In space: to the right at its centre, m/s²; else empty.
    pub lateral_acceleration: Vec<f64>,
    /// Half of the distance of the bogies, m; none: the centre alone.
    pub half_base: Option<f64>,
}

/// What a run leaves for criteria.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reduced {
    /// Rows.
    pub peaks: Vec<Peak>,
    /// What could not be made.
    pub missing: Vec<Missing>,
    /// Every loss of contact.
    pub losses: Vec<LossAt>,
}

/// A loss of contact: when, how long, and from where to where on the track.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LossAt {
    /// The wheelset, from 1 at the front.
    pub axle: usize,
    /// Begin, s.
    pub time_s: f64,
    /// Duration, s.
    pub seconds: f64,
    /// Where it begins and ends, m on the track; none if positions are not observed.
    pub x_m: Option<[f64; 2]>,
}

/// Reduces what `criteria` ask for, and beside it what an engineer compares: filters of usual parameters in both directions.
pub fn reduce(histories: &Histories, criteria: &Criteria, facts: &Facts) -> Reduced {
    let facts = facts.overruled_by(&criteria.facts);
    let mut asked = Asked { filters: Vec::new() };
    for (quantity, filter) in usual() {
        asked.add(quantity, filter);
    }
    for wanted in criteria.wanted(&facts) {
        asked.add(&wanted.quantity, wanted.filter);
    }
    let mut out = Reduced::default();
    let Some(record) = Record::of(&histories.time) else {
        let reason = "the run has fewer than two rows, or its steps are not equal".to_string();
        for (quantity, filter) in asked.filters {
            let (filter, reason) = (filter.label(), reason.clone());
            out.missing.push(Missing { quantity, filter, statistic: None, reason });
        }
        return out;
    };
    histories.points.iter().for_each(|point| deck::reduce(point, record, &asked, &mut out));
    if !histories.deck.is_empty() {
        let mut along = Reduced { missing: out.missing.clone(), ..Reduced::default() };
        histories.deck.iter().for_each(|point| deck::reduce(point, record, &asked, &mut along));
        out.missing = along.missing;
        let known = |peak: &&Peak| along.peaks.iter().any(|other| other.quantity == peak.quantity);
        let named: Vec<Peak> = out.peaks.iter().filter(known).cloned().collect();
        out.peaks.splice(0..0, deck::worst(&[named, along.peaks.clone()].concat()));
    }
    for axle in &histories.axles {
        wheel::reduce(axle, histories, record, &asked, &mut out);
        lateral::axle(axle, record, &asked, &mut out);
    }
    alignment::reduce(&histories.supports, record, &mut out);
    for car in &histories.cars {
        body::reduce(car, record, &asked, &mut out);
        lateral::car(car, record, &asked, &mut out);
    }
    let found = |missing: &Missing, peaks: &[Peak]| {
        peaks.iter().any(|peak| {
            peak.quantity == missing.quantity
                && peak.filter == missing.filter
                && missing.statistic.as_ref().is_none_or(|name| peak.statistic.name() == name)
        })
    };
    out.missing.retain(|missing| !found(missing, &out.peaks));
    out
}

/// Filters that are always made.
fn usual() -> Vec<(&'static str, Filter)> {
    use crate::peak::quantity::{
        BODY_ACCELERATION, BODY_LATERAL, DECK_ACCELERATION, DERAILMENT, TRACK_SHIFT, WHEEL_LOAD, WHEEL_UNLOADING,
    };
    let low_pass = |cut_off_hz, phase| Filter::Butterworth { order: 4, cut_off_hz, phase };
    let both = |quantity, hz| [Phase::Zero, Phase::Causal].map(|phase| (quantity, low_pass(hz, phase)));
    let mut usual = vec![(DECK_ACCELERATION, Filter::Raw)];
    usual.extend(both(DECK_ACCELERATION, 30.0));
    for quantity in [WHEEL_UNLOADING, WHEEL_LOAD] {
        usual.push((quantity, Filter::Raw));
        usual.extend(both(quantity, 20.0));
        usual.push((quantity, Filter::SlidingMean { length_m: 2.0 }));
    }
    usual.push((BODY_ACCELERATION, Filter::Raw));
    usual.push((BODY_ACCELERATION, low_pass(10.0, Phase::Zero)));
    for curve in [Weighting::WbEn12299, Weighting::Wk] {
        usual.push((BODY_ACCELERATION, Filter::Weighting { curve }));
    }
    for quantity in [DERAILMENT, TRACK_SHIFT] {
        usual.push((quantity, Filter::Raw));
        usual.push((quantity, Filter::SlidingMean { length_m: 2.0 }));
    }
    usual.push((BODY_LATERAL, Filter::Raw));
    usual.push((BODY_LATERAL, Filter::Weighting { curve: Weighting::Wd }));
    usual
}

/// What is asked for.
struct Asked {
    filters: Vec<(String, Filter)>,
}

impl Asked {
    fn add(&mut self, quantity: &str, filter: Filter) {
        if !self.filters.iter().any(|(known, one)| known == quantity && *one == filter) {
            self.filters.push((quantity.into(), filter));
        }
    }

    fn of<'a>(&'a self, quantity: &'a str) -> impl Iterator<Item = Filter> + 'a {
        self.filters.iter().filter(move |(known, _)| known == quantity).map(|(_, filter)| *filter)
    }
}

/// Equal steps.
#[derive(Clone, Copy)]
struct Record<'a> {
    time: &'a [f64],
    rate: f64,
}

impl<'a> Record<'a> {
    fn of(time: &'a [f64]) -> Option<Self> {
        let [first, .., last] = time else { return None };
        let h = (last - first) / (time.len() - 1) as f64;
        let equal = |pair: &[f64]| (pair[1] - pair[0] - h).abs() <= 1e-6 * h;
        (h > 0.0 && time.windows(2).all(equal)).then_some(Self { time, rate: 1.0 / h })
    }

    fn seconds(&self) -> f64 {
        self.time.len() as f64 / self.rate
    }
}

/// Where rows of one record belong.
struct Place<'a> {
    quantity: &'a str,
    kind: PlaceKind,
    name: String,
    unit: &'static str,
}

impl Place<'_> {
    fn row(&self, filter: &str, statistic: Statistic, value: f64) -> Peak {
        Peak {
            place: Cow::Owned(self.name.clone()),
            filter: Cow::Owned(filter.into()),
            unit: Cow::Borrowed(self.unit),
            ..Peak::raw(self.quantity.to_string(), self.kind, statistic, value)
        }
    }
}

impl Reduced {
    fn miss(&mut self, quantity: &str, filter: &Filter, reason: &SignalError) {
        self.miss_statistic(quantity, filter, None, reason);
    }

    fn miss_statistic(&mut self, quantity: &str, filter: &Filter, statistic: Option<Statistic>, reason: &SignalError) {
        let statistic = statistic.map(|statistic| statistic.name().to_string());
        let (quantity, filter, reason) = (quantity.into(), filter.label(), reason.to_string());
        let missing = Missing { quantity, filter, statistic, reason };
        if !self.missing.contains(&missing) {
            self.missing.push(missing);
        }
    }

    /// The filtered record, or why there is none.
    fn filtered(
        &mut self,
        quantity: &str,
        filter: &Filter,
        signal: &[f64],
        record: Record,
        way: f64,
    ) -> Option<Vec<f64>> {
        // A cut-off near half the rate does nothing that the filter's name promises.
        if let Filter::Butterworth { order, cut_off_hz, phase } = filter
            && Butterworth::new(*order, *cut_off_hz, record.rate, *phase).is_ok()
            && record.rate < 10.0 * cut_off_hz * (1.0 - 1e-9)
        {
            let (what, frequency, needed) = ("a low-pass filter that judges", *cut_off_hz, 10.0 * cut_off_hz);
            self.miss(quantity, filter, &SignalError::TooCoarse { what, frequency, needed, found: record.rate });
            return None;
        }
        match filter.apply(signal, record.rate, way) {
            Ok(filtered) => Some(filtered),
            Err(reason) => {
                self.miss(quantity, filter, &reason);
                None
            }
        }
    }
}

/// Index of the greatest value by an order.
fn extreme(signal: &[f64], key: impl Fn(f64) -> f64) -> usize {
    let mut at = 0;
    for (i, value) in signal.iter().enumerate() {
        if key(*value) > key(signal[at]) {
            at = i;
        }
    }
    at
}
