//! Runs of axle loads on a rigid track: bridge and iteration of the coupled way.

use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

use ttb_scenario::Checked;
use ttb_scenario::deck::Deck;
use ttb_scenario::spec::BridgeSpec;
use ttb_scenario::types::Damping;
use ttb_session::Table;

use super::forces::{Passage, on_points};
use super::vehicles::add_points;
use super::{Task, rows};
use crate::clock::Since;
use crate::compute::{Compute, Computed};
use crate::history::History;
use crate::kept;
use crate::plan::{Load, Run};
use crate::record::Record;

/// Periods of the first mode for which the bridge is watched after the passage, least and most, and the most time, s.
const PERIODS: [f64; 2] = [2.0, 20.0];
const LONGEST: f64 = 10.0;

/// What runs of loads share.
pub struct Loads<'a> {
    /// The plan, its scenario, and what runs are reduced with.
    pub task: Task<'a>,
    /// Step, s; `None`: the scenario's.
    pub step: Option<f64>,
    /// Bridges that are prepared.
    pub bridges: &'a Bridges,
}

/// Bridges that runs share, the last used first.
#[derive(Default)]
pub struct Bridges(Mutex<Vec<Arc<ttb_bridge::Prepared>>>);

/// So many are kept.
const KEPT: usize = 4;

impl Compute for Loads<'_> {
    fn compute(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed> {
        runs.iter().map(|run| kept::ended(run, self.task.keep, || self.run(run, stop))).collect()
    }
}

impl Loads<'_> {
    /// A run with its histories, as far as rows need them; `None` if it was asked to stop.
    ///
    /// # Errors
    /// Why it failed, a sentence.
    pub fn run(&self, run: &Run, stop: &AtomicBool) -> Result<Option<(Record, History)>, String> {
        let begin = Since::now();
        let Some((checked, table)) = self.table(run, stop)? else { return Ok(None) };
        let histories = rows::histories(&table, &checked, [0.0, checked.bridge.end]);
        let record = Record {
            step: Some(checked.bridge.step),
            modes: checked.bridge.modes,
            seconds: begin.seconds(),
            ..self.task.record(run, &histories)
        };
        Ok(Some((record, rows::kept(table, &checked))))
    }

    /// The scenario of a run, with points along the deck, and its histories; `None` if it was asked to stop.
    ///
    /// # Errors
    /// Why it failed, a sentence.
    pub fn table(&self, run: &Run, stop: &AtomicBool) -> Result<Option<(Checked, Table)>, String> {
        let Task { plan, source, facts, .. } = self.task;
        let variant = &plan.variants[run.variant];
        let mut checked = source.varied(variant).map_err(|problems| problems.to_string())?;
        let Load::Axles(axles) = &plan.trains[run.train].load else {
            return Err("vehicles are no axle loads".into());
        };
        let speed = run.speed().unwrap_or_else(|| checked.train_track.speed.first().map_or(0.0, |point| point[1]));
        if speed.is_nan() || speed <= 0.0 {
            return Err(format!("the speed must be positive: {speed} m/s"));
        }
        let length = Deck::new(&checked.bridge.structure).map_or(0.0, |deck| deck.length);
        let last = axles.iter().map(|axle| axle[0]).fold(0.0, f64::max);
        let step = self.step.unwrap_or(checked.steps().step);
        let end = (length + last) / speed + free_vibration(&checked.bridge, facts.n0_hz);
        add_points(&mut checked);
        checked.train_track.cars.clear();
        checked.bridge = on_points(&checked.bridge, length, step, (end / step).ceil() * step);
        checked.train_track.step = step;
        let prepared = self.prepared(&checked.bridge)?;
        let backward = !plan.trains[run.train].heading.is_forward();
        let passage = Passage { bridge: &checked.bridge, length, axles, speed, backward, variant };
        Ok(passage.run(&prepared, stop)?.map(|table| (checked, table)))
    }

    /// A bridge that serves; who comes while one is made waits for it.
    fn prepared(&self, spec: &BridgeSpec) -> Result<Arc<ttb_bridge::Prepared>, String> {
        let mut bridges = self.bridges.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(at) = bridges.iter().position(|bridge| bridge.serves(spec)) {
            bridges[..=at].rotate_right(1);
        } else {
            let new = ttb_bridge::Prepared::new(spec).map_err(|error| error.to_string())?;
            bridges.truncate(KEPT - 1);
            bridges.insert(0, new);
        }
        Ok(Arc::clone(&bridges[0]))
    }
}

/// How long the bridge is watched after the passage, s: until damping has halved its first mode, within limits.
pub(crate) fn free_vibration(bridge: &BridgeSpec, first: Option<f64>) -> f64 {
    let ratio = match bridge.damping {
        Damping::None => 0.0,
        Damping::Rayleigh { ratio, .. } | Damping::Modal { ratio, .. } => ratio,
    };
    let periods = (std::f64::consts::LN_2 / (std::f64::consts::TAU * ratio)).clamp(PERIODS[0], PERIODS[1]);
    first.map_or(1.0, |first| (periods / first).min(LONGEST))
}
