//! The train–track subsystem: cars, rail, supports, contact, irregularity, strongly coupled.
//!
//! Start with [`coupled`]: the time-dependent system block by block. [`TrainTrack`] puts it behind the project's
//! [`ttb_contract::Model`] trait; [`variables`] is its interface list.

pub mod car;
pub mod compliance;
pub mod contact;
pub mod coupled;
mod model;
pub mod over;
pub mod profile;
pub mod speed;
pub mod statics;
pub mod track;
pub mod variables;

pub use model::TrainTrack;
