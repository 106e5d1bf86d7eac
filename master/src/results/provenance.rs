//! Where a run comes from: its command, its options and what it read.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::Serialize;
use ttb_scenario::Checked;
use ttb_scenario::types::{Irregularity, ModelChoice, Scenario, Space, Step, Structure};

use crate::cli::{Isolate, Run};
use crate::error::Error;
use crate::files::sha256;

/// A file that a run read.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Input {
    /// What it was read as: `scenario`, `system`, `train-track`, `bridge`, `map`, `model`, `matrices`, `profile`,
    /// and of a system structure `fmu`, `values`.
    pub role: String,
    /// Its path as it was given, relative to where that is written.
    pub path: String,
    /// Hash of its content, hexadecimal.
    pub sha256: String,
}

/// The options of a run, as far as they may be of interest afterwards.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct Options {
    /// The scenario or system structure; absent: the bundled scenario.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scenario: Option<PathBuf>,
    /// FMU given as train and track; absent: it was built.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub train_track: Option<PathBuf>,
    /// FMUs given as bridges; empty: one was built.
    pub bridge: Vec<PathBuf>,
    /// Maps of the given bridges.
    pub map: Vec<PathBuf>,
    /// Libraries that were loaded first.
    pub preload: Vec<PathBuf>,
    /// Whether trial steps were made before the run.
    pub probe: bool,
    /// FMUs in processes of their own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub isolate: Option<&'static str>,
    /// Longest time of a call of such an FMU, s, if it was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub timeout_s: Option<f64>,
}

/// Command, options and inputs of a run.
#[derive(Clone, Debug, Default)]
pub struct Provenance {
    /// The command line as it was given.
    pub command: Vec<String>,
    /// What it means.
    pub options: Options,
    /// All files read.
    pub inputs: Vec<Input>,
}

impl Options {
    /// Of a command line.
    pub fn new(arguments: &Run) -> Self {
        Self {
            scenario: arguments.scenario.clone(),
            train_track: arguments.train_track.clone(),
            bridge: arguments.bridge.clone(),
            map: arguments.map.clone(),
            preload: arguments.preload.clone(),
            probe: !arguments.no_probe,
            isolate: arguments.isolate.map(|which| match which {
                Isolate::TrainTrack => "train-track",
                Isolate::Bridge => "bridge",
                Isolate::Both => "both",
                Isolate::Given => "given",
            }),
            timeout_s: arguments.timeout,
        }
    }
}

impl Provenance {
    /// Of a command line; `checked` is its scenario, if it has one.
    ///
    /// # Errors
    /// A file cannot be read again.
    pub fn new(arguments: &Run, checked: Option<&Checked>) -> Result<Self, Error> {
        let command = std::env::args_os().map(|argument| argument.to_string_lossy().into_owned()).collect();
        let mut provenance = Self { command, options: Options::new(arguments), inputs: Vec::new() };
        if let Some(path) = &arguments.scenario {
            provenance.add(if checked.is_some() { "scenario" } else { "system" }, path, Path::new(""))?;
        }
        let folder = arguments.scenario.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
        for (role, file) in checked.iter().flat_map(|checked| named(&checked.scenario)) {
            provenance.add(role, Path::new(&file), folder)?;
        }
        let given = arguments.train_track.iter().map(|path| ("train-track", path));
        let given = given.chain(arguments.bridge.iter().map(|path| ("bridge", path)));
        for (role, path) in given.chain(arguments.map.iter().map(|path| ("map", path))) {
            provenance.add(role, path, Path::new(""))?;
        }
        Ok(provenance)
    }

    /// Adds a file that lies in `folder`, unless its path is whole.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn add(&mut self, role: &str, path: &Path, folder: &Path) -> Result<(), Error> {
        let sha256 = sha256(&folder.join(path))?;
        self.inputs.push(Input { role: role.into(), path: path.display().to_string(), sha256 });
        Ok(())
    }
}

/// The files that a scenario names, and what they are read as.
fn named(scenario: &Scenario) -> Vec<(&'static str, String)> {
    let mut files = Vec::new();
    match &scenario.bridge.structure {
        Structure::FiniteElements { model: ModelChoice::File(file) } => files.push(("model", file.clone())),
        Structure::Matrices { files: matrices, .. } => {
            files.extend(matrices.names().map(|file| ("matrices", file.to_string())));
        }
        _ => {}
    }
    if let Irregularity::Measured { file, .. } = &scenario.irregularity {
        files.push(("profile", file.clone()));
    }
    if let Some(space) = &mut scenario.space.clone() {
        files.extend(space.files_mut().map(|(role, file)| (role, file.clone())));
    }
    files
}

/// The scenario with all defaults written out, its steps as they were chosen and its files by whole paths: it can be run again
/// from anywhere on this machine. `folder` is where the scenario lies.
pub fn resolved(checked: &Checked, folder: &Path) -> Scenario {
    let whole = |file: &mut String| {
        if let Ok(path) = std::path::absolute(folder.join(&*file)) {
            *file = path.display().to_string();
        }
    };
    let mut scenario = Scenario { schema: None, ..checked.scenario.clone() };
    match &mut scenario.bridge.structure {
        Structure::FiniteElements { model: ModelChoice::File(file) } => whole(file),
        Structure::Matrices { files, .. } => {
            [&mut files.stiffness, &mut files.mass, &mut files.supports].into_iter().for_each(&whole);
            let optional = [&mut files.damping, &mut files.dofs, &mut files.nodes, &mut files.points];
            optional.into_iter().flatten().for_each(&whole);
        }
        _ => {}
    }
    if let Irregularity::Measured { file, .. } = &mut scenario.irregularity {
        whole(file);
    }
    scenario.space.iter_mut().flat_map(Space::files_mut).for_each(|(_, file)| whole(file));
    let steps = checked.steps();
    (scenario.time.step, scenario.time.substeps) = (Step::Seconds(steps.step), Some(steps.substeps));
    // It belongs to a step that is left to the program.
    scenario.time.error = None;
    scenario
}
