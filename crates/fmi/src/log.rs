//! What an FMU logs: collected per instance, bounded, from whatever thread it comes.

use crate::status::Status;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// One logged message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// As the FMU rates it.
    pub status: Status,
    /// One of the FMU's log categories.
    pub category: String,
    /// The text, at most 4095 bytes.
    pub text: String,
}

/// Messages kept of an instance; older ones go.
pub const KEPT: usize = 200;

/// Takes what an instance logs, from whatever thread it comes.
pub trait LogTarget: Send + Sync {
    /// One message; category and text are empty where the FMU gave none.
    fn write(&self, status: Status, category: &[u8], text: &[u8]);
}

/// Where the messages of one instance end up.
#[derive(Default)]
pub struct Sink {
    received: AtomicU64,
    kept: Mutex<VecDeque<Message>>,
}

impl LogTarget for Sink {
    fn write(&self, status: Status, category: &[u8], text: &[u8]) {
        let string = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        self.push(Message { status, category: string(category), text: string(text) });
    }
}

impl Sink {
    /// Messages received so far, also those no longer kept.
    pub fn received(&self) -> u64 {
        self.received.load(Ordering::Relaxed)
    }

    /// The kept messages of those received after `mark`; they stay.
    pub fn since(&self, mark: u64) -> Vec<Message> {
        let kept = self.lock();
        let fresh = self.received().saturating_sub(mark) as usize;
        kept.iter().skip(kept.len().saturating_sub(fresh)).cloned().collect()
    }

    /// All kept messages; they go.
    pub fn take(&self) -> Vec<Message> {
        self.lock().drain(..).collect()
    }

    /// A panic elsewhere cannot leave a queue of messages in a bad state.
    fn lock(&self) -> MutexGuard<'_, VecDeque<Message>> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// One more message.
    pub fn push(&self, message: Message) {
        let mut kept = self.lock();
        if kept.len() == KEPT {
            kept.pop_front();
        }
        kept.push_back(message);
        self.received.fetch_add(1, Ordering::Relaxed);
    }
}
