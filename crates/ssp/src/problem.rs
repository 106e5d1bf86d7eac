//! What is wrong with a system structure, said in one line each.

use std::fmt;

/// So many problems are listed; of the others only the number is told.
const LISTED: usize = 50;

/// One problem.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The file.
    pub file: String,
    /// Where in it, such as `/SystemStructureDescription/System/Connections/Connection[3]`; empty for the file as a whole.
    pub place: String,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.file)?;
        if !self.place.is_empty() {
            write!(f, "{}: ", self.place)?;
        }
        f.write_str(&self.message)
    }
}

/// Collects the problems of one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    file: String,
    problems: Vec<Problem>,
    more: usize,
}

impl Report {
    /// Of a file without problems so far.
    pub fn new(file: impl Into<String>) -> Self {
        Self { file: file.into(), problems: Vec::new(), more: 0 }
    }

    /// What messages call the file.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// Notes a problem.
    pub fn problem(&mut self, place: &str, message: impl Into<String>) {
        let file = self.file.clone();
        self.problem_in(file, place, message);
    }

    /// Notes a problem of another file.
    pub fn problem_in(&mut self, file: impl Into<String>, place: &str, message: impl Into<String>) {
        if self.problems.len() < LISTED {
            self.problems.push(Problem { file: file.into(), place: place.to_string(), message: message.into() });
        } else {
            self.more += 1;
        }
    }

    /// Takes over what was noted of another file.
    pub fn absorb(&mut self, other: Self) {
        self.more += other.more;
        for Problem { file, place, message } in other.problems {
            self.problem_in(file, &place, message);
        }
    }

    /// Whether nothing was noted.
    pub fn is_empty(&self) -> bool {
        self.problems.is_empty()
    }

    /// What was noted and is listed.
    pub fn problems(&self) -> &[Problem] {
        &self.problems
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.problems.iter().map(ToString::to_string).collect();
        f.write_str(&lines.join("\n"))?;
        if self.more > 0 {
            write!(f, "\n{}: and {} more problems", self.file, self.more)?;
        }
        Ok(())
    }
}
