//! The report: verdicts first, then what they stand on, as one HTML file that needs nothing else.
//!
//! ```text
//! Input (values: verdicts, results, bridge, trains, passages) ── sections ──► minijinja template ──► text
//! ```
//!
//! Nothing is read or written here, and no clock: the date is a value of the input, so that equal inputs give equal bytes.
//! Charts are SVG inside the page. Their colours are CSS variables, so that they follow light and dark; every curve has a
//! line style of its own besides its colour. The page is complete without its script, which only reads values aloud.

pub mod chart;
pub mod input;
pub mod number;
mod section;

pub use input::{
    Bridge, Change, Comfort, Envelope, History, Input, Losses, ModeShape, Passage, Property, SpaceTime, Train,
};

use minijinja::syntax::SyntaxConfig;
use minijinja::value::Serde;
use minijinja::{AutoEscape, Environment};

/// The one script of a page.
pub const SCRIPT: &str = include_str!("../templates/script.js");

/// The report could not be made: a fault of its template.
#[derive(Debug, thiserror::Error)]
#[error("the report's template: {0}")]
pub struct ReportError(#[from] minijinja::Error);

/// The page.
///
/// # Errors
/// The template has a fault.
pub fn render(input: &Input) -> Result<String, ReportError> {
    let mut environment = Environment::new();
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    environment.set_syntax(SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).build()?);
    environment.add_template("report", include_str!("../templates/report.html"))?;
    let page = section::Page::new(input);
    Ok(environment.get_template("report")?.render(Serde(&page))?)
}
