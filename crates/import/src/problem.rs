//! What can be wrong with a file, said in one line each: where, which rule, what was found.

use std::fmt;

use crate::number::significant;

/// One broken rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The file as the user named it.
    pub file: String,
    /// Line of the file, from 1; absent: the file as a whole.
    pub line: Option<u64>,
    /// The rule that is broken.
    pub rule: String,
    /// What was found instead.
    pub value: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.file)?;
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        f.write_str(&self.rule)?;
        if !self.value.is_empty() {
            write!(f, ": {}", self.value)?;
        }
        Ok(())
    }
}

/// All problems found; never empty.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", .0.iter().map(Problem::to_string).collect::<Vec<_>>().join("\n"))]
pub struct Problems(pub Vec<Problem>);

/// Reading on makes no sense; the reason is in the report.
#[derive(Debug)]
pub(crate) struct Stop;

/// Collects the problems of one file.
pub(crate) struct Report {
    file: String,
    /// The rules that are broken, in the order they were met.
    pub problems: Vec<Problem>,
    /// Most significant digits of a value so far.
    pub digits: u32,
}

impl Report {
    /// Problems of one file after which it is read no further.
    const MOST: usize = 20;

    pub fn new(file: &str) -> Self {
        Self { file: file.to_owned(), problems: Vec::new(), digits: 0 }
    }

    /// Notes a problem; [`Stop`] once there are enough of them.
    pub fn line(&mut self, line: u64, rule: impl Into<String>, value: impl fmt::Display) -> Result<(), Stop> {
        self.push(Some(line), rule.into(), value.to_string());
        if self.problems.len() < Self::MOST {
            return Ok(());
        }
        self.push(None, "more problems may follow, reading stopped after".into(), format!("line {line}"));
        Err(Stop)
    }

    /// Notes a problem with the file as a whole.
    pub fn whole(&mut self, rule: impl Into<String>, value: impl fmt::Display) {
        self.push(None, rule.into(), value.to_string());
    }

    /// Notes a problem that makes the rest of the file meaningless.
    pub fn fatal(&mut self, line: Option<u64>, rule: impl Into<String>, value: impl fmt::Display) -> Stop {
        self.push(line, rule.into(), value.to_string());
        Stop
    }

    /// The file, as the user named it.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// Notes how many digits a value is written with.
    #[inline]
    pub fn written(&mut self, value: &[u8]) {
        /// So many hold a double well enough.
        const ALL: u32 = 16;
        if self.digits < ALL {
            self.digits = self.digits.max(significant(value));
        }
    }

    fn push(&mut self, line: Option<u64>, rule: String, value: String) {
        self.problems.push(Problem { file: self.file.clone(), line, rule, value });
    }
}

/// The beginning of a line as it may be shown to people.
pub(crate) fn excerpt(text: &[u8]) -> String {
    const SHOWN: usize = 60;
    let shown = &text[..text.len().min(SHOWN)];
    let more = if text.len() > SHOWN { "…" } else { "" };
    format!("`{}{more}`", shown.escape_ascii())
}
