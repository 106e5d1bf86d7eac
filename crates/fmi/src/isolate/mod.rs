//! An FMU in a process of its own: should it crash, end or hang, the master loses an FMU and not its results.
//!
//! ```text
//!  master                                   host (same program, started with `Isolation::arguments`)
//!  FmuInstance ── Slave ── Remote           host::host ── Slave ── C functions
//!                            │                  │
//!                            └── shared memory ─┘   header: request, reply, log; then lists and data
//! ```
//!
//! `payload` and `control` are the shared memory, `gate` is the handshake, `call` the requests; `exchange`,
//! `verbs` and `remote` are the master's end, `answers` and `host` the other one; `process` starts and ends it,
//! [`crate::output`] passes on what it prints.
//!
//! A call writes its arguments into the shared memory, counts the request's word up and waits for the reply's word; the
//! FMU reads and writes values in the shared memory itself. Waiting means spinning for up to 20 µs, then sleeping on a
//! futex. Value references are sent once and kept, so that a call moves its values only. Calls that give nothing back go with
//! the next one, and a step brings along the outputs that were read after the last one.
//!
//! Whatever the host says is taken for what it is: words from a process whose memory may be spoiled.

#[cfg(target_os = "linux")]
mod answers;
#[cfg(target_os = "linux")]
mod call;
#[cfg(target_os = "linux")]
mod control;
#[cfg(target_os = "linux")]
mod exchange;
#[cfg(target_os = "linux")]
mod gate;
#[cfg(target_os = "linux")]
mod host;
#[cfg(not(target_os = "linux"))]
mod nowhere;
#[cfg(target_os = "linux")]
mod payload;
#[cfg(target_os = "linux")]
mod process;
#[cfg(target_os = "linux")]
mod remote;
mod settings;
#[cfg(target_os = "linux")]
mod verbs;

#[cfg(target_os = "linux")]
pub use host::host;
#[cfg(not(target_os = "linux"))]
pub use nowhere::host;
#[cfg(not(target_os = "linux"))]
pub(crate) use nowhere::start;
#[cfg(target_os = "linux")]
pub(crate) use remote::start;
pub(crate) use settings::Instantiation;
pub use settings::{Isolation, Listener};

/// Whether FMUs can be isolated on this system.
pub const AVAILABLE: bool = cfg!(target_os = "linux");
