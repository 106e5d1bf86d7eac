//! Where the time goes.

use std::ops::ControlFlow;

use crate::error::RunError;
use crate::observe::{GO_ON, Moment, Observer};

/// What a step took, s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// In all; reading and observing excluded.
    pub wall: f64,
    /// Inside the train–track side and inside the bridge.
    pub inside: [f64; 2],
    /// What the clock said at the step's end.
    pub at: f64,
}

/// The steps of a run together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timed {
    /// All steps; `at` is the end of the last one.
    pub steps: Timing,
    /// What the clock said when the first step began; `None` before.
    pub begun: Option<f64>,
}

impl Observer for Timed {
    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        if moment.n > 0 {
            self.begun.get_or_insert(moment.timing.at - moment.timing.wall);
            self.steps.at = moment.timing.at;
            self.steps.wall += moment.timing.wall;
            self.steps.inside[0] += moment.timing.inside[0];
            self.steps.inside[1] += moment.timing.inside[1];
        }
        GO_ON
    }
}
