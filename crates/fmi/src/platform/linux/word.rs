//! Sleeping until a word in shared memory changes, and waking who sleeps there: Linux's futex.

use rustix::fs::Timespec;
use rustix::thread::futex;
use std::sync::atomic::AtomicU32;
use std::time::Duration;

/// What two processes that share words sleep on: the words themselves.
#[derive(Clone)]
pub struct Bells;

impl Bells {
    /// Sleeps while the word of a process is `seen`, no longer than `limit`. It may also return early: the caller looks at the
    /// word.
    pub fn wait(&self, _of_master: bool, word: &AtomicU32, seen: u32, limit: Option<Duration>) {
        let limit = limit.and_then(|limit| Timespec::try_from(limit).ok());
        // Woken, interrupted, too late: all the same, the word decides.
        let _ = futex::wait(word, futex::Flags::empty(), seen, limit.as_ref());
    }

    /// Wakes one process that sleeps on the word, if there is one.
    pub fn wake(&self, _of_master: bool, word: &AtomicU32) {
        // Nobody there to wake is no fault.
        let _ = futex::wake(word, futex::Flags::empty(), 1);
    }
}
