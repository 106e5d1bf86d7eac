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
//! so 1e-3 stands for kN, 1e3 for mm, a negative factor for up positive. Without `velocity` the master has to
//! differentiate displacements.

use serde::{Deserialize, Serialize};

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
    #[allow(dead_code)] // for whoever couples by a map
    pub fn at(&self, k: usize) -> String {
        self.name.replacen(INDEX, &(self.first + k as i64 - 1).to_string(), 1)
    }
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
