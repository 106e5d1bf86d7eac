//! What an FMU logs: collected per instance, bounded, from whatever thread it comes.

use crate::types::{Status, fmi2CallbackLogger};
use std::collections::VecDeque;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

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
pub(crate) const KEPT: usize = 200;

/// What the shim calls with its target, the message's status, category and text; the strings may be null.
pub(crate) type Write = unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char);

/// Something whose address may be an instance's `componentEnvironment`.
///
/// # Safety
/// The type is `repr(C)` and its first field is a [`Write`] that can be called with its address from any thread.
pub(crate) unsafe trait LogTarget: std::any::Any + Send + Sync {}

/// Where the messages of one instance end up.
#[repr(C)]
pub(crate) struct Sink {
    write: Write,
    received: AtomicU64,
    kept: Mutex<VecDeque<Message>>,
}

unsafe extern "C" {
    /// The shim in logger.c.
    fn ttb_fmi2_logger(
        sink: *mut c_void,
        name: *const c_char,
        status: c_int,
        category: *const c_char,
        message: *const c_char,
        ...
    );
}

// SAFETY: its first field is `write` below, which locks what it changes.
unsafe impl LogTarget for Sink {}

/// The `logger` for an FMU whose `componentEnvironment` is a [`LogTarget`].
pub(crate) const LOGGER: fmi2CallbackLogger = ttb_fmi2_logger;

impl Sink {
    /// An empty sink, in a place that does not change.
    pub fn new() -> Arc<Self> {
        Arc::new(Self { write, received: AtomicU64::new(0), kept: Mutex::new(VecDeque::new()) })
    }

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

/// Called by the shim.
///
/// # Safety
/// `sink` is the address of a living [`Sink`]; the strings are null or zero-terminated.
unsafe extern "C" fn write(sink: *mut c_void, status: c_int, category: *const c_char, text: *const c_char) {
    let string = |pointer: *const c_char| match pointer.is_null() {
        true => String::new(),
        // SAFETY: not null, and zero-terminated by contract.
        false => unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned(),
    };
    let message = Message { status: Status::from_c(status), category: string(category), text: string(text) };
    // SAFETY: a `Local` keeps its log target until the FMU has freed the instance.
    unsafe { &*sink.cast::<Sink>() }.push(message);
}
