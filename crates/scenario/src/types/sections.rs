//! Materials and sections of a finite-element model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A linear elastic material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Name, by which sections refer to it.
    pub name: String,
    /// Modulus of elasticity E, N/m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub modulus: f64,
    /// Poisson's ratio ν.
    #[serde(default)]
    #[schemars(range(min = 0, max = 0.499))]
    pub poisson: f64,
    /// Density ρ, kg/m³.
    #[schemars(range(min = 0))]
    pub density: f64,
}

/// Cross-section of beams, trusses and cables. The local axis 1 runs along the element, 2 and 3 across it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LineSection {
    /// Name, by which elements refer to it.
    pub name: String,
    /// Name of its material.
    pub material: String,
    /// Cross-sectional area A, m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub area: f64,
    /// Second moment of area about the local axis 2 (bending in the plane 1–3), m⁴; beams only.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub inertia_2: f64,
    /// Second moment of area about the local axis 3 (bending in the plane 1–2), m⁴; beams only.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub inertia_3: f64,
    /// Torsion constant, m⁴; beams only.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub torsion: f64,
    /// Shear area along axis 2, m²; absent: Euler–Bernoulli in the plane 1–2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_area_2: Option<f64>,
    /// Shear area along axis 3, m²; absent: Euler–Bernoulli in the plane 1–3.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_area_3: Option<f64>,
    /// Non-structural mass, kg/m.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub added_mass: f64,
}

/// Thickness and material of shells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShellSection {
    /// Name, by which elements refer to it.
    pub name: String,
    /// Name of its material.
    pub material: String,
    /// Thickness t, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub thickness: f64,
    /// Non-structural mass, kg/m².
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub added_mass: f64,
}
