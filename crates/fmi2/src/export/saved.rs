//! What an FMU state holds: dynamic state, inputs and the course of the simulation; factorised matrices are shared with the
//! model.

use ttb_contract::{Model, Snapshot};

/// The course of the simulation as the environment set it; saved and restored with an FMU state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// Start time in s.
    pub start: f64,
    /// Stop time in s, where the environment defined one.
    pub stop: Option<f64>,
    /// After `fmi2Terminate`.
    pub terminated: bool,
}

/// A saved instance.
pub struct SavedState<M: Model> {
    pub(super) snapshot: Snapshot<M>,
    pub(super) progress: Progress,
}
