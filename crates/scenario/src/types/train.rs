//! Train, contact and speed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::space::CarInSpace;
use super::vehicle::Vehicle;
use crate::data::train_names;

/// One car with 10 degrees of freedom. Springs and dashpots are those of a whole bogie (secondary) or a whole
/// wheelset (primary), both sides summed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Car {
    /// Name for messages and the summary.
    #[serde(default)]
    pub name: String,
    /// Mass of the body M_c, kg.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub body_mass: f64,
    /// Pitch inertia of the body J_c, kg m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub body_inertia: f64,
    /// Mass of a bogie M_b, kg.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bogie_mass: f64,
    /// Pitch inertia of a bogie J_b, kg m².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bogie_inertia: f64,
    /// Mass of a wheelset M_w, kg.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub wheelset_mass: f64,
    /// Secondary stiffness k_s, N/m per bogie.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub secondary_stiffness: f64,
    /// Secondary damping c_s, N s/m per bogie.
    #[schemars(range(min = 0))]
    pub secondary_damping: f64,
    /// Primary stiffness k_p, N/m per axle.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub primary_stiffness: f64,
    /// Primary damping c_p, N s/m per axle.
    #[schemars(range(min = 0))]
    pub primary_damping: f64,
    /// Distance of the bogies' centres 2 L_c, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bogie_distance: f64,
    /// Distance of a bogie's axles 2 L_t, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub wheelbase: f64,
    /// Length over couplers, m: the pitch to the next car.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: f64,
    /// What it has in space; only together with the scenario's key `space`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub space: Option<Box<CarInSpace>>,
    /// Where the data come from.
    #[serde(default)]
    pub source: String,
}

/// A bundled car by name, or its data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum CarChoice {
    /// Name of a bundled car, such as `ice3-motor`, or of a bundled train, which stands for all its cars.
    Bundled(#[schemars(extend("enum" = train_names().collect::<Vec<_>>()))] String),
    /// The car's data.
    Data(Box<Car>),
    /// A vehicle of bodies, wheels and links.
    Vehicle(Box<Vehicle>),
}

/// Forces in place of cars.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Forces {
    /// Name of a train of forces, such as `hslm-a3`, or a file of one.
    Named(String),
    /// Axles: m behind the first one, N.
    Axles(#[schemars(length(min = 1))] Vec<[f64; 2]>),
}

/// Train speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Speed {
    /// Constant, km/h.
    #[serde(rename = "km_h")]
    KmH(#[schemars(range(min = 0, max = 1000))] f64),
    /// Constant, m/s.
    #[serde(rename = "m_s")]
    MS(#[schemars(range(min = 0, max = 300))] f64),
    /// Points (time s, speed m/s), linear in between, constant outside.
    #[serde(rename = "profile")]
    Profile(#[schemars(length(min = 1))] Vec<[f64; 2]>),
}

/// The train: cars from the front, and how it runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Train {
    /// Cars, the leading one first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub cars: Option<Vec<CarChoice>>,
    /// Or forces alone, without masses under them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub forces: Option<Forces>,
    /// Abscissa of the leading wheel at the start, m; absent: half a second's run before the bridge, at least 20 m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub front_wheel: Option<f64>,
    /// Train speed.
    pub speed: Speed,
    /// In which direction it crosses the bridge.
    #[serde(default, skip_serializing_if = "Heading::is_forward")]
    pub heading: Heading,
    /// Distance in m over which the cars alone are rolled over the irregularity, on the track's static stiffness,
    /// before the run starts, so that they do not ring from a start at rest; 0: start at rest; absent: what the train runs
    /// in five seconds where the rail is irregular, else 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 10000))]
    pub pre_roll: Option<f64>,
}

/// Direction of a train.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Heading {
    /// The first axle enters at the bridge's begin.
    #[default]
    Forward,
    /// The first axle enters at the bridge's end. Abscissae of train, track and rail count along the run as ever, from the
    /// bridge's end at `bridge.at`; those of the bridge and its points count from its begin. A wave or a measured rail stays
    /// where it lies; a random one is drawn along the run.
    Backward,
}

impl Heading {
    /// Whether it is the usual one.
    #[must_use]
    pub fn is_forward(&self) -> bool {
        *self == Self::Forward
    }
}

/// Law of the wheel–rail contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ContactLaw {
    /// F = (δ/G)^{3/2} for δ > 0, else 0.
    #[default]
    Hertz,
    /// The Hertz law's tangent at the static wheel load, cut at 0.
    Linear,
}

/// Wheel–rail contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct Contact {
    /// Nonlinear Hertz with lift-off, or its linearisation.
    pub law: ContactLaw,
    /// Contacts that share an axle's load: 2 wheels (default), or 1.
    #[schemars(range(min = 1, max = 2))]
    pub wheels_per_axle: u32,
    /// Hertz constant G, m/N^{2/3}; if absent, from the tread and the wheel radius.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hertz_constant: Option<f64>,
    /// Tread: worn G = 3.86e-8 R^-0.115, conical G = 4.57e-8 R^-0.149.
    pub tread: Tread,
    /// Wheel radius R, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub wheel_radius: f64,
}

/// Wheel tread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Tread {
    /// Worn profile.
    #[default]
    Worn,
    /// Conical profile.
    Conical,
}

impl Contact {
    /// G, m/N^{2/3}: as given, or by tread and wheel radius.
    #[must_use]
    pub fn constant(&self) -> f64 {
        let r = self.wheel_radius;
        self.hertz_constant.unwrap_or_else(|| match self.tread {
            Tread::Worn => 3.86e-8 * libm::pow(r, -0.115),
            Tread::Conical => 4.57e-8 * libm::pow(r, -0.149),
        })
    }
}

impl Car {
    /// Static load of an axle, N.
    #[must_use]
    pub fn axle_load(&self) -> f64 {
        ttb_contract::GRAVITY * (0.25 * self.body_mass + 0.5 * self.bogie_mass + self.wheelset_mass)
    }
}

impl Default for Contact {
    fn default() -> Self {
        Self {
            law: ContactLaw::Hertz,
            wheels_per_axle: 2,
            hertz_constant: None,
            tread: Tread::Worn,
            wheel_radius: 0.46,
        }
    }
}
