//! What a probed FMU logs, and how badly.

use crate::types::{Status, fmi2CallbackLogger};
use std::collections::VecDeque;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::sync::{Mutex, PoisonError};

/// A call of the logger.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogEntry {
    /// As the FMU rates it.
    pub status: Status,
    /// The text, at most 1023 bytes.
    pub text: String,
    /// What is wrong with the call.
    pub oddities: Vec<&'static str>,
}

/// In the order of the bits logger.c sets.
const ODDITIES: [&str; 4] = [
    "NULL as the name of the instance",
    "NULL as the category",
    "NULL as the message",
    "a message that is no valid printf format",
];

/// Entries kept.
const KEPT: usize = 100;

#[repr(C)]
pub(super) struct Log {
    write: unsafe extern "C" fn(*mut c_void, c_int, c_int, *const c_char),
    entries: Mutex<VecDeque<LogEntry>>,
}

unsafe extern "C" {
    /// The shim in logger.c.
    fn ttb_fmi2_probe_logger(
        log: *mut c_void,
        name: *const c_char,
        status: c_int,
        category: *const c_char,
        message: *const c_char,
        ...
    );
}

pub(super) const LOGGER: fmi2CallbackLogger = ttb_fmi2_probe_logger;

impl Log {
    /// Boxed, since its address must not change.
    pub fn new() -> Box<Self> {
        Box::new(Self { write, entries: Mutex::default() })
    }

    pub fn take(&self) -> Vec<LogEntry> {
        self.entries.lock().unwrap_or_else(PoisonError::into_inner).drain(..).collect()
    }
}

/// Called by the shim.
///
/// # Safety
/// `log` is the address of a living [`Log`]; the text is zero-terminated.
unsafe extern "C" fn write(log: *mut c_void, status: c_int, oddities: c_int, text: *const c_char) {
    // SAFETY: zero-terminated by contract.
    let text = unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned();
    let odd = (0..ODDITIES.len()).filter(|i| oddities >> i & 1 == 1).map(|i| ODDITIES[i]).collect();
    // SAFETY: a Probed keeps its log for the rest of the program.
    let mut entries = unsafe { &*log.cast::<Log>() }.entries.lock().unwrap_or_else(PoisonError::into_inner);
    // The first entries stay, the last one is replaced: a flood shows how it began.
    if entries.len() == KEPT {
        entries.pop_back();
    }
    entries.push_back(LogEntry { status: Status::from_c(status), text, oddities: odd });
}
