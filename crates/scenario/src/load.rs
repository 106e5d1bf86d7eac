//! From a scenario file to what the physics is built from, or to everything that is wrong with it.
//!
//! ```text
//! text ─ json ─▶ value ─ walk ─▶ fits the schema ─ check ─▶ fits itself ─ resolve ─▶ specs
//! ```
//!
//! No stage stops at the first problem, and a section of the file that is broken does not hide what is wrong in another.

use std::path::Path;

use serde::de::DeserializeOwned;
use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::pieces::Pieces;
use crate::place::place;
use crate::placement::{Chosen, fill};
use crate::problem::{MUST_FIT, Problems, Report, Warning};
use crate::settings::Setting;
use crate::spec::{BridgeSpec, StructureSpec, TrainTrackSpec, Vehicle};
use crate::step::Steps;
use crate::types::{Forces, Scenario};
use crate::{check, json, passage, resolve, schema, settings, walk};

/// A scenario without problems.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// The file's content.
    pub scenario: Scenario,
    /// What the train–track subsystem is built from.
    pub train_track: TrainTrackSpec,
    /// What the bridge subsystem is built from.
    pub bridge: BridgeSpec,
    /// What is allowed, but rarely meant.
    pub warnings: Vec<String>,
    /// What the scenario leaves out and was chosen; [`Checked::scenario`] has it written in.
    pub chosen: Vec<Chosen>,
    /// Between which times peaks count, s.
    pub peaks: [f64; 2],
    /// The same as values: of which place, which quantity, what is usual. Later findings stand in `warnings` alone.
    pub findings: Vec<Warning>,
    /// SHA-256 (hexadecimal) of the two specs, the coupling settings and the FMUs' parameters as JSON and of all imported
    /// files: of all that
    /// decides the result, not of the file's layout, titles, or the choice of output.
    pub hash: String,
    /// Static load of one axle, N, the largest of all cars: the scale of the coupling's tolerance.
    pub axle_load: f64,
}

impl Checked {
    /// Macro step and sub-steps: given, or with `auto` those that frequencies ask for until [`Checked::set_steps`].
    #[must_use]
    pub fn steps(&self) -> Steps {
        Steps { step: self.train_track.step, substeps: self.train_track.substeps }
    }

    /// Takes other steps.
    pub fn set_steps(&mut self, steps: Steps) {
        (self.train_track.step, self.train_track.substeps, self.bridge.step) = (steps.step, steps.substeps, steps.step);
        self.hash = hash(&self.train_track, &self.bridge, &self.scenario);
    }
}

/// Reads and checks a scenario file.
///
/// # Errors
/// All problems of the scenario; a file that cannot be read is one.
pub fn load(path: &Path) -> Result<Checked, Problems> {
    load_with(path, &[])
}

/// Reads and checks a scenario file in which some keys have other values.
///
/// # Errors
/// As [`load`], and settings of keys that no scenario has.
pub fn load_with(path: &Path, settings: &[Setting]) -> Result<Checked, Problems> {
    let (text, name) = text(path)?;
    from_str_with(&text, path.parent().unwrap_or(Path::new("")), &name, settings)
}

/// As [`load_with`], with somebody who knows trains of forces by name.
///
/// # Errors
/// As [`from_str_using`].
pub fn load_using(path: &Path, settings: &[Setting], forces: &ForceLookUp) -> Result<Checked, Problems> {
    let (text, name) = text(path)?;
    from_str_using(&text, path.parent().unwrap_or(Path::new("")), &name, settings, forces)
}

/// The content of a scenario file and its name.
fn text(path: &Path) -> Result<(String, String), Problems> {
    let name = path.display().to_string();
    let text = ttb_import::text(path).map_err(|error| {
        let mut report = Report::new(&name);
        report.problem("", "the scenario file cannot be read", error);
        report.into_problems()
    })?;
    Ok((text, name))
}

/// Checks a scenario given as text.
///
/// Files that it names are looked for from `base_dir`; messages call it `file_name`.
///
/// # Errors
/// All problems of the scenario.
pub fn from_str(text: &str, base_dir: &Path, file_name: &str) -> Result<Checked, Problems> {
    from_str_with(text, base_dir, file_name, &[])
}

/// Checks a scenario given as text in which some keys have other values.
///
/// # Errors
/// As [`from_str`], and settings of keys that no scenario has.
pub fn from_str_with(text: &str, base_dir: &Path, file_name: &str, settings: &[Setting]) -> Result<Checked, Problems> {
    from_str_using(text, base_dir, file_name, settings, &|_, _| {
        Err("names of trains of forces are known where trains are: give the axles as [m, N]".into())
    })
}

/// Axles (m behind the first one, N) of a train of forces by its name or file, which is looked for from a folder; or why not.
pub type ForceLookUp<'a> = dyn Fn(&str, &Path) -> Result<Vec<[f64; 2]>, String> + 'a;

/// As [`from_str_with`], with somebody who knows trains of forces by name.
///
/// # Errors
/// As [`from_str_with`], and names that stand for no train.
pub fn from_str_using(
    text: &str,
    base_dir: &Path,
    file_name: &str,
    settings: &[Setting],
    forces: &ForceLookUp,
) -> Result<Checked, Problems> {
    let mut report = Report::new(file_name);
    let Some(mut document) = json::read(text, &mut report) else {
        return Err(report.into_problems());
    };
    settings::apply(settings, &mut document, &mut report);
    look_up(&mut document.value, base_dir, forces, &mut report);
    walk::walk(&schema::SCENARIO, &document.value, &document.reported, &mut report);
    let pieces = Pieces::read(&document.value);
    let resolved = resolve::resolve(&pieces, base_dir, &mut report);
    let mut placed = place(&pieces, &resolved, &mut report);
    check::check(&pieces, &resolved, &placed, &mut report);
    if !report.problems.is_empty() {
        return Err(report.into_problems());
    }
    // What fits the schema fits the types and resolves; should that ever fail, it is a problem like any other.
    let mut scenario: Scenario = match serde_json::from_value(document.value) {
        Ok(scenario) => scenario,
        Err(error) => {
            report.problem("$", MUST_FIT, error);
            return Err(report.into_problems());
        }
    };
    let chosen = std::mem::take(&mut placed.chosen);
    fill(&mut scenario, placed);
    let Some((train_track, bridge)) = resolve::specs(&scenario, resolved) else {
        report.problem("$", MUST_FIT, "a name stands for nothing");
        return Err(report.into_problems());
    };
    check::chosen_steps(&train_track, &mut report);
    if scenario.time.step.given().is_none() && !scenario.fmus.train_track.parameters.is_empty() {
        report.problem(
            "$.time.step",
            "must be a number where fmus.train_track gives parameters: a step is chosen without them",
            "auto",
        );
    }
    if !report.problems.is_empty() {
        return Err(report.into_problems());
    }
    let peaks = passage::peaks(&scenario, &train_track, &bridge, &mut report);
    Ok(Checked {
        chosen,
        peaks,
        hash: hash(&train_track, &bridge, &scenario),
        axle_load: train_track.consist().iter().flat_map(Vehicle::axles).map(|[load, _]| load).fold(0.0, f64::max),
        scenario,
        train_track,
        bridge,
        warnings: report.warnings.iter().map(ToString::to_string).collect(),
        findings: report.warnings,
    })
}

/// Reads a JSON document of another kind than a scenario by its schema, with the same messages.
///
/// # Errors
/// Everything that does not fit the schema.
pub fn read_as<T: DeserializeOwned>(text: &str, schema: &Value, file_name: &str) -> Result<T, Problems> {
    let mut report = Report::new(file_name);
    let Some(document) = json::read(text, &mut report) else { return Err(report.into_problems()) };
    walk::walk(schema, &document.value, &document.reported, &mut report);
    if report.problems.is_empty() {
        match serde_json::from_value(document.value) {
            Ok(value) => return Ok(value),
            Err(error) => report.problem("$", MUST_FIT, error),
        }
    }
    Err(report.into_problems())
}

/// Puts the axles in the place of a named train of forces.
fn look_up(value: &mut Value, base_dir: &Path, forces: &ForceLookUp, report: &mut Report) {
    let Some(place) = value.pointer_mut("/train/forces") else { return };
    let Some(name) = place.as_str().map(str::to_string) else { return };
    match forces(&name, base_dir) {
        Ok(axles) => *place = serde_json::to_value(Forces::Axles(axles)).unwrap_or_default(),
        Err(why) => report.problem("$.train.forces", "must be a train of forces", format!("`{name}`: {why}")),
    }
}

fn hash(train_track: &TrainTrackSpec, bridge: &BridgeSpec, scenario: &Scenario) -> String {
    let Scenario { coupling, fmus, .. } = scenario;
    let mut digest = Digesting(Sha256::new());
    // neither the specs nor this writer can fail to be written
    let written = if fmus.is_empty() {
        serde_json::to_writer(&mut digest, &(train_track, bridge, coupling))
    } else {
        serde_json::to_writer(&mut digest, &(train_track, bridge, coupling, fmus))
    };
    debug_assert!(written.is_ok());
    if let StructureSpec::Matrices { files, folder, .. } = &bridge.structure {
        for file in files.names() {
            // One that cannot be read is reported when the bridge is built.
            let path = folder.join(file);
            if path.is_file() {
                let _ = std::fs::File::open(path).and_then(|mut file| std::io::copy(&mut file, &mut digest));
            }
        }
    }
    digest.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Digests what is written, so that the JSON of a large model is never held as a whole.
struct Digesting(Sha256);

impl std::io::Write for Digesting {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
