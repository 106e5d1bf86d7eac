//! Parameters of the two FMUs.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the FMUs of a run are given, whether they are built or brought along.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct Fmus {
    /// The train–track FMU.
    pub train_track: FmuSettings,
    /// The bridge FMU, or all of them; a map's parameters come after these.
    pub bridge: FmuSettings,
}

/// What one FMU is given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct FmuSettings {
    /// Parameters and start values by name, in the FMU's own units, set before initialization.
    pub parameters: BTreeMap<String, ParameterValue>,
}

/// A parameter's value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ParameterValue {
    /// For a Boolean.
    Boolean(bool),
    /// For a Real, an Integer, an enumeration.
    Number(f64),
    /// For a String.
    Text(String),
}

impl Fmus {
    /// Whether nothing is given.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl std::fmt::Display for ParameterValue {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Boolean(truth) => truth.fmt(f),
            Self::Number(number) => number.fmt(f),
            Self::Text(text) => write!(f, "\"{text}\""),
        }
    }
}
