//! What the user decides about the iteration.

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
    /// No iteration, as for a bridge that cannot roll back: see [`crate::scheme::explicit`].
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

/// First trial λ⁰ of a step: the polynomial through as many accepted forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Predictor {
    /// λ_n.
    Constant,
    /// Through λ_n, λ_{n−1}.
    Linear,
    /// Through λ_n … λ_{n−2}.
    Quadratic,
    /// Through λ_n … λ_{n−3}.
    Cubic,
}

impl Predictor {
    /// Forces the polynomial goes through.
    pub(crate) fn points(self) -> usize {
        match self {
            Self::Constant => 1,
            Self::Linear => 2,
            Self::Quadratic => 3,
            Self::Cubic => 4,
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

/// Settings of the iteration. The scale of forces, one axle load, is a property of the ports.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Acceleration.
    pub method: Method,
    /// Earlier steps whose trials the quasi-Newton methods remember.
    pub reuse: usize,
    /// First trial.
    pub predictor: Predictor,
    /// On |r|, relative to max(|G|, one axle load).
    pub tolerance: f64,
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
