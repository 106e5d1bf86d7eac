//! Trains of axle loads of a plan, with their signatures.

use serde_json::Value;
use ttb_report::Train;
use ttb_trains::{Axle, ForceTrain, Signature};

use crate::folder::Opened;

/// Range of wavelengths, m, values in it, and the damping ratio of the signature.
const RANGE: [f64; 2] = [4.5, 40.0];
const VALUES: usize = 200;
const DAMPING: f64 = 0.01;

/// Trains of the plan that are axle loads; of a run the axle loads of its own train.
pub fn all(opened: &Opened) -> Vec<Train> {
    if let Some(plan) = &opened.plan {
        let trains = plan["trains"].as_array().into_iter().flatten();
        return trains.filter_map(force_train).map(|train| shown(&train, 0.0)).collect();
    }
    let (Some(checked), Some(run)) = (&opened.checked, opened.results.runs.first()) else { return Vec::new() };
    let mut train = ForceTrain::of_vehicles(&run.train, "", &checked.train_track.consist());
    if train.source.is_empty() {
        (train.source, train.verified) = ("the scenario".into(), "user".into());
    }
    let starts_at = checked.train_track.front_wheel - checked.scenario.bridge.at;
    if train.axles.is_empty() { Vec::new() } else { vec![shown(&train, starts_at)] }
}

/// A train of a plan, if it is one of axle loads.
pub(super) fn force_train(entry: &Value) -> Option<ForceTrain> {
    let axle = |pair: &Value| Some(Axle { x: pair[0].as_f64()?, load: pair[1].as_f64()? });
    let axles: Vec<Axle> = entry["load"]["axles"].as_array()?.iter().filter_map(axle).collect();
    let name = entry["name"].as_str()?.to_string();
    let known = ttb_trains::find(&name).ok().and_then(|found| found.into_iter().next());
    let (source, verified) = known.map_or_else(|| ("the plan".into(), "user".into()), |one| (one.source, one.verified));
    let (title, max_speed, buffers, coach) = (name.clone(), None, None, None);
    (!axles.is_empty()).then_some(ForceTrain { name, title, max_speed, axles, buffers, coach, source, verified })
}

fn shown(train: &ForceTrain, starts_at: f64) -> Train {
    let signature = Signature::new(train, DAMPING);
    let at = |i: usize| RANGE[0] + (RANGE[1] - RANGE[0]) * i as f64 / (VALUES - 1) as f64;
    Train {
        name: train.name.clone(),
        axles: train.axles.iter().map(|axle| [axle.x, axle.load]).collect(),
        signature: (0..VALUES).map(|i| [at(i), signature.amplitude(at(i))]).collect(),
        starts_at,
        spacings: signature.resonances(RANGE).iter().map(|one| one.length).collect(),
        source: format!("{} ({})", train.source, train.verified),
    }
}
