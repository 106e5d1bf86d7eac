//! The paper's other methods as plain library solvers, to compare the hybrid algorithm with.
//!
//! | method | what is solved at once | module |
//! |---|---|---|
//! | SCM, as in the paper | everything; refactorised every step, as the wheels move | [`scm`] |
//! | SCM, Schur | everything; constant factors, contacts by their compliance | [`schur`] |
//! | LCM | train \| track and bridge, iterated on the wheels' forces | [`lcm`] |
//!
//! They share the data of a case ([`whole`]), the constant equations of track and bridge ([`constant`]) and the time loop
//! ([`stepper`], where to start reading).
//!
//! [`monolithic`] is the strongly coupled method a second time, as plainly as possible: it assembles its own matrices from
//! the specifications ([`assembly`]), refactorises in every iteration, and shares with the product only the beam element and
//! the sparse solver. It is the independent check of everything between. [`space`] is the same for trains in space.

pub mod assembly;
pub mod constant;
pub mod error;
mod layout;
pub mod lcm;
pub mod monolithic;
pub mod outputs;
pub mod schur;
pub mod scm;
pub mod space;
mod start;
pub mod stepped;
pub mod stepper;
pub mod sweeps;
pub mod trial;
pub mod wheels;
pub mod whole;

pub use error::ReferenceError;
pub use monolithic::{History, Monolithic, run};
pub use stepped::Stepped;
pub use stepper::{Method, StepReport, Stepper};
pub use whole::Whole;
