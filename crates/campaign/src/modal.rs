//! The modal way: axle loads on the modes of the bridge, by `ttb_passage`.
//!
//! A bridge is brought into its modes once a variant; a train's load on them is made once a batch.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use ttb_assessment::filter::RAW;
use ttb_assessment::{Filter, Peak, PlaceKind, Statistic};
use ttb_passage::{Extreme, Heading, ModalBridge, Output, Passage, PlaceKind as Kind, Quantity, Settings};
use ttb_trains::{Axle, ForceTrain};

use crate::clock::Since;
use crate::compute::{Compute, Computed, small};
use crate::coupled::Source;
use crate::kept;
use crate::plan::{Load, Plan, Run, Train};
use crate::record::{Envelope, Record};

/// Runs of a batch: so many that a train's load on the modes is made seldom.
const BATCH: usize = 64;

/// A bridge in its modes, or why there is none.
type Made = Result<Arc<ModalBridge>, String>;

/// What modal runs share.
pub struct Modal<'a> {
    plan: &'a Plan,
    source: &'a Source,
    /// Behind which acceleration is looked at, beside raw.
    filters: Vec<Filter>,
    /// The campaign's folder, if the history of every run is kept there.
    keep: Option<&'a Path>,
    bridges: Kept,
}

/// Bridges that were made, by variant; a clone is the same.
#[derive(Clone, Default)]
pub struct Kept(Arc<Mutex<BTreeMap<usize, Made>>>);

impl<'a> Modal<'a> {
    /// Of a plan. `filters` are those of the deck's acceleration.
    pub fn new(plan: &'a Plan, source: &'a Source, filters: Vec<Filter>) -> Self {
        Self { plan, source, filters, keep: None, bridges: Kept::default() }
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

    /// The bridge of a variant; who comes while it is made waits for it.
    ///
    /// # Errors
    /// It cannot be made, a sentence.
    pub fn bridge(&self, variant: usize) -> Result<Arc<ModalBridge>, String> {
        let mut bridges = self.bridges.0.lock().unwrap_or_else(PoisonError::into_inner);
        bridges.entry(variant).or_insert_with(|| self.make(variant)).clone()
    }

    fn make(&self, variant: usize) -> Result<Arc<ModalBridge>, String> {
        let Some(variant) = self.plan.variants.get(variant) else { return Err("there is no such variant".into()) };
        let checked = self.source.varied(variant).map_err(|problems| problems.to_string())?;
        let (stiffness, mass) = (variant.stiffness_factor, variant.mass_factor);
        let settings = Settings { stiffness, mass, forces: self.plan.forces, ..Settings::default() };
        ModalBridge::new(&checked.bridge, &settings).map(Arc::new).map_err(|error| error.to_string())
    }

    fn batch_of(&self, runs: &[Run], stop: &AtomicBool, out: &mut Vec<Computed>) {
        let Some(first) = runs.first() else { return };
        let fail = |error: &str| {
            runs.iter().map(|run| Computed::Done(Record::failed(&run.id, error, 0.0))).collect::<Vec<_>>()
        };
        let (bridge, train) = match (self.bridge(first.variant), force_train(&self.plan.trains[first.train])) {
            (Ok(bridge), Some(train)) => (bridge, train),
            (Err(error), _) => return out.extend(fail(&error)),
            (_, None) => return out.extend(fail("the modal way takes axle loads only")),
        };
        let forward = self.plan.trains[first.train].heading.is_forward();
        let heading = if forward { Heading::Forward } else { Heading::Backward };
        let begin = Since::now();
        let passage = Passage::new(&bridge, &train, heading, None);
        // What all share counts for each.
        let share = begin.seconds() / runs.len() as f64;
        for run in runs {
            if stop.load(Ordering::Relaxed) {
                out.push(Computed::Stopped);
                continue;
            }
            let begin = Since::now();
            let Some(speed) = run.speed().filter(|speed| *speed > 0.0) else {
                let failed = Record::failed(&run.id, "axle loads need a speed: give speeds", 0.0);
                out.push(Computed::Done(failed));
                continue;
            };
            let record = self.record(run, &passage, speed);
            let record = Record { seconds: share + begin.seconds(), ..record };
            out.push(kept::done(record, self.keep, || {
                let histories = passage.histories(speed);
                kept::of_outputs(bridge.outputs(), histories.h, &|output| histories.output(output))
            }));
        }
    }

    fn record(&self, run: &Run, passage: &Passage, speed: f64) -> Record {
        let bridge = passage.bridge();
        let (outputs, positions) = (bridge.outputs(), bridge.positions());
        let (response, histories) = passage.with_histories(speed);
        let mut rows = Rows::default();
        for (k, (output, extreme)) in outputs.iter().zip(&response.extremes).enumerate() {
            rows.add(output, RAW, extreme, passage.statics().get(k));
        }
        for filter in &self.filters {
            let label = filter.label();
            let filtered = histories.accelerations(|h, signals| filter.apply_each(signals, 1.0 / h, speed * h));
            let filtered = match filtered {
                Ok(filtered) => filtered,
                Err(error) => return Record::failed(&run.id, format!("{label}: {error}"), 0.0),
            };
            for (output, extreme) in outputs[positions..].iter().zip(&filtered) {
                rows.add(output, &label, extreme, None);
            }
        }
        Record {
            step: Some(response.step),
            modes: Some(bridge.modes().len()),
            peaks: rows.peaks(),
            envelopes: rows.envelopes,
            ..Record::of(&run.id)
        }
    }
}

impl Compute for Modal<'_> {
    fn batch(&self, runs: usize, workers: usize) -> usize {
        small(BATCH, runs, workers)
    }

    fn share(&self, a: &Run, b: &Run) -> bool {
        (a.train, a.variant) == (b.train, b.variant)
    }

    fn compute(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed> {
        let mut out = Vec::with_capacity(runs.len());
        for part in runs.chunk_by(|a, b| self.share(a, b)) {
            self.batch_of(part, stop, &mut out);
        }
        out
    }
}

/// A train of the plan as axle loads.
pub fn force_train(train: &Train) -> Option<ForceTrain> {
    let Load::Axles(axles) = &train.load else { return None };
    Some(ForceTrain {
        name: train.name.clone(),
        title: String::new(),
        max_speed: None,
        axles: axles.iter().map(|[x, load]| Axle { x: *x, load: *load }).collect(),
        buffers: None,
        coach: None,
        source: String::new(),
        verified: String::new(),
    })
}

/// Rows of a run as they come: the largest along the deck, every named point and bearing, and extremes along the deck.
#[derive(Default)]
pub(crate) struct Rows {
    deck: Vec<Peak>,
    named: Vec<Peak>,
    /// Extremes along the deck.
    pub(crate) envelopes: Vec<Envelope>,
}

impl Rows {
    /// Takes the extremes of an output behind a filter.
    pub(crate) fn add(&mut self, output: &Output, filter: &str, extreme: &Extreme, statics: Option<&Extreme>) {
        let (quantity, unit) = (output.quantity.name(), output.quantity.unit());
        let row = |statistic, value, time, static_value| Peak {
            x: output.place.x,
            filter: filter.to_string().into(),
            unit: unit.into(),
            time: Some(time),
            static_value,
            ..Peak::raw(quantity, PlaceKind::Deck, statistic, value)
        };
        let rows = if output.quantity == Quantity::Acceleration {
            let (value, time) = extreme.largest();
            vec![row(Statistic::AbsMax, value.abs(), time, None)]
        } else {
            vec![
                row(Statistic::Max, extreme.max, extreme.max_time, statics.map(|of| of.max)),
                row(Statistic::Min, extreme.min, extreme.min_time, statics.map(|of| of.min)),
            ]
        };
        match output.place.kind {
            Kind::Deck => {
                self.stretch(output, filter, extreme);
                rows.into_iter().for_each(|row| self.worst(row));
            }
            kind => {
                let place_kind = if kind == Kind::Point { PlaceKind::Point } else { PlaceKind::Bearing };
                let name = &output.place.name;
                self.named.extend(rows.into_iter().map(|row| Peak { place_kind, place: name.clone().into(), ..row }));
            }
        }
    }

    fn worst(&mut self, row: Peak) {
        let same = |kept: &&mut Peak| {
            kept.quantity == row.quantity && kept.filter == row.filter && kept.statistic == row.statistic
        };
        match self.deck.iter_mut().find(same) {
            Some(kept) if row.statistic == Statistic::Min && row.value < kept.value => *kept = row,
            Some(kept) if row.statistic != Statistic::Min && row.value > kept.value => *kept = row,
            Some(_) => {}
            None => self.deck.push(row),
        }
    }

    fn stretch(&mut self, output: &Output, filter: &str, extreme: &Extreme) {
        let Some(x) = output.place.x else { return };
        let quantity = output.quantity.name();
        let at = self.envelopes.iter().position(|one| one.quantity == quantity && one.filter == filter);
        let at = at.unwrap_or_else(|| {
            self.envelopes.push(Envelope {
                quantity: quantity.into(),
                filter: filter.to_string().into(),
                unit: output.quantity.unit().into(),
                x: Vec::new(),
                min: Vec::new(),
                max: Vec::new(),
            });
            self.envelopes.len() - 1
        });
        let envelope = &mut self.envelopes[at];
        envelope.x.push(x);
        envelope.min.push(extreme.min);
        envelope.max.push(extreme.max);
    }

    /// The rows, the largest along the deck first.
    pub(crate) fn peaks(&mut self) -> Vec<Peak> {
        self.deck.drain(..).chain(self.named.drain(..)).collect()
    }
}
