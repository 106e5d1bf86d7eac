//! The loop over the steps of a run, for whatever takes steps.

use crate::course::Course;
use crate::error::RunError;
use crate::observe::Observer;
use crate::stepping::{Ended, Plan, Stepping};

/// Takes all steps ([`Course`] has them one by one). Once the system has started and trial steps do not speak against the run,
/// the observers see the begin, every accepted step in their order, and the end, which comes whatever happened.
///
/// # Errors
/// Why the run could not go on: all steps before were seen. If the run itself went well, the first observer that failed at
/// the end.
pub fn drive(system: &mut dyn Stepping, plan: &Plan, observers: &mut [&mut dyn Observer]) -> Result<Ended, RunError> {
    let mut course = Course::start(system, plan, observers)?;
    while !course.is_over() {
        course.step(system, plan, observers);
    }
    course.end(observers)
}
