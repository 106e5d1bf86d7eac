//! Sleeping until a word in shared memory changes, and waking who sleeps there: two events, since Windows wakes by address within
//! one process only.

use super::api::{self, Owned};
use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicU32;
use std::time::Duration;

/// An event for each process, rung when it has changed its word.
#[derive(Clone)]
pub struct Bells {
    events: Arc<[Owned; 2]>,
}

impl Bells {
    /// New ones.
    pub fn create(name: &str) -> io::Result<Self> {
        // SAFETY: a name that ends with a zero; an event that one waiter takes.
        Self::both(name, |name| unsafe { api::CreateEventW(std::ptr::null(), 0, 0, name) })
    }

    /// Those that another process has made.
    pub fn open(name: &str) -> io::Result<Self> {
        // SAFETY: a name that ends with a zero.
        Self::both(name, |name| unsafe { api::OpenEventW(api::EVENT_ALL_ACCESS, 0, name) })
    }

    fn both(name: &str, event: impl Fn(*const u16) -> api::Handle) -> io::Result<Self> {
        let one = |i: u8| Owned::new(event(api::wide(&format!("{name}-{i}")).as_ptr()));
        Ok(Self { events: Arc::new([one(0)?, one(1)?]) })
    }

    /// Sleeps while the word of a process is `seen`, no longer than `limit`. It may also return early: the caller looks at the
    /// word.
    pub fn wait(&self, of_master: bool, _word: &AtomicU32, _seen: u32, limit: Option<Duration>) {
        // Whoever changed the word after it was seen has rung, or rings: the event stays set until somebody takes it.
        let limit = limit.map_or(api::INFINITE, |limit| limit.as_millis().clamp(1, 1 << 30) as u32);
        // SAFETY: an open event.
        unsafe { api::WaitForSingleObject(self.events[usize::from(of_master)].0, limit) };
    }

    /// Wakes the process that sleeps on the word, if it does.
    pub fn wake(&self, of_master: bool, _word: &AtomicU32) {
        // SAFETY: an open event.
        unsafe { api::SetEvent(self.events[usize::from(of_master)].0) };
    }
}
