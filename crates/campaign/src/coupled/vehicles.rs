//! Vehicles on their track over the bridge: every run is the one that `ttb run` makes of the same scenario, bit for bit.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use ttb_assessment::{Criteria, Facts, Filter};
use ttb_contract::ModelError;
use ttb_scenario::Checked;
use ttb_scenario::spec::StructureSpec;
use ttb_scenario::types::{Direction, Point};
use ttb_session::observe::{Moment, Observer};
use ttb_session::{Case, Column, Ended, Plan as Steps, RunError, Sides, Table};

use super::rows::{self, ADDED};
use super::{Shared, Source};
use crate::clock::Since;
use crate::compute::{Compute, Computed};
use crate::history::History;
use crate::plan::{Plan, Run, Variant};
use crate::points::deck_points;
use crate::record::{FORMAT, Record};

/// Both sides in this process.
type Both = Sides<ttb_train_track::TrainTrack, ttb_bridge::Bridge>;

/// What runs of vehicles share.
pub struct Vehicles<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// Its scenario.
    pub source: &'a Source,
    /// Criteria whose values are made.
    pub criteria: &'a Criteria,
    /// What is known of the bridge.
    pub facts: &'a Facts,
    /// The filter behind which acceleration is judged.
    pub judged: Filter,
    /// Tracks and bridges.
    pub shared: &'a Shared,
}

impl Compute for Vehicles<'_> {
    fn compute(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed> {
        runs.iter().map(|run| self.one(run, stop)).collect()
    }
}

impl Vehicles<'_> {
    fn one(&self, run: &Run, stop: &AtomicBool) -> Computed {
        let begin = Since::now();
        let seconds = || begin.seconds();
        match self.table(run, stop) {
            Err(error) => Computed::Done(Record::failed(&run.id, error, seconds())),
            Ok(None) => Computed::Stopped,
            Ok(Some((checked, table))) => {
                let histories = rows::histories(&table, &checked, checked.peaks);
                Computed::Done(Record {
                    format: FORMAT,
                    run_id: run.id.clone(),
                    error: None,
                    step: Some(checked.steps().step),
                    modes: checked.bridge.modes,
                    peaks: rows::peaks(&histories, self.criteria, self.facts),
                    envelopes: rows::envelopes(&histories, &self.judged),
                    seconds: seconds(),
                })
            }
        }
    }

    /// The histories of a run; `None` if it was asked to stop.
    ///
    /// # Errors
    /// Why it failed, a sentence.
    pub fn history(&self, run: &Run, stop: &AtomicBool) -> Result<Option<History>, String> {
        Ok(self.table(run, stop)?.map(|(checked, table)| rows::kept(table, &checked)))
    }

    /// The scenario of a run, with points along the deck, and its histories; `None` if it was asked to stop.
    ///
    /// # Errors
    /// Why it failed, a sentence.
    pub fn table(&self, run: &Run, stop: &AtomicBool) -> Result<Option<(Checked, Table)>, String> {
        let mut checked = self.source.of_run(self.plan, run).map_err(|problems| problems.to_string())?;
        add_points(&mut checked);
        let mut prepared = self.shared.take(&checked).map_err(|error| error.to_string())?;
        let mut sides = prepared.sides(&checked).map_err(|error| error.to_string())?;
        self.shared.give(&prepared, &checked);
        set_factors(&mut sides, &self.plan.variants[run.variant]).map_err(|error| error.to_string())?;
        let case = Case::of(&checked);
        let steps = Steps { axis: case.axis(), wanted: &|column: &Column| rows::wanted(column), clock: &|| 0.0 };
        let (mut table, mut watch) = (Table::default(), Watch(stop));
        match sides.run(&steps, &mut [&mut table, &mut watch]) {
            Ok(Ended::Complete) => Ok(Some((checked, table))),
            Ok(Ended::Stopped) => Ok(None),
            Err(error) => Err(error.to_string()),
        }
    }
}

/// Adds the points of the deck to those of the scenario. They are looked at and change nothing.
pub fn add_points(checked: &mut Checked) {
    // Matrices of another program may tell nothing between their supports.
    if matches!(checked.bridge.structure, StructureSpec::Matrices { .. } | StructureSpec::Stored) {
        return;
    }
    let own: Vec<Option<f64>> = checked.bridge.points.iter().map(|point| point.x).collect();
    let new = deck_points(&checked.bridge.structure).into_iter().map(Some).filter(|x| !own.contains(x));
    let point = |(i, x)| Point { name: format!("{ADDED}{i}"), x, node: None, direction: Direction::Z };
    checked.bridge.points.extend(new.enumerate().map(point));
}

/// Sets the bridge's factors on mass and stiffness.
fn set_factors(sides: &mut Both, variant: &Variant) -> Result<(), ModelError> {
    set_bridge(sides.bridge.instance(), variant)
}

/// Sets the factors of a variant as parameters of the bridge; where they are 1 nothing is set.
pub(crate) fn set_bridge(
    bridge: &mut ttb_contract::Instance<ttb_bridge::Bridge>,
    variant: &Variant,
) -> Result<(), ModelError> {
    use ttb_contract::Model;
    for (name, factor) in [("mass_factor", variant.mass_factor), ("stiffness_factor", variant.stiffness_factor)] {
        if factor != 1.0 {
            let reference = bridge.model().interface().find(name);
            let reference = reference.ok_or_else(|| ModelError(format!("the bridge has no parameter {name}")))?;
            bridge.set(&[reference as u32], &[factor])?;
        }
    }
    Ok(())
}

/// Ends a run after the step in which somebody asks for it.
pub(super) struct Watch<'a>(pub &'a AtomicBool);

impl Observer for Watch<'_> {
    fn step(&mut self, _moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        Ok(if self.0.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}
