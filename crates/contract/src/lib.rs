//! What the crates of this project agree on. Only the standard library stands below.
//!
//! - [`Model`] is a subsystem's physics; [`Interface`] and [`Values`] are its variables.
//! - [`Instance`] gives a model the life cycle of an FMI co-simulation slave; [`Snapshot`] is its saved state.
//! - [`Subsystem`] is the view that an iteration has of either side, whatever stands behind it: an FMU, or a model of this
//!   process ([`InProcess`]).
//! - [`Port`] is one place where the two sides touch: a force and the motion that does work with it. [`Ports`] says in which
//!   order forces and motions stand in the vectors that a [`Subsystem`] takes and gives.
//! - [`names`] holds the names of the coupled variables, which both sides and every master use.

pub mod bytes;
pub mod finite;
pub mod in_process;
pub mod instance;
pub mod instant;
pub mod interface;
pub mod model;
pub mod names;
pub mod pair;
pub mod port;
pub mod ports;
pub mod prepare;
pub mod snapshot;
pub mod subsystem;
pub mod values;

/// Acceleration of gravity in all of this project, m/s².
pub const GRAVITY: f64 = 9.81;

pub use in_process::InProcess;
pub use instance::{Instance, Phase};
pub use interface::{Causality, Interface, Kind, Variable};
pub use model::{Model, ModelError};
pub use pair::Pair;
pub use port::{Component, Known, Port};
pub use ports::{Parts, Ports};
pub use prepare::Prepare;
pub use snapshot::Snapshot;
pub use subsystem::{Failure, Signal, Subsystem};
pub use values::Values;
