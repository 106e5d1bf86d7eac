//! Why a request has no answer, in the words of the program's messages.

use serde::Serialize;
use ttb_scenario::{Problem, Problems};

/// Why a request has no answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fault {
    /// All of it, a line each.
    pub error: String,
    /// Problems with their places, where they are known.
    pub problems: Vec<Told>,
}

/// A problem with its place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Told {
    /// JSON path of the value; empty: the whole.
    pub path: String,
    /// Rule, value and suggestion, as `ttb check-scenario` prints them behind file and path.
    pub text: String,
}

impl Told {
    /// Of a problem.
    pub fn of(problem: &Problem) -> Self {
        let bare = Problem { file: String::new(), path: String::new(), ..problem.clone() };
        Self { path: problem.path.clone(), text: bare.to_string().trim_start_matches(": ").into() }
    }
}

impl Fault {
    /// Of a sentence.
    pub fn new(error: impl Into<String>) -> Self {
        Self { error: error.into(), problems: Vec::new() }
    }

    /// Of problems.
    pub fn of(problems: &Problems) -> Self {
        Self { error: problems.to_string(), problems: problems.0.iter().map(Told::of).collect() }
    }
}

impl From<ttb_campaign::Error> for Fault {
    fn from(error: ttb_campaign::Error) -> Self {
        Self::new(error.to_string())
    }
}

impl From<ttb_dossier::Error> for Fault {
    fn from(error: ttb_dossier::Error) -> Self {
        Self::new(error.to_string())
    }
}
