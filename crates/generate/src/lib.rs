//! Makes finite-element models of bridges from a few numbers.
//!
//! | | |
//! |---|---|
//! | [`cable_stayed`] | one tower, two planes of cables, 112 + 80 + 32 m, and a simply supported girder at either end |
//! | [`viaduct`], [`simple_span`] | simply supported girders in a row, or one of them |
//! | [`cable_stayed_scenario`], [`viaduct_scenario`] | a train over them, as the text of a scenario file |
//! | [`start`] | first files of a project: a scenario with comments |
//! | [`text`] | a model as the text of a file |
//! | [`measure`] | what a model weighs, how many degrees of freedom it has |
//!
//! Every girder is a [`Trough`]: a channel of flat shells with cross-beams under its floor. The mesh is chosen from the
//! number of degrees of freedom asked for; the geometry does not depend on it. Same input, same model, bit for bit.

mod builder;
mod cable_stayed;
mod cables;
mod error;
mod fit;
mod girder;
mod lines;
pub mod measure;
mod piers;
mod plan;
mod scenario;
mod section;
pub mod start;
mod text;
mod tower;
mod trough;
mod viaduct;

pub use cable_stayed::{CableStayed, cable_stayed};
pub use error::Refused;
pub use scenario::{cable_stayed_scenario, viaduct_scenario};
pub use section::{Profile, hollow, solid};
pub use text::text;
pub use trough::Trough;
pub use viaduct::{Viaduct, simple_span, viaduct};
