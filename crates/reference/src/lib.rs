//! The paper's other methods as plain library solvers, to compare the hybrid algorithm with.
//!
//! [`monolithic`] is the strongly coupled method (SCM): cars, track and bridge in one time-dependent system, refactorised
//! in every iteration of every step. It assembles its own matrices from the specifications ([`assembly`]) and shares with the
//! product only the beam element and the sparse solver, so that it is an independent check of everything between.

pub mod assembly;
pub mod monolithic;

pub use monolithic::{History, run};
