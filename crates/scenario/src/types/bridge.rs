//! The bridge: what carries, damping, monitored points; spans of beams.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::frame::FrameChoice;
use super::model::Model;

/// Damping of the bridge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "kebab-case")]
#[schemars(deny_unknown_fields)]
pub enum Damping {
    /// No damping.
    None,
    /// C = αM + βK with the ratio met at two frequencies.
    Rayleigh {
        /// Damping ratio ζ, of 1.
        #[schemars(range(min = 0, max = 1))]
        ratio: f64,
        /// The two frequencies; absent: the first and four times it.
        #[serde(default)]
        at: RayleighAt,
    },
    /// The same ratio in the lowest modes, nothing in the others.
    Modal {
        /// Damping ratio ζ, of 1.
        #[schemars(range(min = 0, max = 1))]
        ratio: f64,
        /// Number of damped modes.
        #[schemars(range(min = 1, max = 1000))]
        modes: usize,
    },
}

/// Where Rayleigh damping meets its ratio.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RayleighAt {
    /// Two frequencies, Hz.
    Hz([f64; 2]),
    /// Two modes, counted from 1.
    Modes([usize; 2]),
    /// The first frequency and this multiple of it.
    FirstTimes(#[schemars(extend("exclusiveMinimum" = 1))] f64),
}

impl Default for RayleighAt {
    fn default() -> Self {
        Self::FirstTimes(4.0)
    }
}

/// What a name that becomes part of a variable's name looks like.
pub const NAME_PATTERN: &str = r"^[A-Za-z0-9_-]+$";

/// A monitored point: outputs `point[NAME].displacement`, `.velocity`, `.acceleration` and, on a deck, `.moment`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Point {
    /// Name: letters, digits, `-`, `_`.
    #[schemars(regex(pattern = NAME_PATTERN))]
    pub name: String,
    /// Distance from the bridge's begin along the deck, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x: Option<f64>,
    /// Or a node: its name in a frame, its number as text (`"4711"`) in a finite-element model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub node: Option<String>,
    /// Direction of the motion at a node: `z` (down, default), `x`, or in space `y`.
    #[serde(default)]
    pub direction: Direction,
}

/// Direction of a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Down.
    #[default]
    Z,
    /// Along the track.
    X,
    /// To the right; in finite-element models only.
    Y,
}

/// Where the track's supports over a bearing line go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum OverBearings {
    /// To the ground.
    #[default]
    Ground,
    /// To the deck (the abutment lines stay on the ground).
    Deck,
}

/// One span of a beam bridge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Span {
    /// Length of the span, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: f64,
    /// Bending stiffness EI, N m²; absent: by `first_frequency`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bending_stiffness: Option<f64>,
    /// First natural frequency n₀ of a simply supported span, Hz, in place of its bending stiffness.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub first_frequency: Option<f64>,
    /// Mass per length, dead loads included, kg/m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: f64,
    /// Shear stiffness κGA, N; absent: Euler–Bernoulli, present: Timoshenko.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_stiffness: Option<f64>,
    /// Number of beam elements; absent: 50.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 2, max = 100000))]
    pub elements: Option<usize>,
}

/// What carries.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "kebab-case")]
#[schemars(deny_unknown_fields)]
pub enum Structure {
    /// Spans of beams in a row, each simply supported, or continuous over the inner bearings.
    Beams {
        /// The spans in track order.
        #[schemars(length(min = 1))]
        spans: Vec<Span>,
        /// One continuous beam.
        #[serde(default)]
        continuous: bool,
        /// First natural frequency n₀ of a continuous beam, Hz: the bending stiffnesses of its spans, 1 where none is
        /// given, are multiplied so that it has this frequency.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(extend("exclusiveMinimum" = 0))]
        first_frequency: Option<f64>,
    },
    /// A plane frame with trusses and cables.
    Frame {
        /// The frame.
        frame: FrameChoice,
    },
    /// Matrices that another program wrote.
    Matrices {
        /// Their files, relative to the scenario.
        files: ttb_import::Files,
        /// Length of the bridge along the track, m: supports with 0 < x < length rest on it.
        #[schemars(extend("exclusiveMinimum" = 0))]
        length: f64,
    },
    /// Beams, trusses, cables and shells in space.
    FiniteElements {
        /// The model.
        model: ModelChoice,
    },
}

/// A finite-element model: its own file, or its data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ModelChoice {
    /// Path of its file, relative to the scenario.
    File(String),
    /// The model.
    Data(Box<Model>),
}

/// Solving in modes and pseudo-modes that answer static loads and single steps exactly; in space, above 600 forces of the
/// track and where damping is not light, in modes and local poles that answer single steps exactly.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct Reduction {
    /// Highest frequency of the modes, Hz; absent: raised from 30 Hz until `error` is met or 1600 vectors are reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub highest_frequency: Option<f64>,
    /// Greatest error of the deck's acceleration under a probe load, against all degrees of freedom, relative to the
    /// greatest acceleration.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 1))]
    pub error: f64,
}

impl Default for Reduction {
    fn default() -> Self {
        Self { highest_frequency: None, error: 0.05 }
    }
}

/// The bridge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Bridge {
    /// Abscissa of its begin (first abutment line), m.
    #[serde(default)]
    pub at: f64,
    /// What carries.
    pub structure: Structure,
    /// Damping of the bridge.
    pub damping: Damping,
    /// Points whose motion is recorded; absent: the middle of every span of beams.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<Vec<Point>>,
    /// Where the track's supports over inner bearings go.
    #[serde(default)]
    pub over_bearings: OverBearings,
    /// Solve in this many lowest modes instead of all degrees of freedom.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 1000))]
    pub modes: Option<usize>,
    /// Solve in a reduced model of stated error instead of all degrees of freedom.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reduction: Option<Reduction>,
}
