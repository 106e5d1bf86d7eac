//! summary.json: how a run went, and what it was. Its JSON Schema comes from the types below.

use std::collections::BTreeMap;
use std::path::Path;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Serialize, Serializer};
use ttb_scenario::Chosen;
use ttb_session::axis::shortest;
use ttb_session::observe::{ContactLoss, Iterations, Peaks};

use super::choice::Choice;
use super::coupled::CouplingReport;
use super::job::{Job, Origin};
use super::peaks::{Peak, told};
use super::provenance::{Input, Options};
use crate::error::Error;
use crate::files;
use crate::signals::Signal;

/// Wall seconds.
#[derive(Clone, Copy, Debug, Default, Serialize, JsonSchema)]
pub struct Seconds {
    /// Loading and initializing both FMUs, static equilibrium included.
    pub initialization: f64,
    /// Inside the train–track FMU, steps only.
    pub train_track: f64,
    /// Inside the bridge FMU, steps only.
    pub bridge: f64,
    /// The iteration itself.
    pub master: f64,
    /// Reading and writing results.
    pub recording: f64,
    /// All steps.
    pub stepping: f64,
}

/// The whole file.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Summary<'a> {
    /// `running` until the end; then `ok`, or how the run failed.
    #[schemars(extend("enum" = STATUSES))]
    pub status: &'a str,
    /// Its message.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// The signal that ended the run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub signal: Option<&'static str>,
    /// While it runs, the number of its process.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub process: Option<u32>,
    /// The scenario's or system structure's.
    pub title: &'a str,
    /// Hash of all that decides the results: equal for equal runs, and only for them.
    pub run_sha256: String,
    /// Hash of what the scenario means: resolved data of both subsystems and coupling settings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scenario_sha256: Option<&'a str>,
    /// Hash of the system structure's file, if that was run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub system_sha256: Option<&'a str>,
    /// The command line as it was given.
    pub command: &'a [String],
    /// What it means.
    pub options: &'a Options,
    /// All files that were read.
    pub inputs: &'a [Input],
    /// Seed of a random irregularity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub irregularity_seed: Option<u64>,
    /// Of the program and of FMI.
    pub versions: Versions,
    /// Macro step, s.
    pub step_s: f64,
    /// Internal steps of train and track in each.
    pub substeps: usize,
    /// Keys that the scenario leaves out, and what was chosen for them.
    #[serde(skip_serializing_if = "<[Chosen]>::is_empty")]
    pub chosen: &'a [Chosen],
    /// Why the steps are these, if they were left to the program.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step_choice: Option<&'a Choice>,
    /// Planned end, s.
    pub end_s: f64,
    /// End that was reached, s.
    pub reached_s: f64,
    /// Trials of all steps.
    pub iterations: &'a Iterations,
    /// How strongly the sides are coupled, and how that was dealt with; absent while the run goes on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coupling: Option<CouplingReport>,
    /// Wall time, s.
    pub seconds: Seconds,
    /// Simulated seconds in a second of stepping.
    pub times_faster_than_real_time: f64,
    /// What was noticed.
    pub warnings: Vec<String>,
    /// Wheels that lost contact.
    pub contact_losses: Vec<ContactLoss>,
    /// Between which times peaks count, s; absent: at all times.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peaks_between_s: Option<[f64; 2]>,
    /// Extremes of every recorded variable by its column's name, in the order of the columns.
    pub peaks: Named,
}

/// Every status there is.
const STATUSES: [&str; 10] = [
    "running",
    "ok",
    "bad-input",
    "not-converged",
    "ended",
    "blown-up",
    "fmu-failed",
    "io-failed",
    "findings",
    "interrupted",
];

/// Of the program, of FMI.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Versions {
    ttb: &'static str,
    fmi: &'static str,
}

/// Peaks by name; those that had no value are left out.
#[derive(Debug)]
pub struct Named(pub Vec<Peak>);

impl Serialize for Named {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().filter(|peak| peak.min.value.is_finite()).map(|peak| (&peak.name, peak)))
    }
}

impl JsonSchema for Named {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Peaks".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        BTreeMap::<String, Peak>::json_schema(generator)
    }
}

/// What a run has shown so far.
#[derive(Default)]
pub struct Shown<'a> {
    /// s.
    pub reached: f64,
    /// Trials.
    pub iterations: Iterations,
    /// Absent before the end.
    pub coupling: Option<CouplingReport>,
    /// Wall time.
    pub seconds: Seconds,
    /// What was noticed.
    pub warnings: Vec<String>,
    /// Extremes; absent before the end.
    pub peaks: Option<&'a Peaks>,
}

/// JSON Schema of summary.json.
pub fn schema() -> Schema {
    schemars::schema_for!(Summary)
}

impl<'a> Summary<'a> {
    /// Of a run that has ended; no `outcome`: that has begun.
    pub fn new(job: &'a Job, outcome: Option<&Result<(), Error>>, shown: &'a Shown<'a>) -> Self {
        let (scenario_sha256, system_sha256) = match &job.origin {
            Origin::Scenario(hash) => (Some(hash.as_str()), None),
            Origin::System(hash) => (None, Some(hash.as_str())),
        };
        let error = outcome.and_then(|outcome| outcome.as_ref().err());
        let peaks = shown.peaks.map(|peaks| told(peaks, job.choice.as_ref())).unwrap_or_default();
        let mut warnings = shown.warnings.clone();
        warnings.extend(job.choice.iter().flat_map(|choice| choice.warnings.clone()));
        let (stepping, reached) = (shown.seconds.stepping, shown.reached);
        Self {
            status: match outcome {
                None => "running",
                Some(outcome) => outcome.as_ref().map_or_else(Error::status, |()| "ok"),
            },
            error: error.map(ToString::to_string),
            signal: error.and_then(Error::signal).map(Signal::name),
            process: outcome.is_none().then(std::process::id),
            title: &job.case.title,
            run_sha256: job.hash(),
            scenario_sha256,
            system_sha256,
            command: &job.provenance.command,
            options: &job.provenance.options,
            inputs: &job.provenance.inputs,
            irregularity_seed: job.irregularity_seed,
            versions: Versions { ttb: env!("CARGO_PKG_VERSION"), fmi: "2.0" },
            step_s: job.case.step,
            substeps: job.case.substeps,
            chosen: &job.chosen,
            step_choice: job.choice.as_ref(),
            end_s: job.case.end,
            reached_s: shortest(reached),
            iterations: &shown.iterations,
            coupling: shown.coupling.clone(),
            seconds: shown.seconds,
            times_faster_than_real_time: if stepping > 0.0 { reached / stepping } else { 0.0 },
            warnings,
            contact_losses: shown.peaks.map(Peaks::contact_losses).unwrap_or_default(),
            peaks_between_s: job.case.peaks,
            peaks: Named(peaks),
        }
    }

    /// Writes summary.json. On a disk that is full the one of before, which says `running`, says `io-failed` instead.
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        let mut text = files::json(path, self)?;
        if self.process.is_some() {
            // Room for a longer status.
            text += &" ".repeat(40);
        }
        let written = files::write(path, (text + "\n").as_bytes());
        if written.is_err() {
            files::overwrite(path, "\"status\": \"running\"", "\"status\": \"io-failed\"");
        }
        written
    }
}
