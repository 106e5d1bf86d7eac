//! Everything that can go wrong with an FMU, said so that the user knows which, where and why.

use crate::archive::UnpackError;
use crate::description::DescriptionError;
use crate::library::LibraryError;
use crate::log::Message;
use crate::status::Status;
use crate::text::one_line;
use std::path::PathBuf;

/// An FMU that cannot be loaded or did not do what it was asked.
#[derive(Debug, thiserror::Error)]
pub enum FmuError {
    /// The archive.
    #[error("{}: {source}", fmu.display())]
    Unpack {
        /// The file.
        fmu: PathBuf,
        /// Why.
        source: UnpackError,
    },
    /// The modelDescription.xml.
    #[error("{}: modelDescription.xml: {source}", fmu.display())]
    Description {
        /// The file.
        fmu: PathBuf,
        /// Why.
        source: DescriptionError,
    },
    /// The shared library.
    #[error("{}: {source}", fmu.display())]
    Library {
        /// The file.
        fmu: PathBuf,
        /// Why.
        source: LibraryError,
    },
    /// A call answered with anything but OK and Warning.
    #[error("{instance}: {call} answered {prefix}{status}{}", log(messages))]
    Call {
        /// Name of the instance.
        instance: String,
        /// The call, with its time for a step.
        call: String,
        /// Beginning of the names of the FMI version, `fmi2`.
        prefix: &'static str,
        /// The answer.
        status: Status,
        /// What was logged during the call.
        messages: Vec<Message>,
    },
    /// The process of an isolated FMU has ended, or the FMU was to end this one.
    #[error("{instance}: {call}: {how}{}", logged(messages))]
    Gone {
        /// Name of the instance.
        instance: String,
        /// The call, with its time.
        call: String,
        /// The signal or exit code, or that it gave no answer in time, as a sentence.
        how: String,
        /// What was logged during the call.
        messages: Vec<Message>,
    },
    /// The FMU answered NULL when it was instantiated.
    #[error("{instance}: {call} gave no instance{}", log(messages))]
    NoInstance {
        /// Name of the function.
        call: &'static str,
        /// Name of the instance.
        instance: String,
        /// What was logged during the call.
        messages: Vec<Message>,
    },
    /// The FMU lacks what was asked of it, or it was asked the impossible.
    #[error("{instance}: {what}")]
    Impossible {
        /// Name of the instance.
        instance: String,
        /// What.
        what: String,
    },
}

fn log(messages: &[Message]) -> String {
    if messages.is_empty() { " and logged nothing".into() } else { logged(messages) }
}

fn logged(messages: &[Message]) -> String {
    if messages.is_empty() {
        return String::new();
    }
    let lines = messages.iter().map(|m| one_line(m.text.trim())).collect::<Vec<_>>();
    format!("; it logged: {}", lines.join(" | "))
}
