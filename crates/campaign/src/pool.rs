//! Workers: threads that take batches of runs and write each result into the journal.
//!
//! The order in which runs end leaves no trace: each has a file of its own.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::compute::{self, Compute, Computed};
use crate::error::Error;
use crate::journal::Journal;
use crate::plan::Run;

/// What workers have done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// Runs that ended, failed ones too.
    pub done: usize,
    /// Runs that failed.
    pub failed: usize,
    /// Bytes written into the journal.
    pub bytes: u64,
}

/// Computes `runs` with a number of workers. `tell` hears of every batch. After `stop` was set no further run begins.
///
/// # Errors
/// The journal cannot be written; the other workers leave off.
pub fn compute(
    with: &dyn Compute,
    runs: &[Run],
    workers: usize,
    journal: &Journal,
    stop: &AtomicBool,
    tell: &(dyn Fn(Progress) + Sync),
) -> Result<Progress, Error> {
    let parts = compute::parts(with, runs, with.batch(runs.len(), workers.max(1)));
    let (next, ended, failure) = (AtomicUsize::new(0), Mutex::new(Progress::default()), Mutex::new(None));
    let leave = AtomicBool::new(false);
    let work = || {
        loop {
            let part = parts.get(next.fetch_add(1, Ordering::Relaxed));
            let Some(part) = part.filter(|_| !stop.load(Ordering::Relaxed) && !leave.load(Ordering::Relaxed)) else {
                return;
            };
            for computed in with.compute(part, stop) {
                let Computed::Done(record) = computed else { continue };
                let record = record.finite();
                match journal.write(&record) {
                    Ok(bytes) => {
                        let mut progress = locked(&ended);
                        progress.done += 1;
                        progress.failed += usize::from(record.error.is_some());
                        progress.bytes += bytes;
                    }
                    Err(error) => {
                        locked(&failure).get_or_insert(error);
                        leave.store(true, Ordering::Relaxed);
                        return;
                    }
                }
            }
            let progress = *locked(&ended);
            tell(progress);
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..workers {
            scope.spawn(work);
        }
        work();
    });
    match failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(error) => Err(error),
        None => Ok(ended.into_inner().unwrap_or_else(PoisonError::into_inner)),
    }
}

/// Numbers and an error: nothing that a panic elsewhere could leave half-done.
fn locked<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
