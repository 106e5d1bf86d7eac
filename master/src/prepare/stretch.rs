//! A short stretch of a run: the train begins on the bridge's edge and rolls some way on, to see what a step is worth.

use std::ops::ControlFlow;
use std::path::Path;

use ttb_coupling::IterationError;
use ttb_coupling::run::{TimeAxis, run as run_steps};
use ttb_fmi::FmuSubsystem;
use ttb_fmi::description::VariableType;
use ttb_scenario::Checked;
use ttb_scenario::step::Steps;
use ttb_scenario::travel::distance;

use super::fmus;
use crate::connect::connected::{BridgeSide, Given, connect};
use crate::connect::isolate::Isolated;
use crate::error::Error;
use crate::results::names::is_quantity;

/// The way, m: bridge and fading in of the irregularity, but no more and no less than this.
const WAY: [f64; 2] = [40.0, 60.0];
const FADE_IN: f64 = 20.0;
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
    /// FMI name.
    pub name: String,
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
    let end = spec.front_wheel + distance(&spec.speed, spec.end);
    let supports = &checked.bridge.supports;
    let wanted = (supports.last().copied().unwrap_or(0.0) + FADE_IN).clamp(WAY[0], WAY[1]);
    // The train cannot begin before it does, nor go farther than it goes.
    let begin = if bridge.at < end { spec.front_wheel.max(bridge.at) } else { spec.front_wheel };
    let way = wanted.min(end - begin);
    spec.end = if speed > 0.0 { (way / speed).min(spec.end) } else { STANDING.min(spec.end) };
    (spec.front_wheel, spec.pre_roll, spec.speed) = (begin, 0.0, vec![[0.0, speed]]);
    short.bridge.end = spec.end;
    short
}

/// Runs the stretch; `None` if the iteration does not converge.
pub fn run(short: &Checked, steps: Steps, stage: &Stage) -> Result<Option<Vec<Seen>>, Error> {
    let folder = tempfile::tempdir().map_err(Error::io(Path::new("temporary folder")))?;
    let mut short = short.clone();
    short.set_steps(steps);
    let train_track = fmus::train_track(&short, folder.path())?;
    let mut connected = connect(&train_track, stage.bridges, &short, stage.isolated, true)?;
    let (train_track, bridge) = (&mut connected.train_track, &mut connected.bridge);
    if stage.ours {
        for part in bridge.parts() {
            let instance = part.inner().instance();
            let known = instance.description().variable("step_size").map(|v| v.value_reference);
            known.map_or(Ok(()), |reference| instance.set_real(&[reference], &[steps.step]))?;
        }
    }
    // A bridge may give means as accelerations: ours does where forces are held.
    let mut sides = vec![Side::new(train_track, true)];
    sides.extend(bridge.parts().map(|part| Side::new(part.inner(), false)));
    let ended = connected.coupling.initialise(train_track, bridge, 0.0).map_err(Error::from).and_then(|_| {
        update(&mut sides, train_track, bridge)?;
        let axis = TimeAxis::new(steps.step, short.train_track.end);
        run_steps(&mut connected.coupling, train_track, bridge, axis, |train_track, bridge, _, _, _| {
            update(&mut sides, train_track, bridge)?;
            Ok::<_, Error>(ControlFlow::Continue(()))
        })
    });
    match ended {
        Ok(_) => Ok(Some(sides.into_iter().flat_map(|side| side.seen).collect())),
        Err(Error::NotConverged(IterationError::NotConverged { .. } | IterationError::Unstable { .. })) => Ok(None),
        Err(error) => Err(error),
    }
}

fn update(sides: &mut [Side], train_track: &mut FmuSubsystem, bridge: &mut BridgeSide) -> Result<(), Error> {
    let Some((first, others)) = sides.split_first_mut() else { return Ok(()) };
    first.update(train_track)?;
    others.iter_mut().zip(bridge.parts()).try_for_each(|(side, part)| side.update(part.inner()))
}

/// The outputs of one FMU.
struct Side {
    references: Vec<u32>,
    row: Vec<f64>,
    seen: Vec<Seen>,
}

impl Side {
    fn new(fmu: &mut FmuSubsystem, at_times: bool) -> Self {
        let outputs = fmu.instance().description().with_causality("output");
        let reported = outputs.filter(|v| v.kind == VariableType::Real && is_quantity(&v.name));
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let (references, seen): (Vec<u32>, Vec<Seen>) = reported
            .map(|v| {
                let history = (at_times && !v.name.ends_with(".peak_acceleration")).then(Vec::new);
                (v.value_reference, Seen { name: v.name.clone(), range: none, history })
            })
            .unzip();
        Self { row: vec![0.0; references.len()], references, seen }
    }

    fn update(&mut self, fmu: &mut FmuSubsystem) -> Result<(), Error> {
        fmu.instance().get_real(&self.references, &mut self.row)?;
        for (seen, value) in self.seen.iter_mut().zip(&self.row) {
            let [low, high] = &mut seen.range;
            (*low, *high) = (low.min(*value), high.max(*value));
            seen.history.iter_mut().for_each(|history| history.push(*value));
        }
        Ok(())
    }
}
