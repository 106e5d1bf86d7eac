//! Results of a run or a sweep as a report sees them: a folder of named files, on disk or in memory.
//!
//! ```text
//! Files (runs.csv, peaks.csv, plan.json, …) ── Opened ──► runs, rows, facts, scenario ── judge ──► verdicts
//!                                                 └──────────────── page ──────────────────────────► one HTML text
//! ```
//!
//! Whoever has the same files gets the same bytes: the program from a folder, the page in a browser from what it has computed.

pub mod error;
pub mod files;
pub mod folder;
pub mod noticed;
pub mod page;
pub mod statics;
pub mod tables;
pub mod verified;

pub use error::Error;
pub use files::{Files, Memory};
pub use folder::{Assessment, Opened};
pub use verified::Verified;
