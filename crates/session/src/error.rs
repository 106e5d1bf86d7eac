//! Why a run ended before its end.

use ttb_contract::Failure;
use ttb_coupling::IterationError;

/// A run that could not go on.
#[derive(Debug)]
pub enum RunError {
    /// The iteration.
    Iteration(IterationError),
    /// A subsystem, or another method, did not do what it was asked.
    Subsystem(Failure),
    /// What trial steps showed speaks against the run.
    Refused(Refusal),
    /// An observer could not keep what it saw.
    Write {
        /// What was written.
        what: String,
        /// Why it failed.
        source: std::io::Error,
    },
}

/// Why trial steps speak against a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The input is wrong: what, and what would be right.
    Input(String),
    /// A subsystem does not keep what it promises.
    Subsystem(String),
    /// A bridge does not come back to its states, but says that it does: it can be run as one that says it does not.
    NoReturn(String),
}

impl std::fmt::Display for RunError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Iteration(error) => error.fmt(f),
            Self::Subsystem(failure) => failure.fmt(f),
            Self::Refused(Refusal::Input(text) | Refusal::Subsystem(text) | Refusal::NoReturn(text)) => {
                f.write_str(text)
            }
            Self::Write { what, source } => write!(f, "{what}: {source}"),
        }
    }
}

impl std::error::Error for RunError {}

impl From<IterationError> for RunError {
    fn from(error: IterationError) -> Self {
        Self::Iteration(error)
    }
}

impl From<Failure> for RunError {
    fn from(failure: Failure) -> Self {
        Self::Subsystem(failure)
    }
}
