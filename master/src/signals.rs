//! Ends that come from outside: Ctrl-C, a request to end, a terminal that has gone.
//!
//! ```text
//! first signal    where results can be kept ([`Stop::gently`]): noticed after the step at hand; elsewhere the end
//! second signal   the end, at once
//! ```
//!
//! The same signal within a second is still the first: a terminal tells all its processes, and one that has started this
//! program passes it on. An end at once leaves no temporary folder either. A signal that was ignored when the program began
//! (`nohup`) stays so.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use ttb_fmi::leave;

use crate::parts::abandon;

/// Numbers that all Unix systems share; on Windows they stand for a console that closes, Ctrl-C and Ctrl-Break.
const SIGHUP: i32 = 1;
const SIGINT: i32 = 2;
const SIGTERM: i32 = 15;

/// For so long the first signal, heard again, is the same request.
const PASSED_ON: Duration = Duration::from_secs(1);

/// A signal that ends the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signal(i32);

impl Signal {
    /// As in manuals.
    pub fn name(self) -> &'static str {
        match self.0 {
            SIGINT => "SIGINT",
            SIGTERM => "SIGTERM",
            SIGHUP => "SIGHUP",
            _ => "a signal",
        }
    }

    /// Exit code of a program that it ended: 128 + its number.
    pub fn code(self) -> u8 {
        128 + self.0 as u8
    }
}

/// What has been asked from outside.
#[derive(Clone, Debug, Default)]
pub struct Stop {
    asked: Arc<AtomicI32>,
    first: Arc<OnceLock<(i32, Instant)>>,
    flag: Arc<AtomicBool>,
    ending: Arc<AtomicBool>,
    gentle: Arc<AtomicBool>,
    removed: Arc<Mutex<Vec<PathBuf>>>,
}

impl Stop {
    /// Watches for signals from now on, in a thread of its own.
    pub fn watch() -> Self {
        let stop = Self::default();
        let seen = stop.clone();
        // Without a handler a signal ends the program at once: no reason not to run.
        if let Err(error) = watch(move |signal| seen.take(signal)) {
            note!("ttb: warning: Ctrl-C will not keep results: {error}");
        }
        stop
    }

    fn take(&self, signal: i32) {
        let mut is_first = false;
        let (first, since) = *self.first.get_or_init(|| {
            is_first = true;
            (signal, Instant::now())
        });
        if !is_first && first == signal && since.elapsed() < PASSED_ON {
            return;
        }
        self.asked.store(signal, Ordering::Relaxed);
        self.flag.store(true, Ordering::Relaxed);
        if !(is_first && self.gentle.load(Ordering::Relaxed)) {
            self.ending.store(true, Ordering::SeqCst);
            // Both are held until the end: nothing is made any more.
            let _parts = abandon();
            let removed = self.removed.lock().unwrap_or_else(PoisonError::into_inner);
            for path in removed.iter() {
                // A folder goes only if it is empty.
                let _ = std::fs::remove_file(path).or_else(|_| std::fs::remove_dir(path));
            }
            leave(Signal(signal).code());
        }
    }

    /// Makes something, and keeps the paths that `make` gives with it: files, or folders that may be empty, which are removed
    /// at an end at once. An end at once in the meantime waits.
    ///
    /// # Errors
    /// That of `make`.
    pub fn removes<T, E>(&self, make: impl FnOnce() -> Result<(T, Vec<PathBuf>), E>) -> Result<T, E> {
        let mut removed = self.removed.lock().unwrap_or_else(PoisonError::into_inner);
        let (made, paths) = make()?;
        removed.extend(paths);
        Ok(made)
    }

    /// From now on a first signal is only noted: who calls this looks at [`Stop::asked`] between steps.
    pub fn gently(&self) {
        self.gentle.store(true, Ordering::Relaxed);
    }

    /// Comes back unless the end at once has begun: it removes files under a command's hands, and a command that fails for that
    /// reason alone has no error to tell.
    pub fn unless_ending(&self) {
        while self.ending.load(Ordering::SeqCst) {
            std::thread::park();
        }
    }

    /// Set once a signal has asked for the end.
    pub fn flag(&self) -> &AtomicBool {
        &self.flag
    }

    /// The signal that has asked for the end.
    pub fn asked(&self) -> Option<Signal> {
        Some(self.asked.load(Ordering::Relaxed)).filter(|signal| *signal != 0).map(Signal)
    }
}

/// Calls `hear` with every signal from now on.
#[cfg(windows)]
use ttb_fmi::platform::watch_requests_to_end as watch;

/// Calls `hear` with every signal from now on, in a thread of its own.
#[cfg(unix)]
fn watch(hear: impl Fn(i32) + Send + 'static) -> std::io::Result<()> {
    let watched = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| !is_ignored(*signal));
    let mut signals = signal_hook::iterator::Signals::new(watched)?;
    std::thread::spawn(move || signals.forever().for_each(hear));
    Ok(())
}

/// Whether the program was begun with a signal ignored, as the kernel tells: a mask of bits, signal 1 the lowest.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (signal - 1) & 1 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_first_signal_is_noted_and_has_the_code_of_a_program_that_it_ended() {
        let stop = Stop::default();
        assert_eq!(stop.asked(), None);
        stop.gently();
        stop.take(SIGTERM);
        // Passed on by somebody: it ends nothing, or this test would end here.
        stop.take(SIGTERM);
        let signal = stop.asked().unwrap();
        assert_eq!((signal.name(), signal.code()), ("SIGTERM", 143));
        assert_eq!((Signal(SIGHUP).code(), Signal(SIGINT).code()), (129, 130));
    }
}
