//! How to isolate an FMU.

use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// Takes a line that an FMU has printed, with the name of its instance; called from another thread.
pub type Listener = Arc<dyn Fn(&str, &str) + Send + Sync>;

/// How to isolate an FMU.
#[derive(Clone)]
pub struct Isolation {
    /// The program that calls [`host`](super::host()) when it is started with `arguments`.
    pub program: PathBuf,
    /// Its arguments.
    pub arguments: Vec<OsString>,
    /// The longest a call may take; then the process is killed.
    pub timeout: Duration,
    /// Gets what the FMU prints, be it on standard output or standard error, line by line.
    pub listener: Listener,
}

/// What an isolated instance is made of.
pub struct Instantiation<'a> {
    /// Its name.
    pub name: &'a str,
    /// The FMU, for messages.
    pub fmu: &'a std::path::Path,
    /// Its description.
    pub description: &'a crate::description::ModelDescription,
    /// Where it is unpacked; stays as long as the instance.
    pub folder: &'a std::path::Path,
    /// Whether debug messages are wanted.
    pub logging: bool,
}
