//! What is driven: something that takes steps, the steps, and how a run can end.

use ttb_coupling::StepInfo;

use crate::axis::TimeAxis;
use crate::column::Column;
use crate::error::RunError;

/// Something that takes steps and has outputs: two coupled subsystems, or another method for the same case.
pub trait Stepping {
    /// Chooses the outputs that are read, those that are `wanted`, and tells them in their order.
    fn columns(&mut self, wanted: &dyn Fn(&Column) -> bool) -> Vec<Column>;

    /// From the data to the state that the first step starts from.
    ///
    /// # Errors
    /// There is no such state.
    fn start(&mut self) -> Result<(), RunError>;

    /// Trial steps after the start, undone again, that may speak against the run.
    ///
    /// # Errors
    /// They do.
    fn rehearse(&mut self, _axis: &TimeAxis) -> Result<(), RunError> {
        Ok(())
    }

    /// One step of `h` seconds from t.
    ///
    /// # Errors
    /// It cannot be done.
    fn step(&mut self, t: f64, h: f64) -> Result<StepInfo, RunError>;

    /// Reads the outputs that were chosen.
    ///
    /// # Errors
    /// A subsystem refuses.
    fn read(&mut self, row: &mut [f64]) -> Result<(), RunError>;

    /// Seconds spent so far inside the train–track side and inside the bridge, where that is measured.
    fn inside(&self) -> [f64; 2] {
        [0.0; 2]
    }
}

/// What is driven how.
pub struct Plan<'a> {
    /// The steps.
    pub axis: TimeAxis,
    /// Which outputs are read.
    pub wanted: &'a dyn Fn(&Column) -> bool,
    /// Seconds since any moment, by a clock that never goes back.
    pub clock: &'a dyn Fn() -> f64,
}

/// How a run came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// All steps were taken.
    Complete,
    /// An observer ended it after a step.
    Stopped,
}
