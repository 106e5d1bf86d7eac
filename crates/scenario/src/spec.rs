//! A checked scenario with every reference resolved: what the physics is built from, and what lies in an FMU's resources.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::ground::GroundSeries;
use crate::types::{
    self, Car, Contact, Damping, Frame, Model, Newmark, Point, RailPoint, Ramp, Reduction, TrackType, Wave,
};
use crate::vehicle::Equations;

mod space;

pub use space::*;

/// All the train–track subsystem is built from (`resources/train-track.json`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainTrackSpec {
    /// Cars from the front; empty if a vehicle of the train is something else.
    pub cars: Vec<Car>,
    /// All vehicles from the front, if not all of them are cars; else empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub vehicles: Vec<Vehicle>,
    /// Abscissa of the leading wheel at the start, m.
    pub front_wheel: f64,
    /// Speed points (time s after the start, m/s), at least one, times increasing.
    pub speed: Vec<[f64; 2]>,
    /// Pre-roll of the cars, m.
    pub pre_roll: f64,
    /// Wheel–rail contact.
    pub contact: Contact,
    /// Rail, supports, spacing.
    pub track: TrackType,
    /// Abscissa of the first support, m.
    pub from: f64,
    /// Number of bays.
    pub bays: usize,
    /// Rail elements per bay.
    pub elements_per_bay: usize,
    /// Whether the rail yields locally under a load inside an element.
    pub local_compliance: bool,
    /// The supports (0-based, in the order of those of the bridge) that rest on it; the others rest on the ground.
    pub on_bridge: Vec<usize>,
    /// Track irregularity.
    pub irregularity: Profile,
    /// Factor on the irregularity.
    pub irregularity_scale: f64,
    /// Monitored points of the rail.
    pub rail_points: Vec<RailPoint>,
    /// Macro step, s.
    pub step: f64,
    /// Internal steps in each of them.
    pub substeps: usize,
    /// End of the run, s.
    pub end: f64,
    /// Newmark's parameters.
    pub newmark: Newmark,
    /// What only a run in space has; absent: the run is plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub space: Option<SpaceSpec>,
}

/// What a train is made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Vehicle {
    /// A car of 10 degrees of freedom.
    Car(Car),
    /// Bodies, wheels and links.
    Bodies(types::Vehicle),
}

impl Vehicle {
    /// Length over couplers, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        match self {
            Self::Car(car) => car.length,
            Self::Bodies(vehicle) => vehicle.length(),
        }
    }

    /// Number of its wheelsets.
    #[must_use]
    pub fn wheels(&self) -> usize {
        match self {
            Self::Car(_) => 4,
            Self::Bodies(vehicle) => vehicle.wheels.len(),
        }
    }

    /// Static load in N and mass in kg of every wheelset; none of a vehicle that cannot be built.
    #[must_use]
    pub fn axles(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Car(car) => vec![[car.axle_load(), car.wheelset_mass]; 4],
            Self::Bodies(vehicle) => {
                let loads = Equations::new(vehicle).map(|equations| equations.loads).unwrap_or_default();
                loads.iter().zip(&vehicle.wheels).map(|(load, wheel)| [*load, wheel.mass]).collect()
            }
        }
    }
}

impl TrainTrackSpec {
    /// All vehicles from the front.
    #[must_use]
    pub fn consist(&self) -> Vec<Vehicle> {
        if self.vehicles.is_empty() {
            self.cars.iter().cloned().map(Vehicle::Car).collect()
        } else {
            self.vehicles.clone()
        }
    }

    /// Length of the whole train over couplers, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.consist().iter().map(Vehicle::length).sum()
    }

    /// Number of wheelsets.
    #[must_use]
    pub fn axle_count(&self) -> usize {
        self.consist().iter().map(Vehicle::wheels).sum()
    }
}

/// A resolved irregularity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case")]
pub enum Profile {
    /// A smooth rail.
    None,
    /// Waves a sin(2π (x − origin)/λ + φ).
    Waves {
        /// The waves.
        waves: Vec<Wave>,
        /// Abscissa from which the phases count, m.
        origin: f64,
        /// How they begin.
        ramp: Option<Ramp>,
    },
    /// A random sample of a power spectral density, drawn when the model is built (the seed is a parameter).
    Spectrum {
        /// S(Ω), one-sided.
        density: Density,
        /// Seed of the random phases.
        seed: u64,
        /// Shortest and longest wavelength, m.
        wavelengths: [f64; 2],
        /// How it begins; `None`: over 20 m where the wheels' passage begins.
        ramp: Option<Ramp>,
    },
    /// Samples (x, r), x increasing, m; constant outside.
    Samples {
        /// Abscissae, m, rising.
        x: Vec<f64>,
        /// Values r there, m.
        r: Vec<f64>,
        /// How it begins.
        ramp: Option<Ramp>,
    },
}

/// A one-sided power spectral density.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "form", rename_all = "kebab-case")]
pub enum Density {
    /// S(Ω) = A Ω_c² / [(Ω² + Ω_r²)(Ω² + Ω_c²)], m²/(rad/m).
    German {
        /// A, m rad.
        a: f64,
        /// Ω_c, rad/m.
        omega_c: f64,
        /// Ω_r, rad/m.
        omega_r: f64,
    },
    /// S(Ω) = A Ω_c² Ω² / [(Ω² + Ω_r²)(Ω² + Ω_c²)(Ω² + Ω_s²)], m²/(rad/m): cross-level and gauge.
    GermanTwist {
        /// A, m rad: of the difference of both rails.
        a: f64,
        /// Ω_c, rad/m.
        omega_c: f64,
        /// Ω_r, rad/m.
        omega_r: f64,
        /// Ω_s, rad/m.
        omega_s: f64,
    },
    /// S(n) = A / (1 + n/n₀)³, m²/(1/m), n in 1/m.
    Sncf {
        /// A, m³.
        a: f64,
        /// n₀, 1/m.
        n0: f64,
    },
    /// S(n) = A_i / n^{k_i} in mm²/(1/m) on pieces of n in 1/m.
    PowerLaws {
        /// Pieces (upper limit of n, A_i, k_i); the last limit is infinite (`null`).
        pieces: Vec<(Option<f64>, f64, f64)>,
    },
}

/// All the bridge subsystem is built from (`resources/bridge.json`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BridgeSpec {
    /// What carries.
    pub structure: StructureSpec,
    /// Damping of the bridge.
    pub damping: Damping,
    /// Solve in this many modes; `None`: all degrees of freedom.
    pub modes: Option<usize>,
    /// Solve in a reduced model of stated error; `None`: not.
    pub reduction: Option<Reduction>,
    /// Where the track's supports stand on the deck, m from the bridge's begin, increasing.
    pub supports: Vec<f64>,
    /// Monitored points.
    pub points: Vec<Point>,
    /// Macro step, s.
    pub step: f64,
    /// End of the run, s.
    pub end: f64,
    /// Newmark's parameters.
    pub newmark: Newmark,
    /// Whether supports move, and take forces, in space.
    #[serde(default, skip_serializing_if = "is_false")]
    pub space: bool,
    /// Motion of the ground under its bearings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ground: Option<GroundSeries>,
    /// How far the monitored points go along with the ground across and down, where an FMU's resources hold no model.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ground_points: Vec<[f64; 2]>,
}

fn is_false(value: &bool) -> bool {
    !value
}

/// One span of a beam bridge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Span {
    /// Length of the span, m.
    pub length: f64,
    /// Bending stiffness EI, N m².
    pub bending_stiffness: f64,
    /// Mass per length, dead loads included, kg/m.
    pub mass: f64,
    /// Shear stiffness κGA, N; absent: Euler–Bernoulli, present: Timoshenko.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shear_stiffness: Option<f64>,
    /// Number of beam elements.
    pub elements: usize,
}

/// What carries, references resolved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case")]
pub enum StructureSpec {
    /// Spans of beams.
    Beams {
        /// Spans in track order.
        spans: Vec<Span>,
        /// Continuous over the inner bearings.
        continuous: bool,
    },
    /// A plane frame.
    Frame(Frame),
    /// Elements in space.
    FiniteElements(Box<Model>),
    /// Matrices from files.
    Matrices {
        /// The files.
        files: ttb_import::Files,
        /// Folder that their paths are relative to; where it lies decides nothing.
        #[serde(skip)]
        folder: PathBuf,
        /// Length along the track, m.
        length: f64,
    },
    /// Matrices or a reduced model in a file beside this specification.
    Stored,
}
