//! What the user decides about the iteration.

use crate::predictor::Predictor;

/// How the next trial follows from the residual.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// λ ← G(λ): the paper's.
    FixedPoint,
    /// Aitken's dynamic relaxation.
    Aitken,
    /// Interface quasi-Newton.
    IqnIls,
    /// Newton's method with a Jacobian identified once.
    Newton,
    /// Quasi-Newton, and Newton once the trials show that its model pays.
    #[default]
    Auto,
    /// No iteration, as for a bridge that cannot roll back: see [`crate::explicit`].
    Explicit,
}

impl Method {
    /// Its name in scenario files and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::FixedPoint => "fixed-point",
            Self::Aitken => "aitken",
            Self::IqnIls => "iqn-ils",
            Self::Newton => "newton",
            Self::Auto => "auto",
            Self::Explicit => "explicit",
        }
    }
}

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
    /// Acceleration.
    pub method: Method,
    /// Earlier steps whose trials the quasi-Newton methods remember.
    pub reuse: usize,
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
    /// The train–track subsystem's coupled outputs are means over the step (of its sub-steps), not end values: they go to
    /// the bridge as they are, held.
    pub mean_forces: bool,
    /// Policy for a step that does not converge.
    pub on_failure: OnFailure,
}
