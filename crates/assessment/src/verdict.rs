//! What a criterion says of results.

use serde::{Deserialize, Serialize};

use crate::run::Basis;

/// The outcome.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// A limit is exceeded.
    Exceeded,
    /// All values keep the limit.
    Fulfilled,
    /// There is no limit; the value informs.
    Informative,
    /// There is no value; the reason says why.
    NotJudged,
}

impl Status {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exceeded => "exceeded",
            Self::Fulfilled => "fulfilled",
            Self::Informative => "informative",
            Self::NotJudged => "not-judged",
        }
    }
}

/// One criterion on one basis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Verdict {
    /// Id of the criterion.
    pub criterion: String,
    /// For people.
    pub title: String,
    /// The outcome.
    pub status: Status,
    /// The governing value.
    pub value: Option<f64>,
    /// The limit that applies to it.
    pub limit: Option<f64>,
    /// value/limit; none where the limit is 0 or a least value.
    pub utilisation: Option<f64>,
    /// Unit of value, limit and raw value.
    pub unit: String,
    /// The same of the same run without filter.
    pub raw: Option<f64>,
    /// Quantity that was judged.
    pub quantity: String,
    /// Statistic that was judged.
    pub statistic: String,
    /// Label of the filter; empty if it could not be made.
    pub filter: String,
    /// A part of the filter's rule was not known: the cut-off is assumed.
    pub filter_assumed: bool,
    /// Name of the grade of a scale.
    pub grade: Option<String>,
    /// Forces or vehicles, smooth or rough; none where nothing was judged.
    pub basis: Option<Basis>,
    /// Whether the code makes its check on this basis.
    pub in_basis: bool,
    /// Number of runs that were judged.
    pub runs: usize,
    /// The governing run.
    pub run_id: Option<String>,
    /// Its train.
    pub train: Option<String>,
    /// Its speed, km/h.
    pub speed_km_h: Option<f64>,
    /// Its variant.
    pub variant: Option<String>,
    /// Its seed.
    pub seed: Option<String>,
    /// Where.
    pub place: Option<String>,
    /// Abscissa, m.
    pub x_m: Option<f64>,
    /// When, s.
    pub time_s: Option<f64>,
    /// The highest speed so that every one up to it keeps the limit, km/h; none if the first does not.
    pub permissible_speed_km_h: Option<f64>,
    /// The lowest speed that does not keep it, km/h.
    pub first_exceeded_km_h: Option<f64>,
    /// Clause.
    pub clause: String,
    /// Edition.
    pub edition: String,
    /// `read`, `secondary` or `user`.
    pub verified: String,
    /// Where the numbers can be found.
    pub source: String,
    /// The limits file.
    pub limits: String,
    /// Why it is not judged, or what must be known beside it.
    pub reason: Option<String>,
    /// Note of the criterion.
    pub note: String,
}

/// verdicts.json.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Verdicts {
    /// Format of the file.
    pub version: u32,
    /// Limits files in the order in which they apply.
    pub limits: Vec<String>,
    /// What bridge and track were taken for.
    pub facts: crate::facts::Facts,
    /// Worst first.
    pub verdicts: Vec<Verdict>,
}

/// The present format of verdicts.json.
pub const VERSION: u32 = 1;

/// The JSON Schema of verdicts.json.
pub const SCHEMA: &str = include_str!("../data/verdicts.schema.json");

impl Verdicts {
    /// Criteria whose limit is exceeded.
    pub fn exceeded(&self) -> impl Iterator<Item = &Verdict> {
        self.verdicts.iter().filter(|verdict| verdict.status == Status::Exceeded)
    }
}
