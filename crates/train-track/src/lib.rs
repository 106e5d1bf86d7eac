//! The train–track subsystem: cars, rail, supports, contact, irregularity, strongly coupled.
//!
//! Start with [`coupled`]: the time-dependent system block by block. [`TrainTrack`] puts it behind the project's
//! [`ttb_contract::Model`] trait; [`outputs`] and [`parameters`] are its interface list. [`Prepared`] is the part that many
//! runs share.

mod built;
pub mod car;
mod cholesky;
pub mod compliance;
pub mod contact;
pub mod coupled;
mod decaying;
mod either;
pub mod fleet;
mod interface;
pub mod law;
mod macro_step;
mod model;
mod numbers;
pub mod outputs;
pub mod parameters;
mod pre_roll;
pub mod prepared;
pub mod profile;
pub mod space;
pub mod speed;
pub mod state;
pub mod statics;
pub mod step_means;
pub mod track;
pub mod wheels;

pub use model::TrainTrack;
pub use prepared::Prepared;
