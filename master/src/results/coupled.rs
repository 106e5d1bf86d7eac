//! What the summary says of the coupling: its strength, the method that dealt with it, the error where it was not iterated.

use schemars::JsonSchema;
use serde::Serialize;
use ttb_coupling::probe::Probe;
use ttb_coupling::report::{Report, Returned, Side, Source};
use ttb_coupling::{Coupling, Method};

/// How strongly the two are coupled, and by what method that was dealt with.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct CouplingReport {
    /// The method in force at the end: what `auto` has picked.
    pub method: &'static str,
    /// ρ at the start, the contraction of the plain fixed point; absent if it could not be measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contraction_at_start: Option<f64>,
    /// Trials spent on ρ and on a model of the interface, in no step's count.
    pub identification_trials: usize,
    /// Where Newton's model came from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<&'static str>,
    /// Methods that took over in the course of the run, and when.
    pub switches: Vec<Switch>,
    /// Steps without iteration: largest force that was missing at the end of a step, relative to all forces: an estimate, no
    /// bound, of the relative error of displacements. Errors of many steps may add up.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_estimate: Option<f64>,
    /// The same of accelerations of the deck, m/s²: as far as the missing force can accelerate it. Absent if the bridge
    /// could not be asked how far that is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub acceleration_error_estimate: Option<f64>,
    /// Work at the interface; absent where it is not known which force moves along which displacement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub work: Option<WorkReport>,
    /// What trial steps before the run showed.
    pub probe: ProbeReport,
}

/// Work that was made or lost at the interface, all steps together.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct WorkReport {
    /// J: what the bridge received.
    pub received: f64,
    /// What train and track gave beyond it, relative to the work of all supports counted as amounts.
    pub imbalance: f64,
    /// The part of it that the exchange makes, whatever the tolerance of the iteration.
    pub exchange_imbalance: f64,
}

/// What trial steps before the run showed; empty where none could be made.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct ProbeReport {
    /// By how much a step of every bridge repeated from a saved state differs, relative to what other forces change.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bridge_repeats_to: Vec<f64>,
    /// The same of the train–track side.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub train_track_repeats_to: Option<f64>,
    /// Of every bridge: the mass a support whose displacement, and whose velocity, would be that of the trial, kg.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub mass_per_support: Vec<[f64; 2]>,
}

impl From<&Probe> for ProbeReport {
    fn from(probe: &Probe) -> Self {
        let mass_per_support = probe.responses.iter().map(|response| response.mass).collect();
        Self { bridge_repeats_to: probe.bridge.clone(), train_track_repeats_to: probe.train_track, mass_per_support }
    }
}

/// A change of method.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Switch {
    /// From when on, s.
    pub time: f64,
    /// What is in force.
    pub method: &'static str,
}

/// A side that came back nearly to its state, in words.
pub fn returned(report: &Report) -> Option<String> {
    let Returned { t, side, difference } = report.returned?;
    let (of, without) = match side {
        Side::Bridge => ("a tenth of an axle load", "; \"roll_back\": false in the bridge's map (--map) does without"),
        Side::TrainTrack => ("0.01 mm of the deck's motion", ""),
    };
    Some(format!(
        "{side} does not quite come back to the state it saved: at t = {t} s a step from the restored state differs by \
         {difference:.1e} of what {of} changes, and so may every step{without}"
    ))
}

/// How far a run without iteration may be off, in words. One digit is what an estimate has; runs that are alike say the same.
pub fn not_iterated(report: &Report) -> Option<String> {
    let displacements = report.explicit?;
    let accelerations = report.explicit_acceleration;
    let accelerations = accelerations.map_or_else(
        || "of accelerations of the deck nothing is known".to_string(),
        |error| format!("accelerations of the deck by about {error:.0e} m/s²"),
    );
    Some(format!("without iteration displacements are off by about {displacements:.0e}, {accelerations}"))
}

impl CouplingReport {
    /// What the coupling knows at the end of a run.
    pub fn new(coupling: &Coupling, probe: &Probe) -> Self {
        let report = coupling.report();
        let switches = report.switches.iter().map(|(time, method)| Switch { time: *time, method: method.name() });
        let (explicit, work) = (report.explicit, report.work);
        Self {
            method: if explicit.is_some() { Method::Explicit.name() } else { coupling.method().name() },
            contraction_at_start: report.contraction,
            identification_trials: report.identification_trials,
            model: report.model.map(|source| match source {
                Source::Derivatives => "directional derivatives",
                Source::Trials => "trials",
            }),
            switches: switches.collect(),
            error_estimate: explicit,
            acceleration_error_estimate: report.explicit_acceleration,
            work: (work.turnover > 0.0).then(|| WorkReport {
                received: work.received,
                imbalance: work.imbalance(),
                exchange_imbalance: work.exchange_imbalance(),
            }),
            probe: probe.into(),
        }
    }

    /// A few lines for people.
    pub fn print(&self) {
        let rho = self.contraction_at_start.map_or_else(|| "unknown".into(), |rho| format!("{rho:.3}"));
        let model = self.model.map_or_else(String::new, |model| format!(", model by {model}"));
        say!("  coupling        {}{model}; ρ at the start {rho}", self.method);
        if let Some(error) = self.error_estimate {
            let accelerations = self.acceleration_error_estimate.map_or_else(
                || "accelerations may be further off".to_string(),
                |error| format!("accelerations of the deck by about {error:.1e} m/s²"),
            );
            say!(
                "  NOT ITERATED    the bridge cannot roll back; displacements are off by about {error:.1e}, {accelerations}"
            );
        }
        if let Some(WorkReport { imbalance, exchange_imbalance, .. }) = self.work {
            say!("  interface work  imbalance {imbalance:.1e}, of which the exchange makes {exchange_imbalance:.1e}");
        }
    }
}
