//! What computes runs: the seam behind which the ways are.

use std::sync::atomic::AtomicBool;

use crate::plan::Run;
use crate::record::Record;

/// How the computing of a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Computed {
    /// With results, or with a failure that would come again.
    Done(Record),
    /// It was asked to stop before the end; the run is as if it had never begun.
    Stopped,
}

/// Something that computes runs of a plan. The result of a run must not depend on which others are computed with it.
pub trait Compute: Sync {
    /// How many runs a call takes best, of so many that a number of workers share.
    fn batch(&self, _runs: usize, _workers: usize) -> usize {
        1
    }

    /// Puts runs into the order in which they cost least together; the results do not depend on it.
    fn arrange(&self, _runs: &mut [Run]) {}

    /// Computes runs: one answer each, in their order. `stop` asks to leave off; whoever looks at it does so between steps.
    fn compute(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed>;
}

/// At most so many runs a batch, and so few that all workers end at about the same time.
pub fn small(most: usize, runs: usize, workers: usize) -> usize {
    most.min(runs.div_ceil(4 * workers))
}
