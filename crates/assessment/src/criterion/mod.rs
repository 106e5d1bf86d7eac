//! Criteria: limits as data.
//!
//! ```text
//! limits file      code, edition, source, facts?, criteria: [ criterion … ]
//! criterion        quantity, statistic and filter name the rows it judges; cases give the limit
//! utilisation      value/limit;   fulfilled ⇔ value ≤ limit (at-most), value ≥ limit (at-least); no tolerance
//! ```

mod bundled;
mod chart;
mod keys;
mod problem;
mod read;
mod rule;

use serde::{Deserialize, Serialize};

pub use bundled::{DEFAULT, names, text};
pub use chart::Chart;
pub use problem::LimitsProblem;
pub use read::Criteria;
pub use rule::{CutOff, FilterRule, Limit, Place, ResolvedFilter};

use crate::facts::Facts;
use crate::peak::Statistic;
use crate::run::{Basis, Loads, Rail};

/// Which side of the limit is allowed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sense {
    /// The value must not be above the limit.
    #[default]
    AtMost,
    /// The value must not be below the limit.
    AtLeast,
}

/// A word of a basis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BasisWord {
    /// Moving forces.
    Forces,
    /// Vehicles.
    Vehicles,
    /// Smooth rail.
    Smooth,
    /// Rough rail.
    Rough,
}

impl BasisWord {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Forces => "forces",
            Self::Vehicles => "vehicles",
            Self::Smooth => "smooth",
            Self::Rough => "rough",
        }
    }
}

/// When a case applies; a key that is not there applies always.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct When {
    /// `ballast` or `ballastless`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub track: Option<String>,
    /// Up to this speed, km/h, it included.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_to_km_h: Option<f64>,
    /// The level of comfort that is asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub comfort_level: Option<String>,
}

/// A limit and when it applies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// When.
    #[serde(default)]
    pub when: When,
    /// The limit, in the criterion's unit.
    pub limit: Limit,
}

/// A grade of a scale.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grade {
    /// Up to this value; without, above all others.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<f64>,
    /// Its name.
    pub name: String,
}

/// One criterion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Criterion {
    /// Its key; unique in a set.
    pub id: String,
    /// For people.
    pub title: String,
    /// The quantity that it judges.
    pub quantity: String,
    /// Its statistic.
    pub statistic: Statistic,
    /// The filter that belongs to it.
    #[serde(default)]
    pub filter: FilterRule,
    /// On what the code makes this check; empty: on anything.
    #[serde(default)]
    pub basis: Vec<BasisWord>,
    /// Limits; the first that applies counts. Without, the value is informative.
    #[serde(default)]
    pub cases: Vec<Case>,
    /// Which side of the limit is allowed.
    #[serde(default)]
    pub sense: Sense,
    /// Names of a scale, rising.
    #[serde(default)]
    pub grades: Vec<Grade>,
    /// Unit of limit and value.
    pub unit: String,
    /// Clause of the code.
    pub clause: String,
    /// Edition; empty: that of the file.
    #[serde(default)]
    pub edition: String,
    /// Where the numbers can be found.
    #[serde(default)]
    pub source: String,
    /// `read`: the clause was read; `secondary`: known from other sources; `user`: the user's own.
    #[serde(default)]
    pub verified: String,
    /// For people.
    #[serde(default)]
    pub note: String,
    /// Why it is never judged by this program; the reason is part of the results.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub never: Option<String>,
    /// What a user can do where the quantity is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub needs: Option<String>,
    /// The name of its limits file.
    #[serde(default)]
    pub file: String,
}

impl Criterion {
    /// Whether the code makes its check on this.
    pub fn is_based_on(&self, basis: Basis) -> bool {
        let allowed = |word: BasisWord, other: BasisWord, is: bool| {
            let (word, other) = (self.basis.contains(&word), self.basis.contains(&other));
            // Neither or both: it does not matter.
            word == other || word == is
        };
        allowed(BasisWord::Forces, BasisWord::Vehicles, basis.loads == Loads::Forces)
            && allowed(BasisWord::Smooth, BasisWord::Rough, basis.rail == Rail::Smooth)
    }

    /// The case that applies to a run of this speed; `Err` with what would have to be known.
    ///
    /// # Errors
    /// A fact that the cases ask for is not known.
    pub fn case(&self, facts: &Facts, speed_km_h: Option<f64>) -> Result<Option<&Case>, String> {
        for case in &self.cases {
            let When { track, speed_to_km_h, comfort_level } = &case.when;
            if let Some(track) = track {
                let known =
                    facts.track.as_ref().ok_or("the type of track is not known: give `track` among the facts")?;
                if known != track {
                    continue;
                }
            }
            if let Some(level) = comfort_level {
                // The highest level is asked for unless the project says otherwise.
                if facts.comfort_level.as_deref().unwrap_or("very good") != level {
                    continue;
                }
            }
            if let Some(to) = speed_to_km_h
                && speed_km_h.ok_or("the speed is not known or not constant")? > *to
            {
                continue;
            }
            return Ok(Some(case));
        }
        Ok(None)
    }

    /// The grade of a value.
    pub fn grade(&self, value: f64) -> Option<&str> {
        self.grades.iter().find(|grade| grade.to.is_none_or(|to| value <= to)).map(|grade| grade.name.as_str())
    }
}
