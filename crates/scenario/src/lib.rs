//! Scenario files: types, JSON Schema, checks, bundled data; no solver.
//!
//! [`load()`] reads a scenario file and gives [`Checked`]: two specs, from which the physics crates build their models, or
//! [`Problems`]: everything that is wrong with the file, each with its place and the rule it breaks.

pub mod bundled;
mod check;
mod data;
pub mod deck;
mod density;
mod json;
pub mod limits;
mod load;
mod measured;
pub mod model;
mod pieces;
mod problem;
mod resolve;
mod schema;
pub mod space;
pub mod spec;
pub mod step;
pub mod travel;
pub mod types;
mod walk;

pub use bundled::default_scenario_text;
pub use load::{Checked, from_str, load};
pub use problem::{Problem, Problems, nearest};
pub use schema::{model_schema, schema};
pub use ttb_contract::GRAVITY;
