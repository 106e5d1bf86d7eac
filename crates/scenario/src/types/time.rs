//! The time axis: steps, sub-steps, end, Newmark's parameters.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Newmark's parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct Newmark {
    /// γ, from 1/2 on; above it, motions are damped numerically.
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
    /// The step itself, s.
    Seconds(f64),
}

/// The word `auto`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Auto {
    /// The step is chosen by the program.
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
#[serde(default)]
pub struct Time {
    /// Macro step h, s, or `auto`; absent: 1 ms.
    pub step: Step,
    /// Internal steps of train and track in each of them. More than one: the bridge moves under their mean forces, train
    /// and track on its motion interpolated (multi-time-step). Absent: 1, or chosen with the step.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 1000))]
    pub substeps: Option<usize>,
    /// With `auto`: greatest estimated error of a peak, relative to the greatest of its kind; absent: 0.02.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 1))]
    pub error: Option<f64>,
    /// End of the run, s; the last step is shortened to hit it; absent: the end of the free vibration.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub end: Option<f64>,
    /// How long the bridge is watched after the last wheel has left it, s; absent: until damping has halved its first mode,
    /// from 2 to 20 periods and at most 10 s.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1000))]
    pub free_vibration: Option<f64>,
    /// Newmark's parameters.
    pub newmark: Newmark,
}

impl Default for Time {
    fn default() -> Self {
        Self {
            step: Step::Seconds(1e-3),
            substeps: None,
            error: None,
            end: None,
            free_vibration: None,
            newmark: Newmark::default(),
        }
    }
}
