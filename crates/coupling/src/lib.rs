//! The hybrid solution algorithm: force compatibility between two subsystems, iterated at every macro step.
//!
//! Start with [`scheme`]: the algorithm, one step in one file (`scheme/step.rs`). The rooms below it, each of which knows only
//! those after it:
//!
//! - [`probe`]: what trial steps tell before a step is taken (contraction, a model of the interface, wrong signs and units);
//! - [`acceleration`]: how the next trial follows from the residual;
//! - `trial`: what one trial sends and gets, and where it starts from;
//! - [`adapters`]: bridges that give less than the iteration wants, or several bridges;
//! - [`settings`], [`report`], [`error`], [`work`], [`algebra`].
//!
//! [`ttb_contract::Subsystem`] is all it needs of either side. Beyond that and the standard library it uses only pulp, for
//! sums in the instructions of the CPU at hand.

pub mod acceleration;
pub mod adapters;
pub mod algebra;
pub mod error;
pub mod probe;
pub mod report;
pub mod scheme;
pub mod settings;
mod trial;
pub mod work;

pub use adapters::{Adapted, Joined, Lacks, Place, Shape, StationError, Stations, Watch};
pub use error::IterationError;
pub use report::{Outcome, Report, StepInfo};
pub use scheme::Coupling;
pub use settings::{Method, OnFailure, Predictor, Settings};
pub use work::Work;
