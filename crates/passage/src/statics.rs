//! Static load models by influence lines.
//!
//! ```text
//! y(c) = Σ P_i I(c + a_i) + Σ q ∫ max(I, 0) dx over the line load       c moves over the deck in steps
//! ```
//!
//! The largest value takes line loads where I > 0, the smallest where I < 0. Trains of axles are in
//! [`crate::Passage::statics`].

use ttb_trains::LoadModel;

use crate::extreme::Extreme;
use crate::modal::ModalBridge;

/// Steps of the deck, and the longest step, m.
const STEPS: f64 = 2000.0;
const LONGEST: f64 = 0.02;

/// An influence line in equal steps, and the integrals of its positive and negative parts from the deck's begin.
struct Sampled {
    value: Vec<f64>,
    sums: [Vec<f64>; 2],
}

impl Sampled {
    fn new(value: Vec<f64>, step: f64) -> Self {
        let part = |sign: f64| {
            let mut sum = 0.0;
            let mut sums = vec![0.0];
            for pair in value.windows(2) {
                let [a, b] = [pair[0], pair[1]].map(|y| if sign * y > 0.0 { y } else { 0.0 });
                sum += 0.5 * step * (a + b);
                sums.push(sum);
            }
            sums
        };
        let sums = [part(1.0), part(-1.0)];
        Self { value, sums }
    }
}

/// A place at a fixed distance from the origin of a load model: so many whole steps before the sample that it lies behind, and
/// which share of the next step.
#[derive(Clone, Copy)]
struct Place {
    steps: i64,
    share: f64,
}

impl Place {
    fn new(distance: f64, step: f64) -> Self {
        let steps = (distance / step).floor();
        Self { steps: steps as i64, share: distance / step - steps }
    }

    /// A list at this place while the origin is at sample `origin`; before and behind the list there are the numbers given.
    fn read(self, list: &[f64], origin: i64, [before, behind]: [f64; 2]) -> f64 {
        let Ok(i) = usize::try_from(origin + self.steps) else { return before };
        match list.get(i..) {
            Some([a, b, ..]) => a + self.share * (b - a),
            Some([last]) if self.share == 0.0 => *last,
            _ => behind,
        }
    }
}

/// A line load, N/m, with its ends; without an end it goes on as far as the deck.
struct Spread {
    load: f64,
    from: Option<Place>,
    to: Option<Place>,
}

impl Spread {
    fn answer(&self, sums: &[f64], origin: i64) -> f64 {
        let ends = [0.0, sums.last().copied().unwrap_or(0.0)];
        let part = |place: Option<Place>, open: f64| place.map_or(open, |place| place.read(sums, origin, ends));
        self.load * (part(self.to, ends[1]) - part(self.from, ends[0]))
    }
}

/// Extremes of the outputs that are no accelerations under a load model wherever it stands; instead of times the places of
/// its origin, m behind the deck's begin.
#[must_use]
pub fn extremes(bridge: &ModalBridge, model: &LoadModel) -> Vec<Extreme> {
    let (length, pad) = (bridge.length(), bridge.mode_pad());
    let n = (length / LONGEST).max(STEPS).ceil() as usize;
    let step = length / n as f64;
    let [begin, _] = bridge.lines().extent();
    let mut values = vec![Vec::with_capacity(n + 1); bridge.positions()];
    for i in 0..=n {
        let row = bridge.lines().at(begin + i as f64 * step);
        values.iter_mut().zip(&row[pad..]).for_each(|(values, value)| values.push(*value));
    }
    let [low, high] = model.extent();
    let first = -((high - low.min(0.0)).max(0.0) / step).ceil() as i64;
    let last = n as i64 + ((high.max(0.0) - low).max(0.0) / step).ceil() as i64;
    let place = |distance: f64| Place::new(distance, step);
    let forces: Vec<(Place, f64)> = model.forces.iter().map(|[a, load]| (place(*a), *load)).collect();
    let spread = model.uniform.iter();
    let spread = spread.map(|u| Spread { load: u.load, from: u.from.map(place), to: u.to.map(place) });
    let spread: Vec<Spread> = spread.collect();
    let output = |value: Vec<f64>| {
        let line = Sampled::new(value, step);
        let mut found = Extreme::default();
        for i in first..=last {
            let points: f64 = forces.iter().map(|(place, load)| load * place.read(&line.value, i, [0.0; 2])).sum();
            let [most, least] = [0, 1].map(|part| {
                let sums = &line.sums[part];
                points + spread.iter().map(|spread| spread.answer(sums, i)).sum::<f64>()
            });
            let c = i as f64 * step;
            if most > found.max {
                (found.max, found.max_time) = (most, c);
            }
            if least < found.min {
                (found.min, found.min_time) = (least, c);
            }
        }
        found
    };
    values.into_iter().map(output).collect()
}
