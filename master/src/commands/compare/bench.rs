//! What all rows of the table share, and how one is stepped.

use std::ops::ControlFlow;

use ttb_scenario::Checked;
use ttb_session::observe::{Begin, Moment, Observer};
use ttb_session::{Column, Plan, RunError, Stepping, TimeAxis, drive};

use crate::clock::cpu;
use crate::commands::progress::progress_bar;
use crate::error::Error;
use crate::results::ran::{Ran, Watched};
use crate::signals::Stop;

/// What all rows share.
pub struct Bench<'a> {
    /// The case.
    pub checked: &'a Checked,
    /// What is compared.
    pub watched: Watched,
    /// CPU seconds a row may take.
    pub budget: f64,
    /// What is asked from outside.
    pub stop: &'a Stop,
    /// No progress.
    pub quiet: bool,
}

impl Bench<'_> {
    /// Steps a method over an axis and fills in its row. A step that fails ends the row and stands in it.
    pub fn step(&self, system: &mut dyn Stepping, axis: TimeAxis, ran: &mut Ran) -> Result<(), Error> {
        let bar = progress_bar(axis.steps(), self.quiet).with_prefix(format!("{:<24} ", ran.method));
        let mut tell = |n| bar.set_position(n);
        let watch = &mut Watch { bench: self, ran, columns: Vec::new(), tell: &mut tell, begun: cpu() };
        let wanted = |column: &Column| self.watched.which(column).is_some();
        let plan = Plan { axis, wanted: &wanted, clock: &cpu };
        let ended = drive(system, &plan, &mut [watch]);
        bar.finish_and_clear();
        ran.failure = match ended {
            Ok(_) => None,
            // Which method failed stands beside it in the table.
            Err(RunError::Subsystem(failure)) => Some(failure.message),
            Err(RunError::Iteration(error)) => Some(error.to_string()),
            Err(other) => return Err(other.into()),
        };
        Ok(())
    }
}

/// Keeps the histories that are compared, and ends a row whose time is over.
struct Watch<'a, 'b> {
    bench: &'a Bench<'b>,
    ran: &'a mut Ran,
    /// Which history each column is.
    columns: Vec<usize>,
    tell: &'a mut dyn FnMut(u64),
    /// CPU seconds at the end of the start.
    begun: f64,
}

impl Observer for Watch<'_, '_> {
    fn start(&mut self, begin: &Begin) -> Result<(), RunError> {
        self.columns = begin.columns.iter().filter_map(|column| self.bench.watched.which(column)).collect();
        Ok(())
    }

    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        self.ran.time.push(moment.t);
        for (which, value) in self.columns.iter().zip(moment.row) {
            self.ran.histories[*which].push(*value);
        }
        let Some(info) = moment.info else {
            self.ran.preparation += cpu() - self.begun;
            self.begun = cpu();
            return Ok(ControlFlow::Continue(()));
        };
        self.ran.taken = moment.n;
        self.ran.iterations += info.iterations as u64;
        (self.tell)(moment.n);
        self.ran.stepping = cpu() - self.begun;
        let over = self.ran.stepping > self.bench.budget || self.bench.stop.asked().is_some();
        Ok(if over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}
