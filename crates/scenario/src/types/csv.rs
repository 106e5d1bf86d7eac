//! How tables of results are written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How results.csv and iterations.csv are written, for programs that read no other form. The default loses nothing: a comma
/// between columns, a decimal point, 17 significant digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct Csv {
    /// What stands between columns.
    pub separator: Separator,
    /// What stands before the decimals; a comma needs another separator.
    pub decimal: Decimal,
    /// Significant digits; 17 give back the same number when they are read.
    #[schemars(range(min = 3, max = 17))]
    pub digits: usize,
}

/// Most significant digits a number of double precision has.
pub const ALL_DIGITS: usize = 17;

impl Default for Csv {
    fn default() -> Self {
        Self { separator: Separator::Comma, decimal: Decimal::Point, digits: ALL_DIGITS }
    }
}

/// What stands between columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Separator {
    /// `,`
    Comma,
    /// `;`, which spreadsheets of most European languages expect.
    Semicolon,
    /// A tabulator.
    Tab,
}

/// What stands before the decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Decimal {
    /// `0.5`
    Point,
    /// `0,5`
    Comma,
}
