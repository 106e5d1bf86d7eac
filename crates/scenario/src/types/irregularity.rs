//! Track irregularity r(x), m, positive down.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::data::spectrum_names;

/// How an irregularity begins.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Ramp {
    /// Where it begins, m.
    pub start: f64,
    /// Over which length it grows to full size, m.
    #[schemars(range(min = 0))]
    pub length: f64,
    /// Shape over that length.
    #[serde(default)]
    pub shape: RampShape,
}

/// Shape of a ramp over s = 0…1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RampShape {
    /// 10 s³ − 15 s⁴ + 6 s⁵: continuous curvature.
    #[default]
    Quintic,
    /// ½ (1 − cos πs).
    Cosine,
}

/// One wave a sin(2π (x − origin)/λ + φ).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Wave {
    /// Amplitude a, m.
    pub amplitude: f64,
    /// Wavelength λ, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub wavelength: f64,
    /// Phase φ, rad.
    #[serde(default)]
    pub phase: f64,
}

/// Track irregularity.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "kebab-case")]
#[schemars(deny_unknown_fields)]
pub enum Irregularity {
    /// A smooth rail.
    #[default]
    None,
    /// A sum of sine waves.
    Harmonics {
        /// The waves.
        #[schemars(length(min = 1))]
        waves: Vec<Wave>,
        /// Abscissa from which the phases count, m.
        origin: f64,
        /// How they begin; absent: at full size everywhere.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        ramp: Option<Ramp>,
        /// Factor on all amplitudes.
        #[serde(default = "one")]
        scale: f64,
    },
    /// A random sample of a spectrum.
    Spectrum {
        /// Name of a bundled spectrum, such as `german-low`.
        #[schemars(extend("enum" = spectrum_names().collect::<Vec<_>>()))]
        spectrum: String,
        /// Seed of the random phases; an FMI Integer holds it.
        #[schemars(range(min = 0, max = 2147483647))]
        seed: u64,
        /// Shortest and longest wavelength, m.
        wavelengths: [f64; 2],
        /// How it begins; absent: faded in over 20 m from where the wheels' passage begins.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        ramp: Option<Ramp>,
        /// Factor on r.
        #[serde(default = "one")]
        scale: f64,
    },
    /// A measured profile: CSV with a header line and columns x (m) and r (m), x increasing.
    Measured {
        /// The file, relative to the scenario.
        file: String,
        /// How it begins; absent: as measured.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        ramp: Option<Ramp>,
        /// Factor on r.
        #[serde(default = "one")]
        scale: f64,
    },
}

fn one() -> f64 {
    1.0
}
