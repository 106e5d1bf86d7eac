//! Ways and refinement.

#[path = "../common/mod.rs"]
mod common;
mod coupled;
mod over_fmu;
mod refine;
