//! The bridge while the train crosses: displacements of all its points at moments of a run.
//!
//! ```text
//! run       train, track and bridge coupled; λ_n, forces of the supports at every step, are kept
//! replay    the bridge alone in all degrees of freedom under λ:  the same equations, the same motion
//! ```

use ttb_bridge::drawing::Drawing;
use ttb_bridge::system::Work;
use ttb_bridge::{Bridge, Prepared};
use ttb_contract::names::mean_force;
use ttb_contract::{Component, Instance, Model, ModelError};
use ttb_dynamics::newmark::Motion;
use ttb_scenario::Checked;
use ttb_session::column::{Column, Kind};
use ttb_session::observe::{Observer, Progress};
use ttb_session::{Case, Ended, Plan, Quantity, Sides, Table};
use ttb_train_track::TrainTrack;

use crate::error::Error;

/// The bridge at one moment.
pub struct Frame {
    /// s.
    pub time: f64,
    /// Of every point of the drawing, m.
    pub displacements: Vec<[f64; 3]>,
    /// The wheelsets that stand on the bridge, m, in the drawing's axes.
    pub wheels: Vec<[f64; 3]>,
}

/// A run, and the bridge in it.
pub struct Crossing {
    table: Table,
    case: Case,
    bridge: Instance<Bridge>,
    /// Where the bridge begins, m along the track.
    at: f64,
}

impl Crossing {
    /// Runs a scenario with its bridge in all degrees of freedom; `None` if `progress` ended it.
    ///
    /// # Errors
    /// Something cannot be built; the run fails.
    pub fn new(checked: &Checked, progress: &mut Progress) -> Result<Option<Self>, Error> {
        let mut spec = checked.bridge.clone();
        (spec.modes, spec.reduction) = (None, None);
        let prepared = Prepared::new(&spec).map_err(failed)?;
        let bridge = || Bridge::from_prepared(&prepared).map_err(failed);
        let train_track = TrainTrack::new(checked.train_track.clone()).map_err(failed)?;
        let case = Case { supports: true, ..Case::of(checked) };
        let mut sides = Sides::new(train_track, bridge()?, &case).map_err(failed)?;
        let mut table = Table::default();
        let force = |column: &Column| {
            let name = column.quantity.name();
            Component::ALL.into_iter().any(|component| [component.force(), component.mean_force()].contains(&name))
        };
        let wanted = |column: &Column| {
            column.is(Kind::Wheel, &Quantity::Position) || column.of.kind() == Kind::Support && force(column)
        };
        let plan = Plan { axis: case.axis(), wanted: &wanted, clock: &|| 0.0 };
        let observers: &mut [&mut dyn Observer] = &mut [&mut table, progress];
        let ended = sides.run(&plan, observers)?;
        let (bridge, at) = (Instance::new(bridge()?), checked.scenario.bridge.at);
        Ok((ended == Ended::Complete).then_some(Self { table, case, bridge, at }))
    }

    /// Every `every`-th step of the bridge.
    ///
    /// # Errors
    /// A step fails, or `take` does.
    pub fn frames(
        &mut self,
        drawing: &Drawing,
        every: usize,
        mut take: impl FnMut(Frame) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let Self { table, case, bridge, at } = self;
        let inputs: Vec<u32> = (0..bridge.model().interface().inputs().len() as u32).collect();
        let means = case.settings.mean_forces;
        let force = |input: &u32| {
            let name = &bridge.model().interface().variables()[*input as usize].name;
            let name = if means { mean_force(name) } else { name.clone() };
            let history = table.history(&name);
            history.ok_or_else(|| Error::Input(format!("the train–track side has no output {name}")))
        };
        let forces: Vec<&[f64]> = inputs.iter().map(force).collect::<Result<_, _>>()?;
        let of_row = |n: usize| forces.iter().map(|history| history[n]).collect::<Vec<f64>>();
        let (axis, mut motion, mut work) = (case.axis(), Motion::default(), Work::default());
        bridge.enter_initialization(0.0).map_err(failed)?;
        bridge.set(&inputs, &of_row(0)).map_err(failed)?;
        bridge.exit_initialization().map_err(failed)?;
        for n in 0..=axis.steps() as usize {
            if n > 0 {
                let (t, h) = (axis.time(n as u64 - 1), axis.size(n as u64 - 1));
                let (before, after) = (of_row(n - 1), of_row(n));
                if means {
                    bridge.set(&inputs, &after).map_err(failed)?;
                } else {
                    let rates: Vec<f64> = before.iter().zip(&after).map(|(a, b)| (b - a) / h).collect();
                    bridge.set(&inputs, &before).map_err(failed)?;
                    bridge.set_rates(&inputs, &rates).map_err(failed)?;
                }
                bridge.step(t, h).map_err(failed)?;
            }
            if n.is_multiple_of(every) {
                bridge.model().save().complete(&mut motion, &mut work);
                let wheels = wheels(table, n, *at, &drawing.track);
                take(Frame { time: axis.time(n as u64), displacements: drawing.displacements(&motion.u), wheels })?;
            }
        }
        Ok(())
    }
}

fn failed(error: ModelError) -> Error {
    Error::Input(error.0)
}

/// The wheelsets between the first and the last support.
fn wheels(table: &Table, n: usize, at: f64, track: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let columns = table.columns.iter().zip(&table.values);
    let positions = columns.filter(|(column, _)| column.is(Kind::Wheel, &Quantity::Position));
    positions.filter_map(|(_, history)| on_track(history[n] - at, track)).collect()
}

/// The place at x, between two supports.
fn on_track(x: f64, track: &[[f64; 3]]) -> Option<[f64; 3]> {
    let after = track.partition_point(|place| place[0] < x);
    let (before, after) = (track.get(after.checked_sub(1)?)?, track.get(after)?);
    let share = (x - before[0]) / (after[0] - before[0]);
    Some([0, 1, 2].map(|axis| before[axis] + share * (after[axis] - before[axis])))
}
