//! The hybrid solution algorithm: force compatibility between two subsystems, iterated at every macro step.
//!
//! Start with [`iteration`]; [`subsystem::Subsystem`] is all it needs of either side. [`model::Model`] is what the
//! project's own physics provides, [`instance::Instance`] gives a model the life cycle of an FMI 2.0 co-simulation slave,
//! and [`in_process::InProcess`] couples such an instance without any FMU in between.
//! Beyond the standard library it uses only pulp, for sums in the instructions of the CPU at hand.

pub mod acceleration;
pub mod adapted;
pub mod dense;
mod exchange;
pub mod explicit;
mod identify;
pub mod in_process;
pub mod instance;
pub mod interface;
pub mod iteration;
pub mod joined;
pub mod model;
pub mod newton;
pub mod pair;
pub mod predictor;
pub mod probe;
pub mod quasi_newton;
pub mod report;
pub mod run;
pub mod settings;
pub mod snapshot;
pub mod stations;
mod strategy;
pub mod subsystem;
mod trials;
pub mod verdict;
pub mod work;

pub use adapted::Adapted;
pub use in_process::InProcess;
pub use instance::Instance;
pub use interface::{Causality, Interface, Kind, Values, Variable};
pub use iteration::{Coupling, IterationError, Outcome, Settings, StepInfo};
pub use joined::Joined;
pub use model::{Model, ModelError};
pub use pair::Pair;
pub use report::Report;
pub use settings::{Method, OnFailure};
pub use stations::{Shape, StationError, Stations};
pub use subsystem::{Failure, Subsystem};
pub use work::Work;
