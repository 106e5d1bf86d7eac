//! Rules that become numbers when the bridge is known: cut-off frequencies, limits.
//!
//! ```text
//! f_c = max(30 Hz, 1.5 n₀, f₃)      "max_of": [30, {"times_f1": 1.5}, {"frequency_of_mode": 3}]
//! ```
//!
//! A part that is not known is left out, and the filter is marked as assumed.

use serde::{Deserialize, Serialize};

use super::chart::{Chart, of_comfort};
use crate::facts::Facts;
use crate::filter::{Filter, Phase, Weighting};

/// A frequency by a rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum CutOff {
    /// Hz.
    Given(f64),
    /// The greatest of several.
    Greatest {
        /// Of these.
        max_of: Vec<CutOff>,
    },
    /// A multiple of n₀.
    First {
        /// Factor.
        times_f1: f64,
    },
    /// The frequency of a mode, 1 or 3.
    Mode {
        /// Its number.
        frequency_of_mode: u32,
    },
}

impl CutOff {
    /// Hz, and whether a part was not known; `None` if all were not.
    fn resolve(&self, facts: &Facts) -> (Option<f64>, bool) {
        let known = |value: Option<f64>| (value, value.is_none());
        match self {
            Self::Given(hz) => (Some(*hz), false),
            Self::First { times_f1 } => known(facts.n0_hz.map(|n0| times_f1 * n0)),
            Self::Mode { frequency_of_mode: 1 } => known(facts.n0_hz),
            Self::Mode { frequency_of_mode: 3 } => known(facts.third_mode_hz),
            Self::Mode { .. } => (None, true),
            Self::Greatest { max_of } => {
                let parts: Vec<_> = max_of.iter().map(|part| part.resolve(facts)).collect();
                let greatest = parts.iter().filter_map(|(hz, _)| *hz).reduce(f64::max);
                (greatest, parts.iter().any(|(_, assumed)| *assumed))
            }
        }
    }
}

/// A filter by a rule.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case", deny_unknown_fields)]
pub enum FilterRule {
    /// None.
    #[default]
    Raw,
    /// Butterworth low-pass.
    Butterworth {
        /// Order of one pass.
        order: usize,
        /// Direction.
        phase: Phase,
        /// Cut-off.
        cut_off_hz: CutOff,
    },
    /// Mean over a length of way.
    SlidingMean {
        /// m.
        length_m: f64,
    },
    /// Weighting of human response.
    Weighting {
        /// Which.
        curve: Weighting,
    },
}

/// A filter whose numbers are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResolvedFilter {
    /// The filter.
    pub filter: Filter,
    /// Whether a part of its rule was not known.
    pub assumed: bool,
}

impl FilterRule {
    /// With this bridge's numbers; the cut-off is rounded to 1 mHz. `None` where nothing of its rule is known.
    pub fn resolve(&self, facts: &Facts) -> Option<ResolvedFilter> {
        let known = |filter| Some(ResolvedFilter { filter, assumed: false });
        match self {
            Self::Raw => known(Filter::Raw),
            Self::SlidingMean { length_m } => known(Filter::SlidingMean { length_m: *length_m }),
            Self::Weighting { curve } => known(Filter::Weighting { curve: *curve }),
            Self::Butterworth { order, phase, cut_off_hz } => {
                let (hz, assumed) = cut_off_hz.resolve(facts);
                let cut_off_hz = (hz? * 1e3).round() / 1e3;
                Some(ResolvedFilter {
                    filter: Filter::Butterworth { order: *order, cut_off_hz, phase: *phase },
                    assumed,
                })
            }
        }
    }
}

/// What the limit of a value may depend on beside the bridge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    /// Abscissa, m from the begin of the deck.
    pub x: Option<f64>,
    /// Speed of the run, or of the line, km/h.
    pub speed_km_h: Option<f64>,
    /// The value of the train standing.
    pub static_value: Option<f64>,
}

/// A limit by a rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Limit {
    /// In the criterion's unit.
    Given(f64),
    /// A limit that the code has, and the user must give: what to give.
    User {
        /// For people.
        user: String,
    },
    /// A table over span and speed.
    Chart {
        /// The table.
        chart: Chart,
        /// Whether the values apply as they are. Otherwise they are those of EN 1990 figure A2.3 (three simple spans or more,
        /// very good comfort), and the rules of A2.4.4.3.2 for other bridges and levels are applied.
        #[serde(default)]
        as_given: bool,
    },
    /// The span over a number; of several spans that in which the value is, else the shortest.
    Span {
        /// The number.
        span_over: f64,
    },
    /// The static value and something more, and not above an upper bound.
    Static {
        /// Added to the static value.
        static_plus: f64,
        /// The upper bound.
        at_most: f64,
    },
}

impl Limit {
    /// With this bridge's numbers and those of a value.
    ///
    /// # Errors
    /// What would have to be known.
    pub fn resolve(&self, facts: &Facts, place: &Place) -> Result<f64, String> {
        let span = || facts.span_at(place.x).ok_or("the spans are not known: give `spans_m` among the facts");
        match self {
            Self::Given(limit) => Ok(*limit),
            Self::User { user } => Err(user.clone()),
            Self::Span { span_over } => Ok(span()? / span_over),
            Self::Chart { chart, as_given } => {
                let speed = place.speed_km_h.ok_or("the speed is not known: give `line_speed_km_h` among the facts")?;
                let value = chart.at(span()?, speed)?;
                Ok(if *as_given { value } else { value * of_comfort(facts) })
            }
            Self::Static { static_plus, at_most } => {
                let own = place.static_value.ok_or("the static value is not known")?;
                Ok(at_most.min(own + static_plus))
            }
        }
    }
}
