//! Refinement of resonances: further speeds where a judged quantity is largest.
//!
//! ```text
//! brackets    of every train, variant, rail and quantity: the three largest local maxima over speed, and every v = f₁ λ with a
//!             value of at least half the largest, λ a maximum of the train's signature; each with its two neighbours
//! golden      v between them by golden section, until v changes by less than 0.1 km/h or the value by less than 0.2 %
//! ```
//!
//! What the next speed is follows from the values that are known. Nothing of the search is stored: after an end by force it is
//! gone through again over the journal and asks for what is missing.

use std::collections::BTreeMap;

use crate::plan::{Plan, Rail, Run};
use crate::record::Record;

/// Local maxima of each quantity.
const MAXIMA: usize = 3;
/// Part of the largest value from which on a resonance counts.
const PART: f64 = 0.5;
/// Least change of speed, km/h, and of a value, relative.
const LEAST: (f64, f64) = (0.1, 2e-3);
/// Steps of a search at most.
const MOST: usize = 40;

/// A quantity that is refined, with the label of its filter.
pub type Key = (String, String);

/// What is refined, beside the plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Refined {
    /// Quantities.
    pub keys: Vec<Key>,
    /// Speeds of resonance of every train, km/h.
    pub resonances: Vec<Vec<f64>>,
}

/// Values of the runs that are known, by id; `None` of one that failed.
#[derive(Clone, Debug, Default)]
pub struct Known(BTreeMap<String, Option<Vec<Option<f64>>>>);

impl Known {
    /// Takes a run's values of the keys.
    pub fn add(&mut self, record: &Record, keys: &[Key]) {
        let amount = |(quantity, filter): &Key| record.amount(quantity, filter);
        let values = record.error.is_none().then(|| keys.iter().map(amount).collect());
        self.0.insert(record.run_id.clone(), values);
    }

    /// Whether a run is known.
    pub fn has(&self, id: &str) -> bool {
        self.0.contains_key(id)
    }

    fn value(&self, id: &str, key: usize) -> Option<f64> {
        self.0.get(id)?.as_ref()?.get(key).copied().flatten()
    }
}

/// What a refinement is of.
pub struct Refinement<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// Quantities.
    pub keys: &'a [Key],
    /// Speeds of resonance of every train of the plan, km/h.
    pub resonances: &'a [Vec<f64>],
}

/// One search among those of a curve.
#[derive(Clone, Copy)]
struct Bracket {
    low: f64,
    middle: f64,
    high: f64,
}

impl Refinement<'_> {
    /// All refined runs that are asked for so far, in their order: those that are known and those to be computed next. The
    /// search has ended when all are known.
    pub fn runs(&self, known: &Known) -> Vec<Run> {
        let mut runs = Vec::new();
        for train in 0..self.plan.trains.len() {
            for variant in 0..self.plan.variants.len() {
                for rail in &self.plan.rails {
                    let curve = Curve { of: self, train, variant, rail: *rail, known };
                    let mut speeds = Vec::new();
                    (0..self.keys.len()).for_each(|key| curve.search(key, &mut speeds));
                    speeds.sort_by(f64::total_cmp);
                    speeds.dedup();
                    runs.extend(speeds.into_iter().map(|speed| curve.run(speed, true)));
                }
            }
        }
        runs
    }
}

struct Curve<'a> {
    of: &'a Refinement<'a>,
    train: usize,
    variant: usize,
    rail: Rail,
    known: &'a Known,
}

impl Curve<'_> {
    fn run(&self, speed: f64, refined: bool) -> Run {
        self.of.plan.run(self.train, self.variant, self.rail, Some(speed), refined)
    }

    fn value(&self, speed: f64, key: usize) -> Option<f64> {
        self.known.value(&self.run(speed, false).id, key)
    }

    /// Adds all speeds of one quantity that the search has asked for.
    fn search(&self, key: usize, speeds: &mut Vec<f64>) {
        let grid: Vec<f64> = self.of.plan.speeds(self.train).collect();
        let values: Vec<(f64, f64)> = grid.iter().filter_map(|v| Some((*v, self.value(*v, key)?))).collect();
        for bracket in self.brackets(&values) {
            self.golden(bracket, key, &grid, speeds);
        }
    }

    fn brackets(&self, values: &[(f64, f64)]) -> Vec<Bracket> {
        let inner = 1..values.len().saturating_sub(1);
        let is_maximum = |i: &usize| values[*i].1 >= values[i - 1].1 && values[*i].1 > values[i + 1].1;
        let mut at: Vec<usize> = inner.clone().filter(is_maximum).collect();
        at.sort_by(|a, b| values[*b].1.total_cmp(&values[*a].1).then(a.cmp(b)));
        at.truncate(MAXIMA);
        let largest = values.iter().map(|value| value.1).fold(0.0, f64::max);
        for resonance in self.of.resonances.get(self.train).into_iter().flatten() {
            let near = inner.clone().min_by(|a, b| {
                let distance = |i: &usize| (values[*i].0 - resonance).abs();
                distance(a).total_cmp(&distance(b))
            });
            let inside = values.first().zip(values.last()).is_some_and(|(a, b)| (a.0..=b.0).contains(resonance));
            at.extend(near.filter(|i| inside && values[*i].1 >= PART * largest));
        }
        at.sort_unstable();
        at.dedup();
        let bracket = |i: usize| Bracket { low: values[i - 1].0, middle: values[i].0, high: values[i + 1].0 };
        at.into_iter().map(bracket).collect()
    }

    /// Golden section over what is known; ends at the first speed whose value is not.
    fn golden(&self, mut of: Bracket, key: usize, grid: &[f64], speeds: &mut Vec<f64>) {
        let golden = 0.5 * (3.0 - 5.0_f64.sqrt());
        let Some(mut best) = self.value(of.middle, key) else { return };
        for _ in 0..MOST {
            let (left, right) = (of.middle - of.low, of.high - of.middle);
            let next = if left > right { of.middle - golden * left } else { of.middle + golden * right };
            let next = (1e3 * next).round() / 1e3;
            if (next - of.middle).abs() < LEAST.0 {
                return;
            }
            if !grid.contains(&next) {
                speeds.push(next);
            }
            let Some(value) = self.value(next, key) else { return };
            let small = (value - best).abs() < LEAST.1 * best.abs();
            let before = next < of.middle;
            if value > best {
                let (low, high) = if before { (of.low, of.middle) } else { (of.middle, of.high) };
                (of, best) = (Bracket { low, middle: next, high }, value);
            } else if before {
                of.low = next;
            } else {
                of.high = next;
            }
            if small {
                return;
            }
        }
    }
}
