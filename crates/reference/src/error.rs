//! Why a reference method cannot go on.

/// Why a reference method cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReferenceError {
    /// The case is none that these methods solve.
    #[error("{0}")]
    Case(String),
    /// A step failed.
    #[error("the step to t = {t} s: {what}")]
    Step {
        /// End of the step, s.
        t: f64,
        /// What happened.
        what: String,
    },
}
