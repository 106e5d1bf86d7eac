//! The loop over the steps of a run, for whatever takes steps.
//!
//! ```text
//! start;  read row 0                        static equilibrium
//! rehearse                                  trial steps, undone
//! observers: begin, row 0                   what is refused before leaves nothing behind
//! for n = 0 … N−1
//!   step [t_n, t_{n+1}];  read row n+1;  observers        t_n = n h, never summed up
//! end;  observers
//! ```

use std::ops::ControlFlow;

use ttb_coupling::StepInfo;

use crate::axis::TimeAxis;
use crate::column::Column;
use crate::error::RunError;
use crate::observe::{Begin, Moment, Observer, Timing};

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

/// Takes all steps. Once the system has started and trial steps do not speak against the run, the observers see the begin, every
/// accepted step in their order, and the end, which comes whatever happened.
///
/// # Errors
/// Why the run could not go on: all steps before were seen. If the run itself went well, the first observer that failed at
/// the end.
pub fn drive(system: &mut dyn Stepping, plan: &Plan, observers: &mut [&mut dyn Observer]) -> Result<Ended, RunError> {
    let columns = system.columns(plan.wanted);
    let (axis, clock) = (&plan.axis, plan.clock);
    let mut row = vec![0.0; columns.len()];
    let begun = clock();
    system.start()?;
    system.read(&mut row)?;
    let at = clock();
    system.rehearse(axis)?;
    let begin = Begin { columns: &columns, axis };
    let outcome = observers.iter_mut().try_for_each(|observer| observer.start(&begin));
    let timing = Timing { wall: at - begun, inside: [0.0; 2], at };
    let outcome = outcome.and_then(|()| steps(system, plan, row, timing, observers));
    let mut failed = Ok(());
    for observer in observers.iter_mut() {
        failed = failed.and(observer.end());
    }
    outcome.and_then(|ended| failed.map(|()| ended))
}

fn steps(
    system: &mut dyn Stepping,
    plan: &Plan,
    mut row: Vec<f64>,
    timing: Timing,
    observers: &mut [&mut dyn Observer],
) -> Result<Ended, RunError> {
    let (axis, clock) = (&plan.axis, plan.clock);
    if show(observers, &Moment { n: 0, t: axis.time(0), h: 0.0, row: &row, info: None, timing })?.is_break() {
        return Ok(Ended::Stopped);
    }
    for n in 0..axis.steps() {
        let (t, h) = (axis.time(n), axis.size(n));
        let (begun, before) = (clock(), system.inside());
        let info = system.step(t, h)?;
        let (at, after) = (clock(), system.inside());
        let timing = Timing { wall: at - begun, inside: [after[0] - before[0], after[1] - before[1]], at };
        system.read(&mut row)?;
        let moment = Moment { n: n + 1, t: axis.time(n + 1), h, row: &row, info: Some(&info), timing };
        if show(observers, &moment)?.is_break() {
            return Ok(Ended::Stopped);
        }
    }
    Ok(Ended::Complete)
}

/// Every observer sees the step, also when one of them ends the run.
fn show(observers: &mut [&mut dyn Observer], moment: &Moment) -> Result<ControlFlow<()>, RunError> {
    let mut flow = ControlFlow::Continue(());
    for observer in observers {
        if observer.step(moment)?.is_break() {
            flow = ControlFlow::Break(());
        }
    }
    Ok(flow)
}
