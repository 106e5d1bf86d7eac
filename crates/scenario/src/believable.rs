//! Limits beyond which a result cannot be believed: data, each with its source.

use std::sync::LazyLock;

use serde::Deserialize;

use crate::ranges::file;

/// A limit of the greatest amount of a quantity.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Believable {
    /// Key of the quantity, such as `deck.displacement`.
    pub what: String,
    /// For people.
    pub name: String,
    /// What the limit is multiplied by: `span` (the longest, m), `axle load` (static, N), or nothing.
    pub relative_to: String,
    /// The limit, relative or in the quantity's SI unit.
    pub at_most: f64,
    /// The limit in words.
    pub meant: String,
    /// The question to ask.
    pub slip: String,
    /// Where the limit comes from.
    pub source: String,
    /// How well that is known.
    pub verified: String,
}

#[derive(Deserialize)]
struct Limits {
    limits: Vec<Believable>,
}

static LIMITS: LazyLock<Vec<Believable>> =
    LazyLock::new(|| serde_json::from_str::<Limits>(file("results")).map(|all| all.limits).unwrap_or_default());

/// All of them.
#[must_use]
pub fn believable() -> &'static [Believable] {
    &LIMITS
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_limit_has_a_source() {
        assert!(believable().len() >= 6);
        assert!(
            believable()
                .iter()
                .all(|limit| limit.at_most > 0.0 && limit.source.len() > 10 && !limit.verified.is_empty())
        );
    }
}
