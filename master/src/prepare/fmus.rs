//! From a scenario to two FMU files.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde_json::Value;
use ttb_bridge::Bridge;
use ttb_contract::Model;
use ttb_fmi::temporary::Temporary;
use ttb_model_description::{About, Contents, Date, pack};
use ttb_scenario::{Checked, Chosen};
use ttb_session::Sides;
use ttb_train_track::TrainTrack;

use super::libraries;
use crate::cli::Set;
use crate::error::Error;
use crate::files::whole;

/// The FMUs that were written.
pub struct Built {
    /// TrainTrack.fmu.
    pub train_track: PathBuf,
    /// Bridge.fmu.
    pub bridge: PathBuf,
}

/// One of our FMUs: model identifier, purpose.
struct Kind {
    identifier: &'static str,
    description: &'static str,
}

const TRAIN_TRACK: Kind = Kind {
    identifier: "TrainTrack",
    description: "Railway cars (10 degrees of freedom each) on rail and supports with Hertzian wheel-rail contact. Inputs: \
                  motion of the bridge deck under the supports; outputs: forces of the supports on the deck, and results of \
                  train and wheels. Vertical plane, z down; displacements are changes from the dead-load state.",
};
const BRIDGE: Kind = Kind {
    identifier: "Bridge",
    description: "A bridge of finite elements. Inputs: forces of the track's supports on the deck; outputs: motion of the deck \
                  under the supports, and monitored points. Vertical plane, z down; displacements are changes from the \
                  dead-load state.",
};

/// Loads and checks the scenario, the bundled one if none is named, with other values for some keys; prints what was chosen
/// for keys that are left out, and its warnings.
pub fn scenario(path: Option<&Path>, set: &Set) -> Result<Checked, Error> {
    let checked = match path {
        Some(path) => ttb_scenario::load_using(path, &set.set, &ttb_trains::axles_of),
        None => {
            let text = ttb_scenario::default_scenario_text();
            ttb_scenario::from_str_using(text, Path::new(""), "the bundled scenario", &set.set, &ttb_trains::axles_of)
        }
    };
    let checked = checked.map_err(Error::Scenario)?;
    if let Some(text) = chosen(&checked.chosen) {
        note!("ttb: chosen: {text}");
    }
    for warning in &checked.warnings {
        note!("ttb: warning: {warning}");
    }
    Ok(checked)
}

/// What was chosen, in a line; nothing of a scenario that leaves out no more than the time of free vibration.
fn chosen(chosen: &[Chosen]) -> Option<String> {
    if chosen.iter().all(|chosen| chosen.key == "time.free_vibration") {
        return None;
    }
    let one = |Chosen { key, value, unit, why }: &Chosen| {
        let value = match value {
            Value::Array(list) => list.iter().map(Value::to_string).collect::<Vec<_>>().join(" "),
            Value::Number(x) => x.as_f64().map_or_else(|| x.to_string(), |x| format!("{}", (x * 1e6).round() / 1e6)),
            Value::String(text) => text.clone(),
            other => other.to_string(),
        };
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        format!("\n  {key} = {value}{unit} ({why})")
    };
    Some(chosen.iter().map(one).collect())
}

/// Refuses parameters of FMUs where no FMU is given them.
pub fn only_in_runs(checked: &Checked, command: &str) -> Result<(), Error> {
    if checked.scenario.fmus.is_empty() {
        return Ok(());
    }
    Err(Error::Input(format!(
        "$.fmus: {command} gives no FMU parameters, only ttb run and ttb export-ssp do: leave it out, or change what the scenario \
         itself says"
    )))
}

/// Refuses runs in space where the methods are plane.
pub fn only_plane(checked: &Checked, command: &str) -> Result<(), Error> {
    if checked.train_track.space.is_none() {
        return Ok(());
    }
    Err(Error::Input(format!("$.space: {command} knows plane runs only: leave the key out, or use ttb run")))
}

/// Writes TrainTrack.fmu and Bridge.fmu into `folder`; `ready` is the bridge, if it is prepared already.
pub fn build(checked: &Checked, ready: Option<Arc<ttb_bridge::Prepared>>, folder: &Path) -> Result<Built, Error> {
    let ready = ready.map_or_else(|| prepared_bridge(checked), Ok)?;
    Ok(Built { train_track: train_track(checked, folder)?, bridge: bridge(&ready, checked, folder)? })
}

/// Track and bridge of a scenario, which runs in this process share.
pub type Prepared = ttb_session::Prepared<ttb_train_track::Prepared, ttb_bridge::Prepared>;

/// Track and bridge of a scenario, for runs in this process.
pub fn prepared(checked: &Checked) -> Result<Prepared, Error> {
    Prepared::new(checked).map_err(|e| Error::Input(e.to_string()))
}

/// Both subsystems in this process, in initialization mode.
pub fn sides(checked: &Checked) -> Result<Sides<TrainTrack, Bridge>, Error> {
    prepared(checked)?.sides(checked).map_err(|e| Error::Input(e.to_string()))
}

/// Writes TrainTrack.fmu.
pub fn train_track(checked: &Checked, folder: &Path) -> Result<PathBuf, Error> {
    let model = TrainTrack::new(checked.train_track.clone()).map_err(|e| Error::Input(e.to_string()))?;
    let text = serde_json::to_vec(&checked.train_track).map_err(|e| Error::Pack(format!("train-track.json: {e}")))?;
    write(&TRAIN_TRACK, &model, &[("train-track.json", text)], folder)
}

/// Meshes, orders and reduces the bridge, whatever its step: of a large one that takes its time. Tells what was noticed.
pub fn prepared_bridge(checked: &Checked) -> Result<Arc<ttb_bridge::Prepared>, Error> {
    let prepared = ttb_bridge::Prepared::new(&checked.bridge).map_err(|e| Error::Input(e.to_string()))?;
    let model = Bridge::from_prepared(&prepared).map_err(|e| Error::Input(e.to_string()))?;
    for remark in model.remarks() {
        note!("ttb: warning: {remark}");
    }
    if let Some(a) = model.accuracy() {
        note!(
            "ttb: the bridge is reduced to {a}; under a probe load displacements differ by {:.1e} and accelerations by {:.1e} \
             of their greatest from all {} degrees of freedom",
            a.displacement,
            a.acceleration,
            model.ndof()
        );
    }
    Ok(prepared)
}

/// Writes Bridge.fmu, for the step that the scenario has now.
pub fn bridge(prepared: &Arc<ttb_bridge::Prepared>, checked: &Checked, folder: &Path) -> Result<PathBuf, Error> {
    let model = Bridge::over(prepared, &checked.bridge).map_err(|e| Error::Input(e.to_string()))?;
    let files = model.resources(&checked.bridge).map_err(|e| Error::Pack(e.to_string()))?;
    write(&BRIDGE, &model, &files, folder)
}

/// Writes the FMU of a model with its resources, name and content of each.
fn write<M: Model>(kind: &Kind, model: &M, files: &[(&str, Vec<u8>)], folder: &Path) -> Result<PathBuf, Error> {
    let resources = Temporary::new("ttb-build-").map_err(Error::io(Path::new("temporary folder")))?;
    for (name, content) in files {
        let path = resources.path().join(name);
        std::fs::write(&path, content).map_err(Error::io(&path))?;
    }
    let path = folder.join(format!("{}.fmu", kind.identifier));
    let contents = Contents {
        interface: model.interface(),
        about: &About {
            date: Date::asked_for().map_err(Error::Input)?,
            ..About::of(model, kind.identifier, kind.identifier, kind.description)
        },
        libraries: libraries::of(kind.identifier)?,
        resources: Some(resources.path()),
        licenses: &[("license.txt", include_str!("../../../LICENSE"))],
    };
    whole(&path, |part| pack(&contents, &File::create(part)?).map_err(io::Error::other))?;
    Ok(path)
}
