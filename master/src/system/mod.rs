//! System structures (SSP 1.0): a scenario written as one, and one read and run.

mod annotation;
mod export;
mod load;
mod roles;
mod wiring;

pub use export::export;
pub use load::Opened;
