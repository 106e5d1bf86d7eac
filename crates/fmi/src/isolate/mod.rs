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
//! FMU reads and writes values in the shared memory itself. Waiting means spinning for up to 20 µs, then sleeping (on
//! Linux on a futex). Value references are sent once and kept, so that a call moves its values only. Calls that give nothing back go with
//! the next one, and a step brings along the outputs that were read after the last one.
//!
//! Whatever the host says is taken for what it is: words from a process whose memory may be spoiled.

#[cfg(any(target_os = "linux", windows))]
mod answers;
#[cfg(any(target_os = "linux", windows))]
mod call;
#[cfg(any(target_os = "linux", windows))]
mod control;
#[cfg(any(target_os = "linux", windows))]
mod exchange;
#[cfg(any(target_os = "linux", windows))]
mod gate;
#[cfg(any(target_os = "linux", windows))]
mod host;
#[cfg(not(any(target_os = "linux", windows)))]
mod nowhere;
#[cfg(any(target_os = "linux", windows))]
mod payload;
#[cfg(any(target_os = "linux", windows))]
mod process;
#[cfg(any(target_os = "linux", windows))]
mod remote;
mod settings;
#[cfg(any(target_os = "linux", windows))]
mod verbs;

#[cfg(any(target_os = "linux", windows))]
pub use host::host;
#[cfg(not(any(target_os = "linux", windows)))]
pub use nowhere::host;
#[cfg(not(any(target_os = "linux", windows)))]
pub(crate) use nowhere::start;
#[cfg(any(target_os = "linux", windows))]
pub(crate) use remote::start;
pub(crate) use settings::Instantiation;
pub use settings::{Isolation, Listener};

/// Whether FMUs can be isolated on this system.
pub const AVAILABLE: bool = cfg!(any(target_os = "linux", windows));
