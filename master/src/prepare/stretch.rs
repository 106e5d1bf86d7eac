//! A short stretch of a run: the train begins on the bridge's edge and rolls some way on, to see what a step is worth.

use std::path::Path;

use ttb_contract::finite::{larger, smaller};
use ttb_coupling::IterationError;
use ttb_fmi::temporary::Temporary;
use ttb_scenario::Checked;
use ttb_scenario::spec::Profile;
use ttb_scenario::step::Steps;
use ttb_scenario::travel::{self, DEFAULT_RAMP};
use ttb_scenario::types::{Ramp, RampShape};
use ttb_session::{Case, Column, Coupled, Plan, Quantity, RunError, Table, drive};

use super::fmus;
use crate::connect::connected::{Connected, Given, connect};
use crate::connect::isolate::Isolated;
use crate::error::Error;

/// The distance, m: bridge and fading in of the irregularity, but no more and no less than this.
const DISTANCE: [f64; 2] = [40.0, 60.0];
/// Of a train that stands, s.
const STANDING: f64 = 0.2;

/// The bridge of a stretch.
pub struct Stage<'a> {
    /// Its FMUs.
    pub bridges: &'a [Given<'a>],
    /// Whether they are ours: their parameter `step_size` is then set.
    pub ours: bool,
    /// Where FMUs run.
    pub isolated: &'a Isolated,
}

/// An output on the stretch.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The series it belongs to.
    pub series: String,
    /// Least, greatest value.
    pub range: [f64; 2],
    /// Its values at the ends of all steps, if they are those of these times: what is a mean or a peak over the step before
    /// has none.
    pub history: Option<Vec<f64>>,
}

/// The scenario of the stretch.
pub fn stretch(checked: &Checked) -> Checked {
    let mut short = checked.clone();
    let (spec, bridge) = (&mut short.train_track, &checked.scenario.bridge);
    let speed = spec.speed.iter().map(|point| point[1]).fold(0.0, f64::max);
    let end = spec.front_wheel + travel::distance(&spec.speed, spec.end);
    let supports = &checked.bridge.supports;
    let wanted = (supports.last().copied().unwrap_or(0.0) + DEFAULT_RAMP).clamp(DISTANCE[0], DISTANCE[1]);
    // The train cannot begin before it does, nor go farther than it goes.
    let begin = if bridge.at < end { spec.front_wheel.max(bridge.at) } else { spec.front_wheel };
    let distance = wanted.min(end - begin);
    spec.end = if speed > 0.0 { (distance / speed).min(spec.end) } else { STANDING.min(spec.end) };
    (spec.front_wheel, spec.pre_roll, spec.speed) = (begin, 0.0, vec![[0.0, speed]]);
    // It begins at rest, and so does the irregularity.
    if let Profile::Spectrum { ramp: ramp @ None, .. } = &mut spec.irregularity {
        *ramp = Some(Ramp { start: begin, length: DEFAULT_RAMP, shape: RampShape::Quintic });
    }
    short.bridge.end = spec.end;
    short
}

/// Runs the stretch; `None` if the iteration does not converge.
pub fn run(short: &Checked, steps: Steps, stage: &Stage) -> Result<Option<Vec<Seen>>, Error> {
    let folder = Temporary::new("ttb-stretch-").map_err(Error::io(Path::new("temporary folder")))?;
    let mut short = short.clone();
    short.set_steps(steps);
    let train_track = fmus::train_track(&short, folder.path())?;
    let mut connected = connect(&train_track, stage.bridges, &short, stage.isolated, true)?;
    if stage.ours {
        for part in connected.bridge.parts() {
            let instance = part.inner().instance();
            let known = instance.description().variable("step_size").map(|v| v.value_reference);
            known.map_or(Ok(()), |reference| instance.set_real(&[reference], &[steps.step]))?;
        }
    }
    let mut table = Table::default();
    let plan = Plan { axis: Case::of(&short).axis(), wanted: &Column::has_extremes, clock: &|| 0.0 };
    let Connected { train_track, bridge, coupling, .. } = &mut connected;
    let mut coupled = Coupled::new(train_track, bridge, coupling);
    match drive(&mut coupled, &plan, &mut [&mut table]) {
        Ok(_) => {
            let finite = |history: &Vec<f64>| history.iter().all(|x| x.is_finite());
            if let Some(at) = table.values.iter().position(|history| !finite(history)) {
                return Err(Error::Fmu(format!(
                    "step auto: {} is no finite number on a stretch of the run",
                    table.columns[at]
                )));
            }
            Ok(Some(seen(table, coupled.of_train_track())))
        }
        Err(RunError::Iteration(IterationError::NotConverged { .. } | IterationError::Unstable { .. })) => Ok(None),
        Err(error) => Err(error.into()),
    }
}

/// What is compared of every column; the first `of_train_track` are those of train and track. A bridge may give means as
/// accelerations (ours does where forces are held), and a peak is one over the step before: these have no history.
fn seen(table: Table, of_train_track: usize) -> Vec<Seen> {
    let see = |(at, (column, history)): (usize, (Column, Vec<f64>))| {
        let at_times = at < of_train_track && column.quantity != Quantity::PeakAcceleration;
        let range = [history.iter().copied().reduce(smaller), history.iter().copied().reduce(larger)];
        let range = range.map(|end| end.unwrap_or(f64::NAN));
        Seen { series: column.series(), range, history: at_times.then_some(history) }
    };
    table.columns.into_iter().zip(table.values).enumerate().map(see).collect()
}
