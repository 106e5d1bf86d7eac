//! Where a run is: the steps of a plan, one at a time, so that several runs can go side by side.
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

use crate::error::RunError;
use crate::observe::{Begin, Moment, Observer, Timing};
use crate::stepping::{Ended, Plan, Stepping};

/// Those who look on.
pub type Observers<'a, 'b> = &'a mut [&'b mut dyn Observer];

/// A run between its start and its end.
pub struct Course {
    row: Vec<f64>,
    /// Steps taken.
    n: u64,
    /// How it came to its end, once it has.
    outcome: Option<Result<Ended, RunError>>,
}

impl Course {
    /// Starts the system and shows the observers row 0.
    ///
    /// # Errors
    /// The system does not start; no observer has seen anything. What observers refuse is the outcome of the course.
    pub fn start(system: &mut dyn Stepping, plan: &Plan, observers: Observers) -> Result<Self, RunError> {
        let columns = system.columns(plan.wanted);
        let (axis, clock) = (&plan.axis, plan.clock);
        let mut row = vec![0.0; columns.len()];
        let begun = clock();
        system.start()?;
        system.read(&mut row)?;
        let at = clock();
        system.rehearse(axis)?;
        let begin = Begin { columns: &columns, axis };
        let told = observers.iter_mut().try_for_each(|observer| observer.start(&begin));
        let timing = Timing { wall: at - begun, inside: [0.0; 2], at };
        let moment = Moment { n: 0, t: axis.time(0), h: 0.0, row: &row, info: None, timing };
        let shown = told.and_then(|()| show(observers, &moment));
        let mut course = Self { row, n: 0, outcome: None };
        course.outcome = course.after(shown, plan);
        Ok(course)
    }

    /// Whether no step is left.
    pub fn is_over(&self) -> bool {
        self.outcome.is_some()
    }

    /// Takes the next step, if one is left.
    pub fn step(&mut self, system: &mut dyn Stepping, plan: &Plan, observers: Observers) {
        if !self.is_over() {
            let shown = self.advance(system, plan, observers);
            self.outcome = self.after(shown, plan);
        }
    }

    fn advance(
        &mut self,
        system: &mut dyn Stepping,
        plan: &Plan,
        observers: Observers,
    ) -> Result<ControlFlow<()>, RunError> {
        let (axis, clock) = (&plan.axis, plan.clock);
        let (t, h) = (axis.time(self.n), axis.size(self.n));
        let (begun, before) = (clock(), system.inside());
        let info = system.step(t, h)?;
        let (at, after) = (clock(), system.inside());
        let timing = Timing { wall: at - begun, inside: [after[0] - before[0], after[1] - before[1]], at };
        system.read(&mut self.row)?;
        self.n += 1;
        show(observers, &Moment { n: self.n, t: axis.time(self.n), h, row: &self.row, info: Some(&info), timing })
    }

    fn after(&self, shown: Result<ControlFlow<()>, RunError>, plan: &Plan) -> Option<Result<Ended, RunError>> {
        match shown {
            Err(error) => Some(Err(error)),
            Ok(ControlFlow::Break(())) => Some(Ok(Ended::Stopped)),
            Ok(ControlFlow::Continue(())) => (self.n == plan.axis.steps()).then_some(Ok(Ended::Complete)),
        }
    }

    /// Tells the observers that the run is over.
    ///
    /// # Errors
    /// Why the run could not go on: all steps before were seen. If the run itself went well, the first observer that failed at
    /// the end.
    pub fn end(self, observers: Observers) -> Result<Ended, RunError> {
        let mut failed = Ok(());
        for observer in observers.iter_mut() {
            failed = failed.and(observer.end());
        }
        self.outcome.unwrap_or(Ok(Ended::Stopped)).and_then(|ended| failed.map(|()| ended))
    }
}

/// Every observer sees the step, also when one of them ends the run.
fn show(observers: Observers, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
    let mut flow = ControlFlow::Continue(());
    for observer in observers {
        if observer.step(moment)?.is_break() {
            flow = ControlFlow::Break(());
        }
    }
    Ok(flow)
}
