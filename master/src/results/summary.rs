//! summary.json, and the few lines for people.

use std::path::Path;

use serde::Serialize;
use ttb_session::Quantity;
use ttb_session::column::{Column, Kind};
use ttb_session::observe::{ContactLoss, Iterations, Peaks};

use super::choice::Choice;
use super::coupled::CouplingReport;
use super::job::{Job, Origin};
use super::peaks::{Peak, told};
use crate::error::Error;

/// Wall seconds.
#[derive(Clone, Copy, Debug, Default, Serialize)]
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
#[derive(Debug, Serialize)]
pub struct Summary<'a> {
    /// `ok`, or the kind of failure.
    pub status: &'a str,
    /// Its message.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    title: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    scenario_sha256: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    system_sha256: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    irregularity_seed: Option<u64>,
    versions: Versions,
    step_s: f64,
    substeps: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    step_choice: Option<&'a Choice>,
    end_s: f64,
    reached_s: f64,
    iterations: &'a Iterations,
    coupling: CouplingReport,
    seconds: Seconds,
    times_faster_than_real_time: f64,
    warnings: &'a [String],
    contact_losses: Vec<ContactLoss>,
    peaks: Vec<Peak>,
}

#[derive(Debug, Serialize)]
struct Versions {
    ttb: &'static str,
    fmi: &'static str,
}

impl<'a> Summary<'a> {
    /// Of a run that reached `reached` seconds.
    pub fn new(
        job: &'a Job,
        outcome: &'a Result<(), Error>,
        reached: f64,
        iterations: &'a Iterations,
        coupling: CouplingReport,
        seconds: Seconds,
        warnings: &'a [String],
        peaks: &'a Peaks,
    ) -> Self {
        let (scenario_sha256, system_sha256) = match &job.origin {
            Origin::Scenario(hash) => (Some(hash.as_str()), None),
            Origin::System(hash) => (None, Some(hash.as_str())),
        };
        Self {
            status: outcome.as_ref().map_or_else(Error::status, |()| "ok"),
            error: outcome.as_ref().err().map(ToString::to_string),
            title: &job.case.title,
            scenario_sha256,
            system_sha256,
            irregularity_seed: job.irregularity_seed,
            versions: Versions { ttb: env!("CARGO_PKG_VERSION"), fmi: "2.0" },
            step_s: job.case.step,
            substeps: job.case.substeps,
            step_choice: job.choice.as_ref(),
            end_s: job.case.end,
            reached_s: reached,
            iterations,
            coupling,
            seconds,
            times_faster_than_real_time: if seconds.stepping > 0.0 { reached / seconds.stepping } else { 0.0 },
            warnings,
            contact_losses: peaks.contact_losses(),
            peaks: told(peaks, job.choice.as_ref()),
        }
    }

    /// Writes summary.json.
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        let text =
            serde_json::to_string_pretty(self).map_err(|e| Error::Io { path: path.to_path_buf(), source: e.into() })?;
        std::fs::write(path, text + "\n").map_err(Error::io(path))
    }

    /// A short summary for people.
    pub fn print(&self, folder: &Path) {
        say!("{}", self.title);
        let (i, s) = (self.iterations, self.seconds);
        let parts = match self.substeps {
            1 => String::new(),
            m => format!(" (train and track {m} a step)"),
        };
        say!("  {} steps of {} s{parts} to t = {} s: {}", i.steps, self.step_s, self.reached_s, self.status);
        say!("  iterations      mean {:.2}, max {}, residual ≤ {:.1e}", i.mean, i.max, i.max_residual);
        self.coupling.print();
        say!(
            "  seconds         {:.2} stepping ({:.1} × real time): train–track {:.2}, bridge {:.2}, master {:.3}, results {:.2}; start {:.2}",
            s.stepping,
            self.times_faster_than_real_time,
            s.train_track,
            s.bridge,
            s.master,
            s.recording,
            s.initialization
        );
        if i.not_converged > 0 {
            say!("  NOT CONVERGED   {} of {} steps were accepted all the same", i.not_converged, i.steps);
        }
        let columns: Vec<Column> = self.peaks.iter().map(|peak| Column::parse(&peak.name, &peak.unit)).collect();
        let at_points = self.peaks.iter().zip(&columns).filter(|(_, column)| column.of.kind() == Kind::Point);
        for (peak, _) in at_points {
            let (factor, unit) = readable(&peak.unit);
            let (low, high) = (&peak.min, &peak.max);
            say!(
                "  {:<34} {:>10.4} … {:<10.4} {unit}, at t = {:.3} s and {:.3} s",
                peak.name,
                low.value * factor,
                high.value * factor,
                low.time,
                high.time
            );
        }
        self.print_over(&columns, Kind::Car, &Quantity::Acceleration, "car bodies, acceleration");
        self.print_over(&columns, Kind::Wheel, &Quantity::ContactForce, "wheelsets, contact force");
        for loss in &self.contact_losses {
            say!(
                "  wheel {} lost contact {} times, {:.4} s in all, {:.4} s at most",
                loss.wheel,
                loss.intervals,
                loss.seconds,
                loss.longest
            );
        }
        say!("  results in {}", folder.display());
    }

    /// Extremes over all variables of a kind.
    fn print_over(&self, columns: &[Column], kind: Kind, quantity: &Quantity, text: &str) {
        let own = self.peaks.iter().zip(columns).filter(|(_, column)| column.is(kind, quantity));
        let of_kind = || own.clone().map(|(peak, _)| peak);
        let low = of_kind().min_by(|a, b| a.min.value.total_cmp(&b.min.value));
        let high = of_kind().max_by(|a, b| a.max.value.total_cmp(&b.max.value));
        if let (Some(low), Some(high)) = (low, high) {
            let (factor, unit) = readable(&low.unit);
            let (a, b) = (low.min.value * factor, high.max.value * factor);
            say!("  {text:<34} {a:>10.4} … {b:<10.4} {unit}, at {} and {}", low.name, high.name);
        }
    }
}

/// Factor and name of the unit people read.
fn readable(unit: &str) -> (f64, &str) {
    match unit {
        "m" => (1e3, "mm"),
        "N" => (1e-3, "kN"),
        "N.m" => (1e-3, "kN.m"),
        "m/s2" => (1.0, "m/s²"),
        other => (1.0, other),
    }
}
