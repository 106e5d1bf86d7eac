//! Curves, wind and ground motion.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A curve with transitions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Curve {
    /// Radius, m; positive to the right, negative to the left.
    pub radius: f64,
    /// Where the first transition begins, m along the track.
    pub begin: f64,
    /// Where the last transition ends, m; absent: the curve goes on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<f64>,
    /// Length of a transition, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub transition: f64,
    /// How much the outer rail is above the inner one, m.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 0.3))]
    pub cant: f64,
}

/// Cross wind: a speed across the track and coefficients of a car.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Wind {
    /// Points (s, m/s) of the wind's speed across the track, positive to the right: the same on all cars.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub over_time: Option<Vec<[f64; 2]>>,
    /// Or points (m along the track, m/s): a gust that the train drives through.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub over_place: Option<Vec<[f64; 2]>>,
    /// Density of the air, kg/m³.
    #[serde(default = "air")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: f64,
    /// Reference area of a car, m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub area: f64,
    /// Reference length of the moment, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: f64,
    /// Height above the rail's top of the point that the moment is about, m.
    #[serde(default)]
    pub moment_height: f64,
    /// File of coefficients over the angle between wind and train: CSV with columns `beta_deg`, `side`, `lift`, `roll`,
    /// relative to the scenario. Lift is positive up, the roll moment positive to leeward.
    pub coefficients: String,
}

/// Motion of the ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct GroundMotion {
    /// CSV with columns `t` (s) and `acceleration_y`, `acceleration_z` (m/s², one of them may be absent), relative to the
    /// scenario; y to the right, z down.
    pub file: String,
    /// Factor on the accelerations.
    #[serde(default = "one")]
    pub scale: f64,
    /// When the file's time 0 is, s after the start.
    #[serde(default)]
    pub start: f64,
    /// Add the straight line to the accelerations with which the ground ends at rest where it began.
    #[serde(default = "yes")]
    pub baseline: bool,
}

fn air() -> f64 {
    1.225
}
fn one() -> f64 {
    1.0
}
fn yes() -> bool {
    true
}
