//! An FMU in a process of its own: should it crash, end or hang, the master loses an FMU and not its results.
//!
//! ```text
//!  master                                   host (same program, started with `Isolation::arguments`)
//!  FmuInstance ── Slave ── Remote           host::host ── Slave ── Local ── C functions
//!                            │                  │
//!                            └── shared memory ─┘   header: request, reply, log; then lists and data
//! ```
//!
//! [`memory`] and [`control`] are the shared memory, [`gate`] is the handshake, [`call`] the requests, [`remote`] and [`verbs`] the
//! master's end, [`host`] the other one, [`process`] starts and ends it and passes on what it prints.
//!
//! A call writes its arguments into the shared memory, counts the request's word up and waits for the reply's word; the
//! FMU reads and writes values in the shared memory itself. Waiting means spinning for up to 20 µs, then sleeping on a
//! futex. Value references are sent once and kept, so that a call moves its values only. Calls that give nothing back go with
//! the next one, and a step brings along the outputs that were read after the last one.
//!
//! Whatever the host says is taken for what it is: words from a process whose memory may be spoiled.

#[cfg(target_os = "linux")]
mod call;
#[cfg(target_os = "linux")]
mod control;
#[cfg(target_os = "linux")]
mod gate;
#[cfg(target_os = "linux")]
mod host;
#[cfg(target_os = "linux")]
mod memory;
#[cfg(target_os = "linux")]
mod output;
#[cfg(target_os = "linux")]
mod process;
#[cfg(target_os = "linux")]
mod remote;
#[cfg(target_os = "linux")]
mod verbs;

#[cfg(target_os = "linux")]
pub use host::host;
#[cfg(target_os = "linux")]
pub(crate) use remote::Remote;

use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// Whether FMUs can be isolated on this system.
pub const AVAILABLE: bool = cfg!(target_os = "linux");

/// Takes a line that an FMU has printed, with the name of its instance; called from another thread.
pub type Listener = Arc<dyn Fn(&str, &str) + Send + Sync>;

/// How to isolate an FMU.
#[derive(Clone)]
pub struct Isolation {
    /// The program that calls [`host`] when it is started with `arguments`.
    pub program: PathBuf,
    /// Its arguments.
    pub arguments: Vec<OsString>,
    /// The longest a call may take; then the process is killed.
    pub timeout: Duration,
    /// Gets what the FMU prints, be it on standard output or standard error, line by line.
    pub listener: Listener,
}

/// The program's answer when it is asked to be a host.
///
/// # Errors
/// Always: this system has no isolation.
#[cfg(not(target_os = "linux"))]
pub fn host() -> Result<(), String> {
    Err("isolating FMUs is available on Linux only".into())
}
