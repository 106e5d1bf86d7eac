//! Several runs abreast: the first step of all, the second of all, and so on, so that what they share is done once for all.

use crate::course::Course;
use crate::error::RunError;
use crate::observe::Observer;
use crate::stepping::{Ended, Plan, Stepping};

/// A run among others.
pub struct Run<'a, 'b, S> {
    /// What takes its steps.
    pub system: &'a mut S,
    /// Its steps, which may be other ones than those of its neighbours, and more or fewer.
    pub plan: &'a Plan<'a>,
    /// Those who look on.
    pub observers: Vec<&'b mut dyn Observer>,
}

/// Takes all steps of all runs, as [`crate::drive()`] does of one. Before the next step of the runs that are not over yet, the
/// first one too, `between` gets them. A run that fails leaves the others as they are. One result a run, in their order.
pub fn drive_abreast<S: Stepping>(
    runs: &mut [Run<'_, '_, S>],
    between: &mut dyn FnMut(&mut [&mut S]),
) -> Vec<Result<Ended, RunError>> {
    let mut courses: Vec<Result<Course, RunError>> =
        runs.iter_mut().map(|run| Course::start(run.system, run.plan, &mut run.observers)).collect();
    let going = |course: &Result<Course, RunError>| course.as_ref().is_ok_and(|course| !course.is_over());
    while courses.iter().any(going) {
        let here = runs.iter_mut().zip(&courses).filter(|(_, course)| going(course));
        let mut systems: Vec<&mut S> = here.map(|(run, _)| &mut *run.system).collect();
        between(&mut systems);
        for (run, course) in runs.iter_mut().zip(&mut courses) {
            if let Ok(course) = course {
                course.step(run.system, run.plan, &mut run.observers);
            }
        }
    }
    courses
        .into_iter()
        .zip(runs)
        .map(|(course, run)| course.and_then(|course| course.end(&mut run.observers)))
        .collect()
}
