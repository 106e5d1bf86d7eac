//! What a run leaves behind: rows as they come, extremes, the summary.

pub mod choice;
pub mod coupled;
pub mod job;
pub mod peaks;
pub mod ran;
pub mod scene;
pub mod summary;
