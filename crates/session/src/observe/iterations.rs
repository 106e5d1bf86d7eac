//! Iterations of a run, counted.

use std::ops::ControlFlow;

use schemars::JsonSchema;
use serde::Serialize;
use ttb_contract::finite::larger;
use ttb_coupling::{Outcome, StepInfo};

use crate::error::RunError;
use crate::observe::{GO_ON, Moment, Observer};

/// Iterations over a run.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct Iterations {
    /// Steps taken.
    pub steps: u64,
    /// Mean number of trials a step.
    pub mean: f64,
    /// Greatest number of trials of a step.
    pub max: usize,
    /// Greatest accepted residual, relative to the support forces or one axle load.
    pub max_residual: f64,
    /// States restored to try again.
    pub roll_backs: u64,
    /// Halvings of a step.
    pub halvings: u64,
    /// Steps accepted without convergence.
    pub not_converged: u64,
    /// Mean number of steps of the train–track FMU a step.
    pub mean_train_track: f64,
    /// Steps that were begun again by quasi-Newton with an empty memory.
    pub rescues: u64,
    /// Steps taken once, without iteration, since the bridge cannot roll back.
    pub explicit: u64,
    #[serde(skip)]
    total: u64,
    #[serde(skip)]
    total_train_track: u64,
}

impl Iterations {
    /// Counts a step.
    fn count(&mut self, info: &StepInfo) {
        self.steps += 1;
        self.total += info.iterations as u64;
        self.mean = self.total as f64 / self.steps as f64;
        self.max = self.max.max(info.iterations);
        self.max_residual = larger(self.max_residual, info.residual);
        self.roll_backs += info.roll_backs as u64;
        self.halvings += info.halvings as u64;
        self.not_converged += u64::from(info.outcome == Outcome::IterationLimit);
        self.total_train_track += info.train_track_trials as u64;
        self.mean_train_track = self.total_train_track as f64 / self.steps as f64;
        self.rescues += info.rescues as u64;
        self.explicit += u64::from(info.outcome == Outcome::Explicit);
    }

    /// Trials of all steps.
    pub fn total(&self) -> u64 {
        self.total
    }
}

impl Observer for Iterations {
    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        if let Some(info) = moment.info {
            self.count(info);
        }
        GO_ON
    }
}
