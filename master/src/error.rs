//! Everything that ends a command, and its exit code.

use std::path::{Path, PathBuf};

use ttb_contract::Failure;
use ttb_coupling::IterationError;
use ttb_fmi::FmuError;
use ttb_fmi::archive::UnpackError;
use ttb_scenario::Problems;
use ttb_session::RunError;
use ttb_session::error::Refusal;

use crate::signals::Signal;

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The scenario has problems.
    #[error("{0}")]
    Scenario(Problems),
    /// Two FMUs that cannot be coupled as asked.
    #[error("{0}")]
    Input(String),
    /// A step did not converge.
    #[error("{0}")]
    NotConverged(IterationError),
    /// A subsystem ends the run: a wheel has left its rail.
    #[error("{0}")]
    Ended(String),
    /// All steps were taken, but the results cannot be believed.
    #[error("{0}")]
    BlownUp(String),
    /// An FMU failed.
    #[error("{0}")]
    Fmu(String),
    /// A bridge FMU that declares that it rolls back, and does not: it is to be run as one that does not.
    #[error("{0}")]
    NoReturn(String),
    /// A file.
    #[error("{}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// Packing an FMU.
    #[error("{0}")]
    Pack(String),
    /// `ttb check` found something; the findings are on stdout.
    #[error("{}: {count} findings", fmu.display())]
    Findings {
        /// The FMU.
        fmu: PathBuf,
        /// How many.
        count: usize,
    },
    /// `ttb report --check`: limits are exceeded; the verdicts are on stdout.
    #[error("{}: {count} {} exceeded", folder.display(), if *count == 1 { "criterion" } else { "criteria" })]
    Exceeded {
        /// The folder.
        folder: PathBuf,
        /// How many.
        count: usize,
    },
    /// Some runs of several failed; the others are kept.
    #[error("{count} of {of} runs failed; each is a row of runs.csv with its message")]
    RunsFailed {
        /// How many.
        count: usize,
        /// Of so many.
        of: usize,
    },
    /// Ctrl-C, or another signal.
    #[error("interrupted by {}; the results so far are kept", .0.name())]
    Interrupted(Signal),
}

impl Error {
    /// Exit code, see `ttb --help`.
    pub fn code(&self) -> u8 {
        match self {
            Self::Findings { .. } => 1,
            Self::Scenario(_) | Self::Input(_) => 2,
            Self::NotConverged(_) | Self::Ended(_) | Self::BlownUp(_) => 3,
            Self::Fmu(_) | Self::NoReturn(_) => 4,
            Self::Io { .. } | Self::Pack(_) => 5,
            Self::Exceeded { .. } => 6,
            Self::RunsFailed { .. } => 7,
            Self::Interrupted(signal) => signal.code(),
        }
    }

    /// One word for the summary's status.
    pub fn status(&self) -> &'static str {
        match self {
            Self::Scenario(_) | Self::Input(_) => "bad-input",
            Self::NotConverged(_) => "not-converged",
            Self::Ended(_) => "ended",
            Self::BlownUp(_) => "blown-up",
            Self::Fmu(_) | Self::NoReturn(_) => "fmu-failed",
            Self::Io { .. } | Self::Pack(_) => "io-failed",
            Self::Findings { .. } => "findings",
            Self::Exceeded { .. } => "exceeded",
            Self::RunsFailed { .. } => "runs-failed",
            Self::Interrupted(_) => "interrupted",
        }
    }

    /// The signal that ended the command.
    pub fn signal(&self) -> Option<Signal> {
        match self {
            Self::Interrupted(signal) => Some(*signal),
            _ => None,
        }
    }

    /// An I/O error at a path.
    pub fn io(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Io { path, source }
    }
}

impl From<IterationError> for Error {
    fn from(error: IterationError) -> Self {
        match error {
            IterationError::Subsystem(failure) => failure.into(),
            failed @ IterationError::NotFinite { .. } => Self::Fmu(failed.to_string()),
            error @ IterationError::NoReturn { .. } => {
                Self::Fmu(format!("{error}; \"roll_back\": false in the bridge's map (--map) does without"))
            }
            other => Self::NotConverged(other),
        }
    }
}

impl From<ttb_campaign::Error> for Error {
    fn from(error: ttb_campaign::Error) -> Self {
        match error {
            ttb_campaign::Error::Input(text) => Self::Input(text),
            ttb_campaign::Error::Io { path, source } => Self::Io { path, source },
        }
    }
}

impl From<ttb_dossier::Error> for Error {
    fn from(error: ttb_dossier::Error) -> Self {
        match error {
            ttb_dossier::Error::Input(text) => Self::Input(text),
            ttb_dossier::Error::Io { path, source } => Self::Io { path: path.into(), source },
            ttb_dossier::Error::Report(error) => Self::Pack(error.to_string()),
        }
    }
}

impl From<Failure> for Error {
    fn from(failure: Failure) -> Self {
        let told = failure.to_string();
        if failure.ended { Self::Ended(told) } else { Self::Fmu(told) }
    }
}

impl From<RunError> for Error {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Iteration(error) => error.into(),
            RunError::Subsystem(failure) => failure.into(),
            RunError::Refused(Refusal::Input(text)) => Self::Input(text),
            RunError::Refused(Refusal::Subsystem(text)) => Self::Fmu(text),
            RunError::Refused(Refusal::NoReturn(text)) => Self::NoReturn(text),
            RunError::Write { what, source } => Self::Io { path: what.into(), source },
        }
    }
}

impl From<FmuError> for Error {
    fn from(error: FmuError) -> Self {
        match error {
            // No room in the temporary folder is no fault of the FMU.
            FmuError::Unpack { source: UnpackError::Write { path, source }, .. } => Self::Io { path, source },
            other => Self::Fmu(other.to_string()),
        }
    }
}
