//! What a probed FMU logs, and how badly.

use crate::logger::{Listener, Logged, ODDITIES};
use crate::types::Status;
use std::collections::VecDeque;
use std::sync::{Mutex, PoisonError};

/// A call of the logger.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogEntry {
    /// As the FMU rates it.
    pub status: Status,
    /// The text, at most 4095 bytes.
    pub text: String,
    /// What is wrong with the call.
    pub oddities: Vec<&'static str>,
}

/// Entries kept.
const KEPT: usize = 100;

#[derive(Default)]
pub(super) struct Log(Mutex<VecDeque<LogEntry>>);

impl Log {
    pub fn take(&self) -> Vec<LogEntry> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).drain(..).collect()
    }
}

impl Listener for Log {
    fn hear(&self, logged: &Logged) {
        let odd = (0..ODDITIES.len()).filter(|i| logged.oddities >> i & 1 == 1).map(|i| ODDITIES[i]).collect();
        let text = String::from_utf8_lossy(logged.text).into_owned();
        let mut entries = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // The first entries stay, the last one is replaced: a flood shows how it began.
        if entries.len() == KEPT {
            entries.pop_back();
        }
        entries.push_back(LogEntry { status: logged.status, text, oddities: odd });
    }
}
