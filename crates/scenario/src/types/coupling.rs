//! Settings of the force-compatibility iteration.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the next trial force follows from the residual.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// λ ← G(λ): the paper's.
    FixedPoint,
    /// Aitken's dynamic relaxation.
    Aitken,
    /// Interface quasi-Newton with a least-squares model of the trials so far.
    IqnIls,
    /// Newton's method with an interface Jacobian identified once, corrected as the train moves.
    Newton,
    /// Quasi-Newton, and Newton once the trials show that its model pays.
    #[default]
    Auto,
}

/// First trial force of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Predictor {
    /// λ_n, the last one.
    Constant,
    /// 2 λ_n − λ_{n−1}, a straight line through the last two.
    #[default]
    Linear,
    /// Parabola through three.
    Quadratic,
    /// Cubic through four.
    Cubic,
}

/// How a trial force over the step is sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "Send")]
pub enum Sending {
    /// As rate to a bridge that declares canInterpolateInputs, else as mean.
    #[default]
    Auto,
    /// λ_n and the derivative (λ − λ_n)/h; refused where the bridge cannot interpolate.
    Rate,
    /// The held mean (λ_n + λ)/2.
    Mean,
}

/// What to do with a step whose iteration does not converge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum OnFailure {
    /// Stop with exit code 3; results so far are kept.
    #[default]
    Stop,
    /// Repeat it in two halves, down to a sixteenth of the step, then stop.
    Halve,
    /// Go on and count it.
    Accept,
}

/// The force-compatibility iteration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct CouplingSettings {
    /// Acceleration of the iteration.
    pub method: Method,
    /// Earlier steps whose trials quasi-Newton and Newton remember.
    #[schemars(range(max = 20))]
    pub reuse: usize,
    /// First trial force of a step.
    pub predictor: Predictor,
    /// ‖G(λ) − λ‖₂ ≤ tolerance · max(‖G(λ)‖₂, one axle load).
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 0.1))]
    pub tolerance: f64,
    /// Trials a step may take.
    #[schemars(range(min = 1, max = 1000))]
    pub max_iterations: usize,
    /// How trial forces are sent.
    pub send: Sending,
    /// Policy for a step that does not converge.
    pub on_failure: OnFailure,
}

impl Default for CouplingSettings {
    fn default() -> Self {
        Self {
            method: Method::Auto,
            reuse: 2,
            predictor: Predictor::Linear,
            tolerance: 1e-6,
            max_iterations: 30,
            send: Sending::Auto,
            on_failure: OnFailure::Stop,
        }
    }
}
