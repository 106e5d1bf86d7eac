//! Histories and errors, drawn.

pub mod canvas;
pub mod figures;
pub mod plot;
pub mod slopes;
