//! The hybrid solution algorithm: force compatibility between two subsystems, iterated at every macro step.
//!
//! Start with [`iteration`]; [`ttb_contract::Subsystem`] is all it needs of either side.
//! Beyond the standard library it uses only pulp, for sums in the instructions of the CPU at hand.

pub mod acceleration;
pub mod adapted;
pub mod dense;
mod exchange;
pub mod explicit;
mod identify;
pub mod iteration;
pub mod joined;
pub mod newton;
pub mod predictor;
pub mod probe;
pub mod quasi_newton;
pub mod report;
pub mod run;
pub mod settings;
pub mod stations;
mod strategy;
mod trials;
pub mod verdict;
pub mod work;

pub use adapted::Adapted;
pub use iteration::{Coupling, IterationError, Outcome, Settings, StepInfo};
pub use joined::Joined;
pub use report::Report;
pub use settings::{Method, OnFailure};
pub use stations::{Shape, StationError, Stations};
pub use work::Work;
