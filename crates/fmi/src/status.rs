//! What a call answers, the same in all versions of FMI.

/// What a call answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(i32)]
pub enum Status {
    /// Done.
    Ok = 0,
    /// Done, but look at the log.
    Warning = 1,
    /// Not done; the caller may try otherwise.
    Discard = 2,
    /// Failed; only a restored state or a reset helps this instance.
    Error = 3,
    /// Failed for all instances of the FMU.
    Fatal = 4,
    /// Still computing (FMI 2.0 only).
    Pending = 5,
    /// Not done, and the FMU ends the simulation of its own accord. No C value: an importer that finds a discarded step asks.
    Ended = 100,
}

impl Status {
    /// The status of an [`Answer`](crate::slave::Answer): a C value, or [`Status::Ended`].
    pub fn of_answer(status: i32) -> Self {
        if status == Self::Ended as i32 { Self::Ended } else { Self::from_c(status) }
    }

    /// The status behind a C value; a value outside the standard counts as [`Status::Fatal`].
    pub fn from_c(status: i32) -> Self {
        match status {
            0 => Self::Ok,
            1 => Self::Warning,
            2 => Self::Discard,
            3 => Self::Error,
            5 => Self::Pending,
            _ => Self::Fatal,
        }
    }
}

/// Its name in the standard without the version's prefix: `OK` of `fmi2OK`.
impl std::fmt::Display for Status {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Ok => f.write_str("OK"),
            Self::Ended => f.write_str("Discard, which ends the simulation"),
            other => write!(f, "{other:?}"),
        }
    }
}
