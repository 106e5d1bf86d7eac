//! The coupled way: both sides in this process, iterated step by step as `ttb run` does, over one shared track and bridge.
//!
//! ```text
//! task       what runs are made of and reduced with
//! source     the scenario with other values for some keys: train, speed, irregularity, variant
//! shared     tracks and bridges that several runs and threads share
//! vehicles   vehicles on their track over the bridge
//! forces     axle loads on a rigid track over the bridge; loads: runs of them
//! over_fmu   any train over an FMU in the place of the bridge, whose steps a master takes that this crate does not know
//! rows       histories reduced to rows and envelopes
//! ```

pub mod forces;
pub mod loads;
pub mod over_fmu;
pub mod rows;
pub mod shared;
pub mod source;
pub mod task;
pub mod vehicles;

pub use loads::{Bridges, Loads};
pub use over_fmu::{Master, OverFmu, Stepped};
pub use shared::Shared;
pub use source::Source;
pub use task::Task;
pub use vehicles::Vehicles;
