//! Histories and errors, drawn.

mod canvas;
mod envelope;
pub mod figures;
mod panel;
mod pen;
pub mod plot;
pub mod slopes;
pub mod speeds;
