//! The computation as values, for a page in a browser: texts in, texts out; no files of its own, no clock, no network.
//!
//! ```text
//! page (HTML, CSS, JS) ── verb and JSON ──► Engine ── JSON ──► page
//!                                             │
//!   in a Web Worker: `wasm`, one run after the other; in `ttb ui`: over HTTP, on all processors
//!
//! about     what comes with the program: trains, cars, tracks, spectra, limits, usual ranges
//! look      a scenario: its problems, what was chosen, a drawing, natural modes
//! axles     a pasted list of axles
//! plan      which runs a request is, in the order in which they cost least
//! runs      some of them: a record each
//! more      runs that a refinement asks for next
//! outcome   records → verdicts and curves
//! dossier   records → tables, plan, verdicts and report, the bytes that `ttb sweep` and `ttb report` write
//! film      one run with the motion of the whole deck
//! ```
//!
//! An answer follows from the request alone. What was prepared for a request is kept for the next one with the same text.

pub mod about;
pub mod engine;
pub mod fault;
pub mod film;
pub mod look;
pub mod outcome;
pub mod page;
pub mod request;
pub mod room;
pub mod session;
#[cfg(target_family = "wasm")]
mod wasm;

pub use engine::Engine;
pub use fault::Fault;
