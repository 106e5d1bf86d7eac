//! How a foreign bridge's variables belong to ours: the file `ttb inspect --map` proposes.
//!
//! ```json
//! {
//!   "force":        { "name": "f[{i}]",        "first": 0, "factor": 1e-3 },
//!   "displacement": { "name": "Deck.uz_{i}",   "first": 0, "factor": -1e3 },
//!   "velocity":     null
//! }
//! ```
//!
//! Our variables are `support[k].force`, `.displacement` and `.velocity` for k = 1 … n in track order, in N, m and m/s,
//! down positive. Theirs for support k has the number `first + k - 1` in place of `{i}`, and for all three
//!
//! ```text
//! their value = factor · our value
//! ```
//!
//! so 1e-3 stands for kN, 1e3 for mm, a negative factor for up positive. Without `velocity` the two cannot be coupled: the track's
//! dashpots need it.

use std::path::Path;

use serde::{Deserialize, Serialize};
use ttb_fmi2::import::{Linear, ModelDescription, VariableType};

use crate::connect::{Wire, Wiring};
use crate::error::Error;

/// The place of the number in a name.
pub const INDEX: &str = "{i}";

/// The whole map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Map {
    /// Inputs of the bridge: forces on the deck.
    pub force: Series,
    /// Outputs: the deck's displacements under the supports.
    pub displacement: Series,
    /// Outputs: their velocities; may be absent.
    #[serde(default)]
    pub velocity: Option<Series>,
}

/// A series of variables with a running number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Series {
    /// Name with `{i}` in place of the number.
    pub name: String,
    /// The number at our first support.
    #[serde(default = "one")]
    pub first: i64,
    /// Their value = factor · our value.
    #[serde(default = "unity")]
    pub factor: f64,
}

fn one() -> i64 {
    1
}

fn unity() -> f64 {
    1.0
}

impl Series {
    /// Their name for our support k = 1 … n.
    pub fn at(&self, k: usize) -> String {
        self.name.replacen(INDEX, &(self.first + k as i64 - 1).to_string(), 1)
    }
}

/// Missing names told one by one.
const TOLD: usize = 10;

impl Map {
    /// Reads the file.
    pub fn load(path: &Path) -> Result<Self, Error> {
        let text = std::fs::read_to_string(path).map_err(|e| Error::Input(format!("{}: {e}", path.display())))?;
        let map: Self = serde_json::from_str(&text).map_err(|e| Error::Input(format!("{}: {e}", path.display())))?;
        for (key, series) in map.series() {
            let rule = if !series.name.contains(INDEX) {
                format!("name must contain {INDEX}: `{}`", series.name)
            } else if !(series.factor.is_finite() && series.factor != 0.0) {
                format!("factor must be finite and not 0: {}", series.factor)
            } else {
                continue;
            };
            return Err(Error::Input(format!("{}: $.{key}: {rule}", path.display())));
        }
        Ok(map)
    }

    fn series(&self) -> impl Iterator<Item = (&'static str, &Series)> {
        let velocity = self.velocity.iter().map(|series| ("velocity", series));
        [("force", &self.force), ("displacement", &self.displacement)].into_iter().chain(velocity)
    }

    /// Connections between our train–track FMU and their bridge.
    pub fn wiring(&self, train_track: &ModelDescription, bridge: &ModelDescription) -> Result<Wiring, Error> {
        let Some(velocity) = &self.velocity else {
            return Err(Error::Input(
                "the map has no velocity: the track's dashpots need the velocities of the deck as outputs of the bridge".into(),
            ));
        };
        let supports = (1..).take_while(|k| has(train_track, &ours(*k, "force"), "output")).count();
        let (mut wiring, mut missing) = (Wiring { forces: Vec::new(), motions: Vec::new() }, Vec::new());
        let mut find = |name: String, causality: &str| {
            if !has(bridge, &name, causality) {
                missing.push(format!("{causality} {name}"));
            }
            name
        };
        for k in 1..=supports {
            wiring.forces.push(Wire {
                output: ours(k, "force"),
                input: find(self.force.at(k), "input"),
                from_output: Linear::IDENTITY,
                to_input: Linear { factor: self.force.factor, offset: 0.0 },
            });
        }
        for (what, series) in [("displacement", &self.displacement), ("velocity", velocity)] {
            for k in 1..=supports {
                wiring.motions.push(Wire {
                    output: find(series.at(k), "output"),
                    input: ours(k, what),
                    from_output: Linear { factor: series.factor.recip(), offset: 0.0 },
                    to_input: Linear::IDENTITY,
                });
            }
        }
        if supports == 0 || !missing.is_empty() {
            let more = missing.len().saturating_sub(TOLD);
            missing.truncate(TOLD);
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            return Err(Error::Input(format!(
                "{}: {supports} supports are mapped, but it has no {}{more}",
                bridge.model_name,
                missing.join(", ")
            )));
        }
        Ok(wiring)
    }
}

fn ours(k: usize, what: &str) -> String {
    format!("support[{k}].{what}")
}

fn has(description: &ModelDescription, name: &str, causality: &str) -> bool {
    description.with_causality(causality).any(|v| v.name == name && v.kind == VariableType::Real)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_follow_the_number_and_defaults_are_ours() {
        let text =
            r#"{ "force": { "name": "f[{i}]", "first": 0, "factor": 1e-3 }, "displacement": { "name": "u_{i}" } }"#;
        let map: Map = serde_json::from_str(text).unwrap();
        assert_eq!([map.force.at(1), map.force.at(12), map.displacement.at(3)], ["f[0]", "f[11]", "u_3"]);
        assert_eq!((map.displacement.factor, map.velocity.is_none()), (1.0, true));
        assert!(serde_json::from_str::<Map>(&text.replace("first", "frist")).is_err());
    }
}
