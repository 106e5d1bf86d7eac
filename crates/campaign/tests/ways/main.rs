//! Ways and refinement.

#[path = "../common/mod.rs"]
mod common;
mod coupled;
mod refine;
