//! The way of one axle: the passage of a unit axle at each speed gives every train at that speed by superposition
//! (`ttb_passage`), whatever the bridge's damping.
//!
//! Runs are computed speed by speed, all trains of one speed together, so that a speed costs one passage.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use ttb_assessment::filter::RAW;
use ttb_assessment::{Facts, Filter, Peak, PlaceKind, Statistic};
use ttb_passage::one_axle::Unit;
use ttb_passage::own::OwnBridge;
use ttb_passage::{Extreme, Quantity};
use ttb_scenario::deck::Deck;
use ttb_scenario::types::Heading;

use crate::clock::Since;
use crate::compute::{Compute, Computed, small};
use crate::coupled::loads::free_vibration;
use crate::coupled::{Source, vehicles};
use crate::kept;
use crate::modal::{Rows, force_train};
use crate::plan::{Plan, Run, Train};
use crate::record::Record;

/// Samples of the shortest period that counts, and its margin, as in the modal way.
const SAMPLES: f64 = 20.0;
const MARGIN: f64 = 1.2;

/// A bridge of a variant.
struct Known {
    own: OwnBridge,
    length: f64,
    step: f64,
    free: f64,
}

/// What is known of a bridge, or why it cannot be made.
type Made = Result<Arc<Known>, String>;

/// What runs by one axle share.
pub struct OneAxle<'a> {
    plan: &'a Plan,
    source: &'a Source,
    facts: &'a Facts,
    filters: Vec<Filter>,
    /// The campaign's folder, if the history of every run is kept there.
    keep: Option<&'a Path>,
    /// First to last axle of the longest train, m.
    longest: f64,
    bridges: Kept,
}

/// Bridges that were made, by variant; a clone is the same.
#[derive(Clone, Default)]
pub struct Kept(Arc<Mutex<BTreeMap<usize, Made>>>);

impl<'a> OneAxle<'a> {
    /// Of a plan. `filters` are those of the deck's acceleration.
    pub fn new(plan: &'a Plan, source: &'a Source, facts: &'a Facts, filters: Vec<Filter>) -> Self {
        let longest = plan.trains.iter().filter_map(Train::length).fold(0.0, f64::max);
        Self { plan, source, facts, filters, keep: None, longest, bridges: Kept::default() }
    }

    /// With the history of every run kept in this folder.
    #[must_use]
    pub fn keeping(self, folder: &'a Path) -> Self {
        Self { keep: Some(folder), ..self }
    }

    /// With bridges that were made for the same plan before.
    #[must_use]
    pub fn with(self, bridges: Kept) -> Self {
        Self { bridges, ..self }
    }

    fn bridge(&self, variant: usize) -> Result<Arc<Known>, String> {
        let mut bridges = self.bridges.0.lock().unwrap_or_else(PoisonError::into_inner);
        bridges.entry(variant).or_insert_with(|| self.make(variant).map(Arc::new)).clone()
    }

    fn make(&self, variant: usize) -> Result<Known, String> {
        let Some(variant) = self.plan.variants.get(variant) else { return Err("there is no such variant".into()) };
        let checked = self.source.varied(variant).map_err(|problems| problems.to_string())?;
        let first = self.facts.n0_hz.unwrap_or(0.0);
        let highest = MARGIN * 30.0_f64.max(1.5 * first).max(self.facts.third_mode_hz.unwrap_or(0.0));
        let step = checked.steps().step.min(1.0 / (SAMPLES * highest));
        let length = Deck::new(&checked.bridge.structure).map_or(0.0, |deck| deck.length);
        let free = free_vibration(&checked.bridge, self.facts.n0_hz);
        let own = OwnBridge::new(&checked.bridge, step).map_err(|error| error.to_string())?;
        Ok(Known { own, length, step, free })
    }

    fn unit(&self, known: &Known, run: &Run) -> Result<Unit, String> {
        let Some(speed) = run.speed().filter(|speed| *speed > 0.0) else {
            return Err("axle loads need a speed: give speeds".into());
        };
        let mut bridge = known.own.at_rest().map_err(|error| error.to_string())?;
        let set = vehicles::set_bridge(bridge.instance(), &self.plan.variants[run.variant]);
        set.map_err(|error| error.to_string())?;
        // The same for all trains, whichever are computed now.
        let time = (known.length + self.longest) / speed + known.free;
        let path = if self.heading(run).is_forward() { known.own.path().clone() } else { known.own.path().backward() };
        Unit::run(&mut bridge, &path, speed, known.step, time).map_err(|failure| failure.to_string())
    }

    fn heading(&self, run: &Run) -> Heading {
        self.plan.trains[run.train].heading
    }

    fn at_one_speed(&self, runs: &[Run], stop: &AtomicBool, out: &mut Vec<Computed>) {
        let begin = Since::now();
        let Some(first) = runs.first() else { return };
        if stop.load(Ordering::Relaxed) {
            return out.extend(runs.iter().map(|_| Computed::Stopped));
        }
        let found = self.bridge(first.variant).and_then(|known| Ok((self.unit(&known, first)?, known)));
        // What all share counts for each.
        let share = begin.seconds() / runs.len() as f64;
        for run in runs {
            let begin = Since::now();
            let computed = match (&found, force_train(&self.plan.trains[run.train])) {
                (Ok((unit, known)), Some(train)) => {
                    let histories = unit.histories(&train, known.free);
                    let record = self.record(run, unit, &histories);
                    let record = Record { seconds: share + begin.seconds(), ..record };
                    let history = || kept::of_outputs(&unit.outputs, unit.h, &|output| histories[output].clone());
                    kept::done(record, self.keep, history)
                }
                (Err(error), _) => Computed::Done(Record::failed(&run.id, error.as_str(), share)),
                (_, None) => {
                    Computed::Done(Record::failed(&run.id, "the way of one axle takes axle loads only", share))
                }
            };
            out.push(computed);
        }
    }

    fn record(&self, run: &Run, unit: &Unit, histories: &[Vec<f64>]) -> Record {
        let mut rows = Rows::default();
        for (output, history) in unit.outputs.iter().zip(histories) {
            rows.add(output, RAW, &Extreme::of(history, unit.h), None);
            if output.quantity != Quantity::Acceleration {
                continue;
            }
            for filter in &self.filters {
                match filter.apply(history, 1.0 / unit.h, unit.speed * unit.h) {
                    Ok(filtered) => rows.add(output, &filter.label(), &Extreme::of(&filtered, unit.h), None),
                    Err(error) => return Record::failed(&run.id, format!("{}: {error}", filter.label()), 0.0),
                }
            }
        }
        let mut peaks = rows.peaks();
        peaks.push(Peak::raw("superposition.error", PlaceKind::Whole, Statistic::Value, greatest_error(unit)));
        Record { step: Some(unit.h), peaks, envelopes: rows.envelopes, ..Record::of(&run.id) }
    }
}

impl Compute for OneAxle<'_> {
    fn batch(&self, runs: usize, workers: usize) -> usize {
        small(self.plan.trains.len(), runs, workers)
    }

    fn share(&self, a: &Run, b: &Run) -> bool {
        let of = |run: &Run| (run.variant, run.speed_km_h, self.heading(run));
        of(a) == of(b)
    }

    /// Speed by speed; what else differs keeps its order.
    fn arrange(&self, runs: &mut [Run]) {
        let speed = |run: &Run| run.speed_km_h.unwrap_or(0.0);
        let backward = |run: &Run| !self.heading(run).is_forward();
        runs.sort_by(|a, b| {
            let speeds = speed(a).total_cmp(&speed(b));
            a.variant.cmp(&b.variant).then(speeds).then(backward(a).cmp(&backward(b)))
        });
    }

    fn compute(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed> {
        let mut out = Vec::with_capacity(runs.len());
        for part in runs.chunk_by(|a, b| self.share(a, b)) {
            self.at_one_speed(part, stop, &mut out);
        }
        out
    }
}
/// The error of the superposition, of the output where it is greatest.
fn greatest_error(unit: &Unit) -> f64 {
    unit.errors.iter().copied().fold(0.0, f64::max)
}
