//! Why results make no report.

/// Why results make no report.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Files that are missing or cannot be read, a line each.
    #[error("{0}")]
    Input(String),
    /// A file.
    #[error("{path}: {source}")]
    Io {
        /// Which.
        path: String,
        /// Why.
        source: std::io::Error,
    },
    /// The report's template.
    #[error(transparent)]
    Report(#[from] ttb_report::ReportError),
}
