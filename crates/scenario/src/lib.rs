//! Scenario files: types, JSON Schema, checks, bundled data; no solver.
//!
//! [`load()`] reads a scenario file and gives [`Checked`]: two specs, from which the physics crates build their models, or
//! [`Problems`]: everything that is wrong with the file, each with its place and the rule it breaks.

mod believable;
pub mod bundled;
mod check;
mod data;
pub mod deck;
mod density;
pub mod ground;
mod json;
pub mod limits;
mod load;
mod measured;
mod mirrored;
pub mod model;
pub mod passage;
mod pieces;
pub mod place;
mod placement;
mod problem;
mod ranges;
mod resolve;
mod schema;
mod settings;
pub mod space;
pub mod spans;
mod spatial;
pub mod spec;
pub mod step;
pub mod travel;
pub mod types;
pub mod vehicle;
mod walk;

pub use believable::{Believable, believable};
pub use bundled::default_scenario_text;
pub use load::{Checked, ForceLookUp, from_str, from_str_using, from_str_with, load, load_using, load_with, read_as};
pub use placement::Chosen;
pub use problem::{Problem, Problems, Warning, nearest};
pub use ranges::{usual, usual_frequencies};
pub use schema::{model_schema, schema, strict};
pub use settings::Setting;
pub use ttb_contract::GRAVITY;
pub use ttb_import::text as read_text;
