//! Time, coupling and output settings, and the scenario as a whole.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bridge::Bridge;
use super::irregularity::Irregularity;
use super::track::Track;
use super::train::{Contact, Train};

/// Newmark's parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct Newmark {
    /// γ ≥ 1/2.
    #[schemars(range(min = 0.5, max = 1))]
    pub gamma: f64,
    /// β > 0; unconditionally stable for β ≥ γ/2; (γ + 1/2)²/4 damps high frequencies most.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 1))]
    pub beta: f64,
}

impl Default for Newmark {
    fn default() -> Self {
        Self { gamma: 0.5, beta: 0.25 }
    }
}

/// The macro step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Step {
    /// Chosen before the run.
    Chosen(Auto),
    /// s.
    Seconds(f64),
}

/// The word `auto`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Auto {
    /// `auto`.
    #[serde(rename = "auto")]
    Auto,
}

impl Step {
    /// The step that is given, s.
    #[must_use]
    pub fn given(self) -> Option<f64> {
        match self {
            Self::Chosen(_) => None,
            Self::Seconds(h) => Some(h),
        }
    }
}

impl JsonSchema for Step {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Step".into()
    }
    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "description": "The macro step: seconds, or `auto`.", "anyOf": [
            { "type": "string", "const": "auto", "description": "Chosen before the run, by frequencies and a probe." },
            { "type": "number", "exclusiveMinimum": 0, "description": "s." },
        ] })
    }
}

/// Time axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Time {
    /// Step h, s, or `auto`.
    pub step: Step,
    /// Internal steps of train and track in each of them. More than one: the bridge moves under their mean forces, train
    /// and track on its motion interpolated (multi-time-step). Absent: 1, or chosen with the step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 1000))]
    pub substeps: Option<usize>,
    /// With `auto`: greatest estimated error of a peak, relative to the greatest of its kind; absent: 0.02.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 1))]
    pub error: Option<f64>,
    /// End of the run, s; the last step is shortened to hit it.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub end: f64,
    /// Newmark's parameters.
    #[serde(default)]
    pub newmark: Newmark,
}

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
    /// λ_n.
    Constant,
    /// 2 λ_n − λ_{n−1}.
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
    /// First trial.
    pub predictor: Predictor,
    /// ‖G(λ) − λ‖₂ ≤ tolerance · max(‖G(λ)‖₂, one axle load).
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 0.1))]
    pub tolerance: f64,
    /// Trials per step.
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

/// What goes into results.csv.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct Output {
    /// Every how many steps a row is written.
    #[schemars(range(min = 1))]
    pub every: usize,
    /// Also the force, displacement and velocity of every support.
    pub supports: bool,
}

impl Default for Output {
    fn default() -> Self {
        Self { every: 1, supports: false }
    }
}

/// A complete run: train, track, bridge, irregularity, time, coupling, output. SI units; z positive down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Scenario {
    /// JSON Schema of this file, for editors; ignored.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// One line for people.
    #[serde(default)]
    pub title: String,
    /// The train.
    pub train: Train,
    /// Wheel–rail contact.
    #[serde(default)]
    pub contact: Contact,
    /// The track.
    pub track: Track,
    /// Track irregularity.
    #[serde(default)]
    pub irregularity: Irregularity,
    /// The bridge.
    pub bridge: Bridge,
    /// Time axis.
    pub time: Time,
    /// The iteration.
    #[serde(default)]
    pub coupling: CouplingSettings,
    /// Results.
    #[serde(default)]
    pub output: Output,
}
