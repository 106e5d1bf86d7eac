//! A vehicle as a list of bodies, wheels and links: articulated sets, wagons of any number of axles, quarter cars.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bridge::NAME_PATTERN;

/// How a body moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BodyFreedom {
    /// Up and down.
    Bounce,
    /// About its centre of gravity; θ > 0 lowers its front.
    Pitch,
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Body {
    /// Name, unique in the vehicle: links name it, and outputs of bodies after the first.
    #[schemars(regex(pattern = NAME_PATTERN))]
    pub name: String,
    /// Mass, kg.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: f64,
    /// Pitch inertia about its centre of gravity, kg m².
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub inertia: f64,
    /// Its centre of gravity, m behind the vehicle's front end.
    pub x: f64,
    /// How it moves; absent: bounce and, with an inertia, pitch.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1, max = 2))]
    pub freedoms: Option<Vec<BodyFreedom>>,
}

/// A wheelset. Without mass and links it is a force alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Wheel {
    /// Its place, m behind the vehicle's front end.
    pub x: f64,
    /// Mass, kg.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub mass: f64,
    /// Force on it beside all weights, N.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub load: f64,
}

/// A spring with a dashpot beside it, between a body and another body or a wheel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Link {
    /// What it joins: names of bodies, or `wheel1`, `wheel2`, … from the front.
    pub between: [String; 2],
    /// Where, m behind the vehicle's front end; absent: over the wheel, or at the second body's centre of gravity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x: Option<f64>,
    /// Stiffness, N/m.
    #[schemars(range(min = 0))]
    pub stiffness: f64,
    /// Damping, N s/m.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub damping: f64,
}

/// A vehicle of any bodies, wheels and links. Places are counted backwards from its front end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Vehicle {
    /// Name for messages.
    #[serde(default)]
    pub name: String,
    /// Wheels from the front.
    #[schemars(length(min = 1))]
    pub wheels: Vec<Wheel>,
    /// Bodies; the first one gives the outputs of the car.
    #[serde(default)]
    pub bodies: Vec<Body>,
    /// Springs and dashpots.
    #[serde(default)]
    pub links: Vec<Link>,
    /// Length over couplers, m: the pitch to the next vehicle; absent: as far behind the last wheel as the first one is behind
    /// the front end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: Option<f64>,
    /// Where the data come from.
    #[serde(default)]
    pub source: String,
}

impl Vehicle {
    /// Forces alone: (m behind the first one, N).
    #[must_use]
    pub fn of_forces(forces: &[[f64; 2]]) -> Self {
        let wheels = forces.iter().map(|[x, load]| Wheel { x: *x, mass: 0.0, load: *load }).collect();
        Self { name: String::new(), wheels, bodies: Vec::new(), links: Vec::new(), length: None, source: String::new() }
    }

    /// Length over couplers, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        let [first, last] = [self.wheels.first(), self.wheels.last()].map(|wheel| wheel.map_or(0.0, |wheel| wheel.x));
        self.length.unwrap_or(last + first)
    }
}
