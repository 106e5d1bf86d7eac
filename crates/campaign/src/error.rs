//! Why a campaign cannot go on.

use std::path::{Path, PathBuf};

/// Why a campaign cannot go on. A run that fails is none of these: it is a row of the tables.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The request, the plan or the folder does not fit: every problem, a line each.
    #[error("{0}")]
    Input(String),
    /// A file.
    #[error("{}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
}

impl Error {
    /// Of an operation on a file.
    pub fn io(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Io { path, source }
    }

    /// Of all problems, a line each; `None` without.
    pub fn of_problems(problems: &[String]) -> Option<Self> {
        (!problems.is_empty()).then(|| Self::Input(problems.join("\n")))
    }
}
