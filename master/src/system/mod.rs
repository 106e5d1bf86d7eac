//! System structures (SSP 1.0 and 2.0): a scenario written as one, and one read and run.

mod annotation;
mod describe;
mod export;
mod files;
mod load;
mod resolved;
mod roles;
mod steps;
mod values;
mod wiring;

pub use export::export;
pub use load::Opened;
