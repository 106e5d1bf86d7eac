//! Which computations go on: a page tells that it is still there; without that, after a while, its computations are left off.

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// So long nothing need be heard of a page: browsers let hidden tabs speak once a minute.
const PATIENCE: Duration = Duration::from_secs(150);

/// Computations that go on.
#[derive(Default)]
pub struct Jobs(Mutex<HashMap<String, Job>>);

struct Job {
    stop: Arc<AtomicBool>,
    heard: Instant,
    /// Calls that compute for it now.
    calls: usize,
}

impl Jobs {
    /// A call of a job begins; what it gets asks to leave off. A job without a name cannot be left off.
    pub fn begin(&self, name: &str) -> Arc<AtomicBool> {
        if name.is_empty() {
            return Arc::default();
        }
        let (mut jobs, heard) = (self.jobs(), Instant::now());
        let job = jobs.entry(name.into()).or_insert_with(|| Job { stop: Arc::default(), heard, calls: 0 });
        (job.heard, job.calls) = (heard, job.calls + 1);
        Arc::clone(&job.stop)
    }

    /// A call of a job has ended.
    pub fn end(&self, name: &str) {
        let mut jobs = self.jobs();
        if let Some(job) = jobs.get_mut(name) {
            job.calls -= 1;
            if job.calls == 0 {
                jobs.remove(name);
            }
        }
    }

    /// The page of a job is still there.
    pub fn hear(&self, name: &str) {
        if let Some(job) = self.jobs().get_mut(name) {
            job.heard = Instant::now();
        }
    }

    /// Leaves a job off.
    pub fn leave(&self, name: &str) {
        if let Some(job) = self.jobs().get(name) {
            job.stop.store(true, Ordering::Relaxed);
        }
    }

    /// Leaves off all jobs, or those of pages of which nothing was heard for long.
    pub fn sweep(&self, all: bool) {
        for job in self.jobs().values() {
            if all || job.heard.elapsed() > PATIENCE {
                job.stop.store(true, Ordering::Relaxed);
            }
        }
    }

    /// Every change is whole: a panic elsewhere leaves nothing half-done.
    fn jobs(&self) -> std::sync::MutexGuard<'_, HashMap<String, Job>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_job_is_left_off_by_its_name_and_forgotten_at_its_end() {
        let jobs = Jobs::default();
        let (one, same, other) = (jobs.begin("a"), jobs.begin("a"), jobs.begin("b"));
        jobs.leave("a");
        jobs.leave("nobody");
        let set = |flag: &AtomicBool| flag.load(Ordering::Relaxed);
        assert_eq!((set(&one), set(&same), set(&other)), (true, true, false));
        jobs.sweep(false);
        assert!(!set(&other));
        jobs.sweep(true);
        assert!(set(&other));
        jobs.end("a");
        jobs.end("a");
        jobs.end("a");
        assert!(!set(&jobs.begin("a")));
    }
}
