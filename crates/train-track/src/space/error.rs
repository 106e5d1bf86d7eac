//! Why a step in space could not be done.

/// A step that could not be done, with the message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StepError {
    /// A wheel has left its rail: the run ends there.
    Derailed(String),
    /// No forces of the contacts were found: shorter steps may find them.
    Unsolved(String),
    /// Anything else.
    Refused(String),
}

impl From<String> for StepError {
    fn from(message: String) -> Self {
        Self::Refused(message)
    }
}

impl std::fmt::Display for StepError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (Self::Derailed(message) | Self::Unsolved(message) | Self::Refused(message)) = self;
        f.write_str(message)
    }
}

impl std::error::Error for StepError {}
