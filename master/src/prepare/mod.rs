//! From a scenario to what is run: its FMUs and its steps.

pub mod auto;
pub mod fmus;
mod levels;
mod libraries;
mod stretch;
