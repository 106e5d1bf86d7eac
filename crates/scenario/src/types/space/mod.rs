//! What a run in space has beside a plane one: the key `space` of a scenario, and of a car.

mod car;
mod contact;
mod loads;
mod track;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::irregularity::{Ramp, Wave};
use crate::data::space_spectrum_names;

pub use car::*;
pub use contact::*;
pub use loads::*;
pub use track::*;

/// The run in space: cars of 35 degrees of freedom on two rails, with creep and flanges. `{}` takes every default.
/// Vertical values stand in the plane keys, summed over both sides.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct Space {
    /// Wheel–rail contact.
    pub contact: ContactInSpace,
    /// Rails, fasteners and sleepers beside their vertical values.
    pub track: TrackInSpace,
    /// Alignment, cross-level and gauge; absent: those of the spectrum of the key `irregularity`, if it is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub irregularity: Option<IrregularityInSpace>,
    /// A curve; absent: straight track.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub curve: Option<Curve>,
    /// Cross wind.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wind: Option<Wind>,
    /// Motion of the ground under the track's supports and the bridge's bearings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ground_motion: Option<GroundMotion>,
}

/// Irregularity beside the level of the key `irregularity`. a_L, a_R: lateral, to the right; r_L, r_R: down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "kebab-case")]
#[schemars(deny_unknown_fields)]
pub enum IrregularityInSpace {
    /// None beside the level.
    None,
    /// Sums of sine waves.
    Harmonics {
        /// Alignment (a_L + a_R)/2.
        #[serde(default)]
        alignment: Vec<Wave>,
        /// Cross-level r_R − r_L.
        #[serde(default)]
        cross_level: Vec<Wave>,
        /// Gauge a_R − a_L.
        #[serde(default)]
        gauge: Vec<Wave>,
        /// Abscissa from which the phases count, m.
        #[serde(default)]
        origin: f64,
        /// How they begin; absent: at full size everywhere.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        ramp: Option<Ramp>,
    },
    /// Random samples of a spectrum's components, with phases of their own from one seed.
    Spectrum {
        /// Name of a bundled spectrum that has lateral components.
        #[schemars(extend("enum" = space_spectrum_names().collect::<Vec<_>>()))]
        spectrum: String,
        /// Seed of the random phases; an FMI Integer holds it. Where the level is random too, it must be its seed.
        #[schemars(range(min = 0, max = 2147483647))]
        seed: u64,
        /// Shortest and longest wavelength, m.
        wavelengths: [f64; 2],
        /// How it begins; absent: faded in over 20 m from where the wheels' passage begins.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        ramp: Option<Ramp>,
    },
    /// Measured: CSV with a header line and columns `x`, `alignment`, `cross_level`, `gauge` (m), x increasing. With a column
    /// `level` it replaces the key `irregularity`.
    Measured {
        /// The file, relative to the scenario.
        file: String,
        /// How it begins; absent: as measured.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        ramp: Option<Ramp>,
    },
}

impl Space {
    /// The files that it names, each with what it is read as.
    pub fn files_mut(&mut self) -> impl Iterator<Item = (&'static str, &mut String)> {
        let profile = match &mut self.irregularity {
            Some(IrregularityInSpace::Measured { file, .. }) => Some(("profile in space", file)),
            _ => None,
        };
        let wind = self.wind.as_mut().map(|wind| ("wind coefficients", &mut wind.coefficients));
        let ground = self.ground_motion.as_mut().map(|ground| ("ground motion", &mut ground.file));
        [profile, wind, ground].into_iter().flatten()
    }
}
