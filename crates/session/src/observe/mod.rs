//! Those who look on while steps are taken: results as a table in memory, as CSV, as extremes; iterations counted; time spent.

mod chosen;
mod csv;
mod iterations;
mod only;
mod peaks;
mod progress;
mod table;
mod timing;

use std::ops::ControlFlow;

use ttb_coupling::StepInfo;

pub use csv::{IterationsCsv, ResultsCsv};
pub use iterations::Iterations;
pub use only::Only;
pub use peaks::{ContactLoss, Extreme, Peak, Peaks};
pub use progress::Progress;
pub use table::Table;
pub use timing::{Timed, Timing};

use crate::axis::TimeAxis;
use crate::column::Column;
use crate::error::RunError;

/// What is known before the first step.
pub struct Begin<'a> {
    /// The columns of every row to come.
    pub columns: &'a [Column],
    /// The steps to come.
    pub axis: &'a TimeAxis,
}

/// The state at the start (`n` = 0) or after a step.
pub struct Moment<'a> {
    /// Number of the step, from 1.
    pub n: u64,
    /// Its end, s.
    pub t: f64,
    /// Its size, s; 0 at the start.
    pub h: f64,
    /// The outputs, in the order of the columns.
    pub row: &'a [f64],
    /// How the step went; none at the start.
    pub info: Option<&'a StepInfo>,
    /// What it took.
    pub timing: Timing,
}

/// Somebody who looks on.
pub trait Observer {
    /// Before the start.
    ///
    /// # Errors
    /// It cannot observe.
    fn start(&mut self, _begin: &Begin) -> Result<(), RunError> {
        Ok(())
    }

    /// At the start and after every accepted step; may end the run.
    ///
    /// # Errors
    /// It cannot keep what it saw.
    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError>;

    /// After the last step, whatever ended the run.
    ///
    /// # Errors
    /// It cannot keep what it saw.
    fn end(&mut self) -> Result<(), RunError> {
        Ok(())
    }
}

/// Lets the run go on.
pub const GO_ON: Result<ControlFlow<()>, RunError> = Ok(ControlFlow::Continue(()));
