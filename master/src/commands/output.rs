//! What `ttb run` puts into its folder beside the rows: before the first step, and at the end.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use ttb_scenario::types::Scenario;
use ttb_session::RunError;
use ttb_session::observe::{Begin, Moment, Observer};

use crate::cli::Run;
use crate::connect::map::Map;
use crate::error::Error;
use crate::files;
use crate::results::folder::Folder;
use crate::results::job::Job;
use crate::results::summary::{Shown, Summary};

const SUMMARY: &str = "summary.json";
const SCENARIO: &str = "scenario.resolved.json";
/// What a run writes besides, and copies of its maps: `bridge-map.json`, `bridge-map-2.json` …
const FILES: [&str; 14] = [
    "results.csv",
    "iterations.csv",
    "results.svg",
    "results.png",
    "TrainTrack.fmu",
    "Bridge.fmu",
    "runs.csv",
    "peaks.csv",
    "envelope.csv",
    "verified.json",
    "assessment.json",
    "verdicts.json",
    "report.html",
    "system.resolved.ssp",
];
const MAP: &str = "bridge-map";

/// The folder of a run and what belongs into it.
pub struct Output<'a> {
    job: &'a Job,
    folder: Folder,
    /// FMUs that were built, to be copied.
    built: Vec<PathBuf>,
    /// What the run reads, which stays where it is.
    inputs: Vec<&'a Path>,
    scenario: Option<Scenario>,
    maps: &'a [Map],
    /// Whether the summary says `running`.
    running: Cell<bool>,
}

impl<'a> Output<'a> {
    /// Of a run that may still be refused.
    pub fn new(job: &'a Job, folder: Folder, arguments: &'a Run, built: Vec<PathBuf>) -> Self {
        let given =
            arguments.bridge.iter().chain(&arguments.train_track).chain(&arguments.map).chain(&arguments.scenario);
        let inputs = given.map(PathBuf::as_path).collect();
        Self { job, folder, built, inputs, scenario: None, maps: &[], running: Cell::new(false) }
    }

    /// With a scenario and maps, as they were understood.
    pub fn with(self, scenario: Scenario, maps: &'a [Map]) -> Self {
        Self { scenario: Some(scenario), maps, ..self }
    }

    /// Whether anything has been written.
    pub fn is_begun(&self) -> bool {
        self.running.get()
    }

    /// Where it is.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Replaces what an earlier run left by what is known before the first step; the summary says `running`.
    fn begin(&self) -> Result<(), Error> {
        let known = |name: &str| name == SUMMARY || name == SCENARIO || FILES.contains(&name) || name.starts_with(MAP);
        self.folder.begin(known, self.inputs.iter().copied())?;
        self.running.set(true);
        self.summary(None)?;
        if let Some(scenario) = &self.scenario {
            self.keep(SCENARIO, scenario)?;
        }
        for (k, map) in self.maps.iter().enumerate() {
            let number = if k == 0 { String::new() } else { format!("-{}", k + 1) };
            self.keep(&format!("{MAP}{number}.json"), map)?;
        }
        for fmu in &self.built {
            files::copy(fmu, &self.folder.path().join(fmu.file_name().unwrap_or_default()))?;
        }
        Ok(())
    }

    /// As [`Output::begin`], for an observer of the run.
    fn opened(&self) -> Result<(), RunError> {
        self.begin().map_err(|error| match error {
            Error::Io { path, source } => RunError::Write { what: path.display().to_string(), source },
            other => RunError::Write {
                what: self.folder().display().to_string(),
                source: std::io::Error::other(other.to_string()),
            },
        })
    }

    /// Writes a file, unless it is one that the run reads.
    fn keep(&self, name: &str, value: &impl serde::Serialize) -> Result<(), Error> {
        let path = self.folder.file(name);
        if path.exists() { Ok(()) } else { files::write_json(&path, value) }
    }

    /// Writes the summary of a run that has ended.
    pub fn end(&self, summary: &Summary) -> Result<(), Error> {
        self.running.set(false);
        summary.write(&self.folder.file(SUMMARY))
    }

    /// The end of a command: a run that failed between its beginning and its first step says so, too.
    pub fn close(&self, outcome: Result<(), Error>) -> Result<(), Error> {
        if outcome.is_err() && self.running.get() {
            // The first error is the one to be told.
            let _ = self.summary(Some(&outcome));
        }
        outcome
    }

    fn summary(&self, outcome: Option<&Result<(), Error>>) -> Result<(), Error> {
        let shown = Shown::default();
        Summary::new(self.job, outcome, &shown).write(&self.folder.file(SUMMARY))
    }
}

/// Begins a folder when the run does: what is refused before leaves the folder as it was.
pub struct Opening<'a, 'b>(pub &'a Output<'b>);

impl Observer for Opening<'_, '_> {
    fn start(&mut self, _: &Begin) -> Result<(), RunError> {
        self.0.opened()
    }

    fn step(&mut self, _: &Moment) -> Result<ControlFlow<()>, RunError> {
        Ok(ControlFlow::Continue(()))
    }
}
