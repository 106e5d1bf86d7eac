//! What can be wrong with a limits file, said in one line each.

use std::fmt;

/// One problem of a limits file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LimitsProblem {
    /// The file as it was named.
    pub file: String,
    /// JSON path; empty for the file as a whole.
    pub path: String,
    /// The rule.
    pub rule: String,
    /// What was found.
    pub value: String,
    /// What may have been meant.
    pub suggestion: Option<String>,
}

impl fmt::Display for LimitsProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.file)?;
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        f.write_str(&self.rule)?;
        if !self.value.is_empty() {
            write!(f, ": {}", self.value)?;
        }
        match &self.suggestion {
            Some(name) => write!(f, " (did you mean `{name}`?)"),
            None => Ok(()),
        }
    }
}
