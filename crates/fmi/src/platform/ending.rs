//! How processes end, on every system.

/// How a process came to its end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ending {
    /// By itself, with an exit code.
    Code(i32),
    /// It aborted itself; how.
    Abort(String),
    /// It crashed; by what.
    Crash(String),
}
