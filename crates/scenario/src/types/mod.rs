//! The scenario file as types; the doc comments are the JSON Schema's descriptions.

mod bridge;
mod frame;
mod irregularity;
mod model;
mod run;
mod track;
mod train;

pub use bridge::*;
pub use frame::*;
pub use irregularity::*;
pub use model::*;
pub use run::*;
pub use track::*;
pub use train::*;
