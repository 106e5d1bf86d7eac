//! The scenario file as types; the doc comments are the JSON Schema's descriptions.

mod bridge;
mod coupling;
mod csv;
mod elements;
mod fmus;
mod frame;
mod freedom;
mod irregularity;
mod links;
mod model;
mod scenario;
mod sections;
mod space;
mod time;
mod track;
mod train;
mod vehicle;

pub use bridge::*;
pub use coupling::*;
pub use csv::*;
pub use elements::*;
pub use fmus::*;
pub use frame::*;
pub use freedom::*;
pub use irregularity::*;
pub use links::*;
pub use model::*;
pub use scenario::*;
pub use sections::*;
pub use space::*;
pub use time::*;
pub use track::*;
pub use train::*;
pub use vehicle::*;
