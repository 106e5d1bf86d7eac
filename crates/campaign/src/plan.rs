//! A plan: what is varied, resolved; its runs follow in a fixed order.
//!
//! ```text
//! runs    trains × variants × rails × speeds, the last varying fastest; a train ends at its own greatest speed
//! ```
//!
//! Runs are not stored: the axes give them again, with the same ids.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use ttb_scenario::types::Heading;

use crate::error::Error;
use crate::foreign::Foreign;
use crate::identity;
use crate::list::tidy;

/// Name of the file.
pub const FILE: &str = "plan.json";
/// Format of the file; another one is refused.
pub const FORMAT: u32 = 1;

/// How runs are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Way {
    /// Axle loads on the modes of the bridge.
    Modal,
    /// Axle loads by superposition of the passage of one axle.
    OneAxle,
    /// Both sides iterated, as `ttb run` does.
    Coupled,
}

impl Way {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Modal => "modal",
            Self::OneAxle => "one-axle",
            Self::Coupled => "coupled",
        }
    }
}

impl std::fmt::Display for Way {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// What runs over the bridge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Load {
    /// Axle loads: distance behind the first axle, m, and load, N.
    Axles(Vec<[f64; 2]>),
    /// Vehicles: names of bundled cars and trains from the front.
    Cars(Vec<String>),
    /// The vehicles of the scenario.
    Scenario,
}

/// A train of the plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Train {
    /// Its name in tables.
    pub name: String,
    /// Its own greatest speed, km/h.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_speed_km_h: Option<f64>,
    /// What it is.
    pub load: Load,
    /// In which direction it crosses the bridge.
    #[serde(default, skip_serializing_if = "Heading::is_forward")]
    pub heading: Heading,
}

impl Train {
    /// Distance of its last axle from the first, m; `None` where only the scenario knows it.
    pub fn length(&self) -> Option<f64> {
        match &self.load {
            Load::Axles(axles) => Some(axles.iter().fold(0.0, |most, axle| axle[0].max(most))),
            _ => None,
        }
    }
}

/// A change of the scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// Its name in tables; empty: the scenario as it is.
    #[serde(default)]
    pub name: String,
    /// Factor on all mass of the bridge.
    #[serde(default = "one")]
    pub mass_factor: f64,
    /// Factor on all stiffness of the bridge.
    #[serde(default = "one")]
    pub stiffness_factor: f64,
    /// Keys of the scenario and their values, in this order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub set: Vec<(String, Value)>,
}

fn one() -> f64 {
    1.0
}

impl Default for Variant {
    fn default() -> Self {
        Self { name: String::new(), mass_factor: 1.0, stiffness_factor: 1.0, set: Vec::new() }
    }
}

/// The rail's irregularity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rail {
    /// As the scenario has it.
    Scenario,
    /// None.
    Smooth,
    /// The scenario's spectrum with another seed.
    Seed(u64),
}

impl std::fmt::Display for Rail {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Scenario => Ok(()),
            Self::Smooth => f.write_str("smooth"),
            Self::Seed(seed) => seed.fmt(f),
        }
    }
}

/// A resolved plan, as it is stored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// [`FORMAT`].
    pub format: u32,
    /// Version of the program.
    pub version: String,
    /// The scenario file, from the campaign's folder.
    pub scenario: String,
    /// SHA-256 of what the scenario means.
    pub scenario_sha256: String,
    /// Keys of the scenario that have other values in all runs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub set: Vec<(String, Value)>,
    /// FMUs of other programs in the place of the scenario's bridge, in track order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bridges: Vec<Foreign>,
    /// How runs are computed.
    pub way: Way,
    /// Whether resonances are refined.
    pub refine: bool,
    /// Whether moments, shears and reactions are looked at, too (modal way).
    #[serde(default)]
    pub forces: bool,
    /// Trains.
    pub trains: Vec<Train>,
    /// Changes of the scenario.
    pub variants: Vec<Variant>,
    /// Irregularities.
    pub rails: Vec<Rail>,
    /// Speeds, km/h, rising; common to all trains. Empty: the scenario's own.
    pub speeds_km_h: Vec<f64>,
    /// Limits by which results are judged: name and content of each file. Empty: the bundled ones.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<[String; 2]>,
    /// What of the reduced values depends on limits: quantities, statistics and filters that they ask for. Empty: those of the
    /// bundled ones.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub values: String,
}

/// One run.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Follows from what decides the result.
    pub id: String,
    /// Position of its train in the plan.
    pub train: usize,
    /// Position of its variant.
    pub variant: usize,
    /// Irregularity.
    pub rail: Rail,
    /// Speed, km/h; `None`: the scenario's own.
    pub speed_km_h: Option<f64>,
    /// Whether it was asked for by the refinement.
    pub refined: bool,
}

impl Run {
    /// Speed, m/s.
    pub fn speed(&self) -> Option<f64> {
        self.speed_km_h.map(|speed| speed / 3.6)
    }
}

impl Plan {
    /// All runs in their order, without those that a refinement adds.
    pub fn runs(&self) -> Vec<Run> {
        let mut runs = Vec::new();
        for train in 0..self.trains.len() {
            for variant in 0..self.variants.len() {
                for rail in &self.rails {
                    if self.speeds_km_h.is_empty() {
                        runs.push(self.run(train, variant, *rail, None, false));
                    }
                    for speed in self.speeds(train) {
                        runs.push(self.run(train, variant, *rail, Some(speed), false));
                    }
                }
            }
        }
        runs
    }

    /// The speeds of a train, km/h: up to its own greatest, which belongs to them.
    pub fn speeds(&self, train: usize) -> impl Iterator<Item = f64> + '_ {
        let most = self.trains[train].max_speed_km_h.unwrap_or(f64::INFINITY);
        let cut = self.speeds_km_h.iter().any(|speed| *speed > most) && !self.speeds_km_h.contains(&most);
        let own = self.speeds_km_h.iter().copied().filter(move |speed| *speed <= most);
        let first = self.speeds_km_h.first().copied();
        own.chain(first.filter(|first| cut && *first < most).map(|_| tidy(most)))
    }

    /// A run with its id.
    pub fn run(&self, train: usize, variant: usize, rail: Rail, speed_km_h: Option<f64>, refined: bool) -> Run {
        let (Train { load, heading, .. }, of) = (&self.trains[train], &self.variants[variant]);
        let factors = [of.mass_factor, of.stiffness_factor].map(f64::to_bits);
        let usual = heading.is_forward() && self.values.is_empty();
        let decides = (
            (&self.version, &self.scenario_sha256, self.way, self.forces),
            (load, factors, &of.set, rail, speed_km_h.map(f64::to_bits)),
        );
        let bridges: Vec<_> = self.bridges.iter().map(Foreign::decides).collect();
        let id = match (bridges.is_empty(), usual) {
            (false, _) => identity::of(&(decides, heading, &self.values, bridges)),
            (true, true) => identity::of(&decides),
            (true, false) => identity::of(&(decides, heading, &self.values)),
        };
        Run { id, train, variant, rail, speed_km_h, refined }
    }

    /// Train, variant and rail for people, as far as they have names.
    pub fn title(&self, train: usize, variant: usize, rail: Rail) -> String {
        let parts = [&self.trains[train].name, &self.variants[variant].name, &rail.to_string()];
        parts.into_iter().filter(|part| !part.is_empty()).cloned().collect::<Vec<_>>().join(", ")
    }

    /// Reads a stored plan.
    ///
    /// # Errors
    /// It is no plan of this format.
    pub fn parse(text: &str, name: &str) -> Result<Self, Error> {
        let plan: Self = serde_json::from_str(text).map_err(|error| Error::Input(format!("{name}: {error}")))?;
        if plan.format != FORMAT {
            let format = plan.format;
            return Err(Error::Input(format!("{name}: format must be {FORMAT}: {format}; another version wrote it")));
        }
        Ok(plan)
    }

    /// As it is stored.
    ///
    /// # Errors
    /// Not enough memory.
    pub fn text(&self) -> Result<String, Error> {
        let text = serde_json::to_string_pretty(self).map_err(|error| Error::Input(error.to_string()))?;
        Ok(text + "\n")
    }
}
