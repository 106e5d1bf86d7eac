//! What a map consists of: series of variables, places along the track, values of parameters.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ttb_coupling::Shape;
use ttb_fmi::description::ModelDescription;
pub use ttb_scenario::types::ParameterValue as Value;

/// The place of the number in a name.
pub const INDEX: &str = "{i}";

/// Variables with a running number, or one by one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Series {
    /// Name with `{i}` in place of the number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The number at the first place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first: Option<i64>,
    /// Or all names in track order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub names: Vec<String>,
    /// Their value = factor · our value; absent: by the unit they declare.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub factor: Option<f64>,
}

/// Positions along the track, m from the bridge's begin in the scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Places {
    /// One by one.
    List(Vec<f64>),
    /// Equally spaced; as many as there are variables.
    Even(Even),
    /// Parameters or outputs of the FMU.
    Read(Read),
}

/// Equally spaced places, m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Even {
    /// The first.
    pub from: f64,
    /// From each to the next.
    pub spacing: f64,
}

/// Places that the FMU knows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Read {
    /// Name with `{i}` in place of the number.
    pub name: String,
    /// The number at the first place.
    #[serde(default = "one")]
    pub first: i64,
    /// Their value = factor · metres; absent: by the unit they declare.
    #[serde(default)]
    pub factor: Option<f64>,
    /// Added to what is read, m.
    #[serde(default)]
    pub offset: f64,
}

/// Shape of the deck between stations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Interpolation {
    /// Straight lines.
    Linear,
    /// Cubics through four stations.
    #[default]
    Cubic,
}

fn one() -> i64 {
    1
}

impl From<Interpolation> for Shape {
    fn from(interpolation: Interpolation) -> Self {
        match interpolation {
            Interpolation::Linear => Self::Linear,
            Interpolation::Cubic => Self::Cubic,
        }
    }
}

impl Series {
    /// Their name at place k = 1 … n; none beyond a list's end.
    pub fn at(&self, k: usize) -> Option<String> {
        match &self.name {
            Some(name) => Some(numbered(name, self.first.unwrap_or(1), k)),
            None => self.names.get(k - 1).cloned(),
        }
    }

    /// How many of them an FMU has, from the first on.
    pub fn count(&self, description: &ModelDescription) -> usize {
        let has = |k: &usize| self.at(*k).is_some_and(|name| description.variable(&name).is_some());
        (1..).take_while(has).count()
    }

    /// What is wrong with it.
    pub(super) fn problem(&self) -> Option<String> {
        match (&self.name, self.names.is_empty(), self.first, self.factor) {
            (Some(_), false, ..) => Some("give name or names, not both".into()),
            (None, true, ..) => Some("needs a name with {i}, or names".into()),
            (Some(name), true, ..) if !name.contains(INDEX) => Some(format!("name must contain {INDEX}: `{name}`")),
            (_, _, Some(first), _) if !counts(first) => Some(uncounted(first)),
            (None, false, Some(_), _) => Some("first belongs to a name with {i}, not to names".into()),
            (.., Some(factor)) if !factor.is_finite() || factor == 0.0 => {
                Some(format!("factor must be finite and not 0: {factor}"))
            }
            _ => None,
        }
    }
}

impl Read {
    /// Their name at place k = 1 … n.
    pub fn at(&self, k: usize) -> String {
        numbered(&self.name, self.first, k)
    }
}

/// Numbers that variables may begin with.
const COUNTED: u64 = 1_000_000_000;

/// Whether a number may be a first one.
pub(super) fn counts(first: i64) -> bool {
    first.unsigned_abs() <= COUNTED
}

/// What is wrong with one that may not.
pub(super) fn uncounted(first: i64) -> String {
    format!("first must be a number between -{COUNTED} and {COUNTED}: {first}")
}

fn numbered(name: &str, first: i64, k: usize) -> String {
    name.replacen(INDEX, &(first + k as i64 - 1).to_string(), 1)
}
