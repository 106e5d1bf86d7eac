//! What a run leaves behind: rows, extremes, the summary, and where all of it comes from.

pub mod belief;
pub mod choice;
pub mod coupled;
pub mod credible;
pub mod folder;
pub mod job;
pub mod peaks;
mod print;
pub mod provenance;
pub mod ran;
pub mod rows;
pub mod scene;
pub mod summary;
