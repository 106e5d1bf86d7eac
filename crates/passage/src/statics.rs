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
    step: f64,
    value: Vec<f64>,
    sums: [Vec<f64>; 2],
}

impl Sampled {
    fn interpolated(&self, list: &[f64], x: f64) -> f64 {
        let place = (x / self.step).max(0.0);
        let i = (place.floor() as usize).min(list.len() - 2);
        let share = (place - i as f64).min(1.0);
        list[i] + share * (list[i + 1] - list[i])
    }

    fn at(&self, x: f64) -> f64 {
        let end = self.step * (self.value.len() - 1) as f64;
        if (0.0..=end).contains(&x) { self.interpolated(&self.value, x) } else { 0.0 }
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
    let rows: Vec<Vec<f64>> = (0..=n).map(|i| bridge.lines().at(begin + i as f64 * step)).collect();
    let [low, high] = model.extent();
    let first = -((high - low.min(0.0)).max(0.0) / step).ceil() as i64;
    let last = n as i64 + ((high.max(0.0) - low).max(0.0) / step).ceil() as i64;
    let output = |k: usize| {
        let line = sampled(rows.iter().map(|row| row[pad + k]).collect(), step);
        let mut found = Extreme::default();
        for i in first..=last {
            let c = i as f64 * step;
            let points: f64 = model.forces.iter().map(|[a, load]| load * line.at(c + a)).sum();
            let spread = |sums: &[f64]| -> f64 {
                let part =
                    |x: Option<f64>, open: f64| line.interpolated(sums, x.map_or(open, |x| c + x).clamp(0.0, length));
                model.uniform.iter().map(|u| u.load * (part(u.to, length) - part(u.from, 0.0))).sum()
            };
            let [most, least] = [points + spread(&line.sums[0]), points + spread(&line.sums[1])];
            if most > found.max {
                (found.max, found.max_time) = (most, c);
            }
            if least < found.min {
                (found.min, found.min_time) = (least, c);
            }
        }
        found
    };
    (0..bridge.positions()).map(output).collect()
}

fn sampled(value: Vec<f64>, step: f64) -> Sampled {
    let part = |sign: f64| {
        let mut sum = 0.0;
        let mut sums = vec![0.0];
        for pair in value.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|y| (sign * y).max(0.0));
            sum += sign * 0.5 * step * (a + b);
            sums.push(sum);
        }
        sums
    };
    let sums = [part(1.0), part(-1.0)];
    Sampled { step, value, sums }
}
