//! What all rows of the table share.

use std::sync::atomic::AtomicBool;

use indicatif::ProgressBar;
use ttb_scenario::Checked;

use crate::commands::progress::progress_bar;
use crate::results::ran::Watched;

/// What all rows share.
pub struct Bench<'a> {
    /// The case.
    pub checked: &'a Checked,
    /// What is compared.
    pub watched: Watched,
    /// CPU seconds a row may take.
    pub budget: f64,
    /// Set by Ctrl-C.
    pub stop: &'a AtomicBool,
    /// No progress.
    pub quiet: bool,
}

/// A row's progress on a terminal.
pub fn progress(bench: &Bench, name: &str, steps: u64) -> ProgressBar {
    progress_bar(steps, bench.quiet).with_prefix(format!("{name:<24} "))
}
