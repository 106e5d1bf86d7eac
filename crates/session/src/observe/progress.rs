//! How far a run is, told now and then, and a way to end it.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::error::RunError;
use crate::observe::{Moment, Observer};

/// Steps between two reports.
const EVERY: u64 = 50;

/// Tells every 50th step, and ends the run after a step once `stop` is set.
pub struct Progress<'a> {
    tell: &'a mut dyn FnMut(u64),
    stop: &'a AtomicBool,
    /// End of the last step that was seen, s.
    pub reached: f64,
}

impl<'a> Progress<'a> {
    /// `tell` gets the number of steps taken.
    pub fn new(tell: &'a mut dyn FnMut(u64), stop: &'a AtomicBool) -> Self {
        Self { tell, stop, reached: 0.0 }
    }
}

impl Observer for Progress<'_> {
    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        self.reached = moment.t;
        if moment.n.is_multiple_of(EVERY) {
            (self.tell)(moment.n);
        }
        Ok(if self.stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}
