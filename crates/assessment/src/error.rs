//! What a signal must be for a filter or an index to have a meaning.

/// Why a filter or an index has no value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SignalError {
    /// The record is too short.
    #[error("{what} needs {needed} {unit}; the record has {found}")]
    TooShort {
        /// Filter or index.
        what: &'static str,
        /// The least length.
        needed: f64,
        /// The length found.
        found: f64,
        /// Unit of both.
        unit: &'static str,
    },
    /// The record has too few values in a second.
    #[error("{what} at {frequency} Hz needs at least {needed} values a second; the record has {found}")]
    TooCoarse {
        /// Filter or index.
        what: &'static str,
        /// Its frequency, Hz.
        frequency: f64,
        /// The least rate, 1/s.
        needed: f64,
        /// The rate found, 1/s.
        found: f64,
    },
    /// A parameter is outside its range.
    #[error("{what} must be {rule}, not {value}")]
    OutOfRange {
        /// Parameter.
        what: &'static str,
        /// What must hold.
        rule: &'static str,
        /// What was given.
        value: f64,
    },
    /// The record has a value that is NaN or infinite.
    #[error("value {index} of the record is {value}; a filter would spread it over all others")]
    NotFinite {
        /// From 0.
        index: usize,
        /// NaN or an infinity.
        value: f64,
    },
}

/// Every value is finite, else the first that is not.
pub(crate) fn finite(signal: &[f64]) -> Result<(), SignalError> {
    match signal.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(SignalError::NotFinite { index, value: signal[index] }),
        None => Ok(()),
    }
}
