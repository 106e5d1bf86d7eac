//! Everything that can go wrong with an FMU, said so that the user knows which, where and why.

use super::library::LibraryError;
use super::messages::Message;
use super::reader::DescriptionError;
use super::unpack::UnpackError;
use crate::types::Status;
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
    /// A call answered with anything but fmi2OK and fmi2Warning.
    #[error("{instance}: {call} answered {status}{}", log(messages))]
    Call {
        /// Name of the instance.
        instance: String,
        /// The call, with its time for a step.
        call: String,
        /// The answer.
        status: Status,
        /// What was logged during the call.
        messages: Vec<Message>,
    },
    /// The process of an isolated FMU has ended.
    #[error("{instance}: {call}: its process {how}{}", last_words(messages))]
    Gone {
        /// Name of the instance.
        instance: String,
        /// The call, with its time.
        call: String,
        /// The signal or exit code, or that it gave no answer in time.
        how: String,
        /// What was logged during the call.
        messages: Vec<Message>,
    },
    /// `fmi2Instantiate` answered NULL.
    #[error("{instance}: fmi2Instantiate gave no instance{}", log(messages))]
    NoInstance {
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
    /// An output is NaN or infinite.
    #[error("{instance}: output {variable} is {value} at t = {time} s")]
    NotFinite {
        /// Name of the instance.
        instance: String,
        /// Name of the output.
        variable: String,
        /// Its value.
        value: f64,
        /// Time in s.
        time: f64,
    },
}

fn log(messages: &[Message]) -> String {
    if messages.is_empty() { " and logged nothing".into() } else { last_words(messages) }
}

fn last_words(messages: &[Message]) -> String {
    if messages.is_empty() {
        return String::new();
    }
    let lines = messages.iter().map(|m| m.text.trim()).collect::<Vec<_>>();
    format!("; it logged: {}", lines.join(" | "))
}
