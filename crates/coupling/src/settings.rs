//! What the user decides about the iteration.

use crate::predictor::Predictor;

/// What to do with a step that does not converge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnFailure {
    /// Report it and stop; the state at the step's beginning is restored.
    Stop,
    /// Repeat it in two halves, down to a sixteenth; then stop.
    Halve,
    /// Go on with the last trial and count it.
    Accept,
}

/// Settings of the iteration.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Aitken's relaxation, or the plain fixed point.
    pub aitken: bool,
    /// First trial.
    pub predictor: Predictor,
    /// On |r|, relative to max(|G|, `force_scale`).
    pub tolerance: f64,
    /// One axle load, N.
    pub force_scale: f64,
    /// k_max; 1 means one pass, without saving or restoring: bridge first, under the extrapolated forces.
    pub max_iterations: usize,
    /// Send forces as held means even to a bridge that can interpolate.
    pub hold_forces: bool,
    /// Policy for a step that does not converge.
    pub on_failure: OnFailure,
}
