//! Vehicles on their track over the bridge: every run is the one that `ttb run` makes of the same scenario, bit for bit. Over a
//! large bridge in all degrees of freedom several runs go side by side and share the sweeps over its factor
//! ([`ttb_bridge::Abreast`]): there the two agree to rounding.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use ttb_bridge::Abreast;
use ttb_contract::ModelError;
use ttb_scenario::Checked;
use ttb_scenario::spec::StructureSpec;
use ttb_scenario::types::{Direction, Point};
use ttb_session::abreast::Run as Lane;
use ttb_session::observe::{Moment, Observer};
use ttb_session::{Case, Column, Ended, Plan as Steps, RunError, Sides, Table, TimeAxis, drive_abreast};

use super::rows::{self, ADDED};
use super::{Shared, Task};
use crate::clock::Since;
use crate::compute::{Compute, Computed};
use crate::history::History;
use crate::kept;
use crate::plan::{Run, Variant};
use crate::points::deck_points;
use crate::record::Record;

/// Both sides in this process.
type Both = Sides<ttb_train_track::TrainTrack, ttb_bridge::Bridge>;

/// What runs of vehicles share.
pub struct Vehicles<'a> {
    /// The plan, its scenario, and what runs are reduced with.
    pub task: Task<'a>,
    /// Tracks and bridges.
    pub shared: &'a Shared,
    /// Runs that go side by side at most.
    pub abreast: usize,
}

/// A run that is about to begin.
struct Ready {
    checked: Checked,
    sides: Both,
    axis: TimeAxis,
}

impl Compute for Vehicles<'_> {
    fn batch(&self, runs: usize, workers: usize) -> usize {
        self.abreast.min(runs.div_ceil(workers))
    }

    fn compute(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed> {
        runs.chunks(self.abreast.max(1)).flat_map(|runs| self.several(runs, stop)).collect()
    }
}

impl Vehicles<'_> {
    fn several(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed> {
        let begin = Since::now();
        let tables = self.tables(runs, stop);
        let computed = runs.iter().zip(tables).map(|(run, table)| match table {
            Err(error) => Computed::Done(Record::failed(&run.id, error, 0.0)),
            Ok(None) => Computed::Stopped,
            Ok(Some((checked, table))) => {
                let histories = rows::histories(&table, &checked, checked.peaks);
                let record = Record {
                    step: Some(checked.steps().step),
                    modes: checked.bridge.modes,
                    ..self.task.record(run, &histories)
                };
                kept::done(record, self.task.keep, || rows::kept(table, &checked))
            }
        });
        let mut computed: Vec<Computed> = computed.collect();
        // What runs side by side took belongs to all of them alike.
        let share = begin.seconds() / runs.len().max(1) as f64;
        for one in &mut computed {
            if let Computed::Done(record) = one {
                record.seconds = share;
            }
        }
        computed
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
        self.tables(std::slice::from_ref(run), stop).pop().unwrap_or(Ok(None))
    }

    /// Takes all steps of runs side by side.
    fn tables(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Result<Option<(Checked, Table)>, String>> {
        let mut ready: Vec<Result<Ready, String>> = runs.iter().map(|run| self.ready(run)).collect();
        let (wanted, clock) = (|column: &Column| rows::wanted(column), || 0.0);
        let of_run =
            |ready: &Ready| (Steps { axis: ready.axis, wanted: &wanted, clock: &clock }, Table::default(), Watch(stop));
        let mut watched: Vec<_> = ready.iter().flatten().map(of_run).collect();
        let lanes = ready.iter_mut().flatten().zip(&mut watched).map(|(ready, (plan, table, watch))| Lane {
            system: &mut ready.sides,
            plan,
            observers: vec![table, watch],
        });
        let mut ahead = Abreast::default();
        let mut between = |sides: &mut [&mut Both]| {
            let bridges = sides.iter_mut().map(|sides| sides.bridge.instance().model_mut());
            ahead.ahead(&mut bridges.collect::<Vec<_>>());
        };
        let ended = drive_abreast(&mut lanes.collect::<Vec<_>>(), &mut between);
        let mut ended = ended.into_iter().zip(watched);
        let outcome = |ready: Ready| match ended.next() {
            Some((Ok(Ended::Complete), (_, table, _))) => Ok(Some((ready.checked, table))),
            Some((Err(error), _)) => Err(error.to_string()),
            Some((Ok(Ended::Stopped), _)) | None => Ok(None),
        };
        let mut outcome = outcome;
        ready.into_iter().map(|ready| ready.and_then(&mut outcome)).collect()
    }

    fn ready(&self, run: &Run) -> Result<Ready, String> {
        let mut checked = self.task.source.of_run(self.task.plan, run).map_err(|problems| problems.to_string())?;
        add_points(&mut checked);
        let mut prepared = self.shared.take(&checked).map_err(|error| error.to_string())?;
        let mut sides = prepared.sides(&checked).map_err(|error| error.to_string())?;
        self.shared.give(&prepared, &checked);
        set_factors(&mut sides, &self.task.plan.variants[run.variant]).map_err(|error| error.to_string())?;
        let axis = Case::of(&checked).axis();
        Ok(Ready { checked, sides, axis })
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
