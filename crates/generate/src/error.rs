//! What a generator refuses.

use std::fmt;

/// Numbers from which no bridge can be made: every rule that is broken, with what was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused(pub Vec<String>);

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.join("; "))
    }
}

impl std::error::Error for Refused {}

/// Gathers broken rules.
#[derive(Default)]
pub(crate) struct Rules(Vec<String>);

impl Rules {
    /// `rule` must hold; `found` says what was found instead.
    pub(crate) fn demand(&mut self, holds: bool, rule: &str, found: impl fmt::Display) -> &mut Self {
        if !holds {
            self.0.push(format!("{rule}, not {found}"));
        }
        self
    }

    /// All or nothing.
    pub(crate) fn result(self) -> Result<(), Refused> {
        if self.0.is_empty() { Ok(()) } else { Err(Refused(self.0)) }
    }
}
