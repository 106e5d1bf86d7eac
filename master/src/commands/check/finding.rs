//! What a check finds.

use serde::{Deserialize, Serialize};

use super::rules::clause;
use crate::printed::one_line;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Against the standard, or it makes results wrong.
    Error,
    /// Some master will stumble over it.
    Warning,
    /// Not as the standard has it, but no master that keeps to it will notice.
    Remark,
}

/// One finding.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Finding {
    /// How bad.
    pub severity: Severity,
    /// Which rule, always by the same word.
    pub name: String,
    /// What is wrong.
    pub what: String,
    /// Where: call, time, variable, part of the archive.
    pub at: String,
    /// What was seen.
    pub evidence: String,
    /// What stands behind it; in a box, so that results with a finding as their error stay small.
    #[serde(flatten)]
    pub(super) behind: Box<Behind>,
}

/// The rule's clause and how to see the finding again; filled in at the end.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Behind {
    /// The clause of the standard behind the rule.
    #[serde(default)]
    clause: String,
    /// The command that makes the same test alone.
    #[serde(default)]
    repeat: String,
}

impl Finding {
    /// An error.
    pub fn error(name: &str, what: impl Into<String>) -> Self {
        let none = String::new;
        let (name, what) = (name.into(), what.into());
        Self { severity: Severity::Error, name, what, at: none(), evidence: none(), behind: Box::default() }
    }

    /// A warning.
    pub fn warning(name: &str, what: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(name, what) }
    }

    /// A remark.
    pub fn remark(name: &str, what: impl Into<String>) -> Self {
        Self { severity: Severity::Remark, ..Self::error(name, what) }
    }

    /// Where it was.
    pub fn at(self, at: impl Into<String>) -> Self {
        Self { at: at.into(), ..self }
    }

    /// What was seen; line breaks go.
    pub fn seen(self, evidence: impl Into<String>) -> Self {
        let evidence: String = evidence.into();
        Self { evidence: evidence.split_whitespace().collect::<Vec<_>>().join(" "), ..self }
    }

    /// With another severity.
    pub fn of(self, severity: Severity) -> Self {
        Self { severity, ..self }
    }

    /// With a clause of its own in place of the rule's.
    pub fn with_clause(self, clause: String) -> Self {
        Self { behind: Box::new(Behind { clause, ..*self.behind }), ..self }
    }

    /// With its clause, and the command that repeats it.
    pub fn complete(self, repeat: &str) -> Self {
        let known = &self.behind.clause;
        let clause = if known.is_empty() { clause(&self.name) } else { known.clone() };
        Self { behind: Box::new(Behind { clause, repeat: repeat.into() }), ..self }
    }

    /// Whether two findings say the same: one fault shows in many tests.
    pub fn same(&self, other: &Self) -> bool {
        self.name == other.name && self.what == other.what
    }
}

/// One line.
impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let severity = match self.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Remark => "remark",
        };
        write!(f, "{severity:<8}{:<20} {}", self.name, one_line(&self.what))?;
        if !self.at.is_empty() {
            write!(f, "; at {}", one_line(&self.at))?;
        }
        if !self.evidence.is_empty() {
            write!(f, "; seen: {}", one_line(&self.evidence))?;
        }
        let Behind { clause, repeat } = &*self.behind;
        if !clause.is_empty() {
            write!(f, " [{clause}; {}]", one_line(repeat))?;
        }
        Ok(())
    }
}
