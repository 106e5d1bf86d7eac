//! What a check finds.

use serde::{Deserialize, Serialize};

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
}

impl Finding {
    /// An error.
    pub fn error(name: &str, what: impl Into<String>) -> Self {
        Self { severity: Severity::Error, name: name.into(), what: what.into(), at: "".into(), evidence: "".into() }
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
        write!(f, "{severity:<8}{:<20} {}", self.name, self.what)?;
        if !self.at.is_empty() {
            write!(f, "; at {}", self.at)?;
        }
        if !self.evidence.is_empty() {
            write!(f, "; seen: {}", self.evidence)?;
        }
        Ok(())
    }
}
