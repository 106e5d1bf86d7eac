//! Wheel–rail contact in space.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::data::{rail_profile_names, wheel_profile_names};

/// Contact of a wheel with two patches, tread and flange, and creep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct ContactInSpace {
    /// Wheel profile.
    pub wheel: WheelProfile,
    /// Profile of the rail's head.
    pub rail: RailProfile,
    /// Distance of the wheels' inner faces, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub back_to_back: f64,
    /// Half the distance of the wheels' taping lines, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub taping_line: f64,
    /// Coefficient of friction μ.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub friction: f64,
    /// Law of creep.
    pub creep: Creep,
    /// Length ε over which the contact moves smoothly from place to place, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub softness: f64,
    /// Fixed Hertz constant G of one wheel, m/N^{2/3}; absent: by Hertz's theory from the curvatures in contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hertz_constant: Option<f64>,
    /// Young's modulus of wheel and rail, N/m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub modulus: f64,
    /// Poisson's ratio of wheel and rail.
    #[schemars(range(min = 0.0, max = 0.5))]
    pub poisson: f64,
}

impl Default for ContactInSpace {
    fn default() -> Self {
        Self {
            wheel: WheelProfile::Named("s1002".into()),
            rail: RailProfile::Named("60e1".into()),
            back_to_back: 1.36,
            taping_line: 0.75,
            friction: 0.3,
            creep: Creep::Shen,
            softness: 20e-6,
            hertz_constant: None,
            modulus: 2.1e11,
            poisson: 0.28,
        }
    }
}

/// Law of creep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Creep {
    /// Kalker's linear coefficients, without a limit.
    Linear,
    /// The same, saturated after Shen, Hedrick and Elkins.
    #[default]
    Shen,
    /// Kalker's FASTSIM: slower; a yardstick for the others.
    Fastsim,
    /// No creep forces.
    None,
}

/// A wheel profile by name, or its points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum WheelProfile {
    /// Name of a bundled profile.
    Named(#[schemars(extend("enum" = wheel_profile_names().collect::<Vec<_>>()))] String),
    /// Points.
    Points(Points),
}

/// A rail profile by name, or its points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum RailProfile {
    /// Name of a bundled profile.
    Named(#[schemars(extend("enum" = rail_profile_names().collect::<Vec<_>>()))] String),
    /// Points.
    Points(Points),
}

/// A measured profile: points (outwards, down) in mm, the first coordinate rising; a spline smooths them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Points {
    /// Of a wheel from its taping line outwards (the flange is negative) and down; of a rail from its axis outwards and down
    /// from its top, upright. mm.
    #[schemars(length(min = 8))]
    pub points_mm: Vec<[f64; 2]>,
}

/// A profile's shape, mm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProfileShape {
    /// Curves end to end, from the inside (flange) outwards.
    PiecesMm(Vec<ProfilePiece>),
    /// Measured points (outwards, down).
    PointsMm(Vec<[f64; 2]>),
}

/// A piece of a profile over the outward coordinate s, mm; z is down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProfilePiece {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// z(s).
    pub curve: ProfileCurve,
}

/// z(s) of a piece, mm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProfileCurve {
    /// c₀ + c₁ s + c₂ s² + …
    Polynomial(Vec<f64>),
    /// z = z_c ± √(R² − (s − s_c)²): [s_c, z_c, R, ±1]; +1 is the lower half of the circle.
    Arc([f64; 4]),
}
