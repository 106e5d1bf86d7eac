//! Rows of the product: both subsystems in this process, coupled by the scenario's iteration.

use std::ops::ControlFlow;
use std::sync::atomic::Ordering;

use ttb_bridge::Bridge;
use ttb_contract::{InProcess, Model, ModelError, Pair};
use ttb_coupling::run::{TimeAxis, run as run_steps};
use ttb_coupling::{Coupling, StepInfo};
use ttb_scenario::Checked;
use ttb_scenario::step::Steps;
use ttb_train_track::TrainTrack;

use super::bench::{Bench, progress};
use super::rows::{Method, Planned, sub_steps};
use crate::clock::cpu;
use crate::error::Error;
use crate::results::ran::{Ran, Watched};

/// Runs a row.
pub fn run(bench: &Bench, row: &Planned) -> Result<Ran, Error> {
    let checked = with_step(bench.checked, row);
    let begin = cpu();
    let refused = |e: ModelError| Error::Input(e.to_string());
    let train_track = TrainTrack::new(checked.train_track.clone()).map_err(refused)?;
    let bridge = Bridge::new(checked.bridge.clone()).map_err(refused)?;
    let outputs = Outputs::new(&train_track, &bridge, &bench.watched)?;
    let Pair { mut train_track, mut bridge, ports } =
        Pair::new(train_track, bridge, checked.settings().force_scale, |force| checked.sent_force(force))
            .map_err(refused)?;
    let mut coupling = Coupling::new(ports.forces(), ports.motions(), checked.settings());
    coupling.initialise(&mut train_track, &mut bridge, 0.0)?;
    let axis = TimeAxis::new(row.step, checked.train_track.end);
    let mut ran = Ran { method: row.name.clone(), step: row.step, steps: axis.steps(), ..Ran::default() };
    ran.preparation = cpu() - begin;
    ran.record(0.0, outputs.read(&mut train_track, &mut bridge)?);
    let bar = progress(bench, &row.name, axis.steps());
    let begin = cpu();
    let after = |t: &mut InProcess<TrainTrack>, b: &mut InProcess<Bridge>, n: u64, time: f64, info: &StepInfo| {
        ran.record(time, outputs.read(t, b)?);
        ran.taken = n;
        ran.iterations += info.iterations as u64;
        bar.set_position(n);
        ran.stepping = cpu() - begin;
        let ends = ran.stepping > bench.budget || bench.stop.load(Ordering::Relaxed);
        Ok::<_, Error>(if ends { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    };
    let ended = run_steps(&mut coupling, &mut train_track, &mut bridge, axis, after);
    bar.finish_and_clear();
    match ended {
        Err(Error::NotConverged(failed)) => ran.failure = Some(failed.to_string()),
        Err(other) => return Err(other),
        Ok(_) => {}
    }
    Ok(ran)
}

/// The scenario at a row's step, a multi-time-step row with sub-steps of train and track.
fn with_step(checked: &Checked, row: &Planned) -> Checked {
    let mut checked = checked.clone();
    let substeps = if row.method == Method::Multi { sub_steps(&checked) } else { 1 };
    checked.set_steps(Steps { step: row.step, substeps });
    checked
}

/// Where the four quantities are read.
struct Outputs {
    bridge: [u32; 2],
    train_track: [u32; 2],
}

impl Outputs {
    fn new(train_track: &TrainTrack, bridge: &Bridge, watched: &Watched) -> Result<Self, Error> {
        let find = |interface: &ttb_contract::Interface, name: String| {
            let found = interface.find(&name).map(|r| r as u32);
            found.ok_or_else(|| Error::Input(format!("there is no output {name}")))
        };
        let (b, t) = (bridge.interface(), train_track.interface());
        let point = &watched.point_name;
        Ok(Self {
            bridge: [
                find(b, format!("point[{point}].displacement"))?,
                find(b, format!("point[{point}].acceleration"))?,
            ],
            train_track: [
                find(t, format!("car[{}].acceleration", watched.car + 1))?,
                find(t, format!("wheel[{}].contact_force", watched.wheel + 1))?,
            ],
        })
    }

    fn read(&self, t: &mut InProcess<TrainTrack>, b: &mut InProcess<Bridge>) -> Result<[f64; 4], Error> {
        let mut values = [0.0; 4];
        let failed = |e: ModelError| Error::Fmu(e.to_string());
        b.instance().get(&self.bridge, &mut values[..2]).map_err(failed)?;
        t.instance().get(&self.train_track, &mut values[2..]).map_err(failed)?;
        Ok(values)
    }
}
