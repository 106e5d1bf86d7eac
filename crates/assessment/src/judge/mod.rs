//! Criteria applied to results: one verdict a criterion and basis.
//!
//! ```text
//! rows of the criterion's quantity, statistic and filter, of runs of one basis
//!   └─ each with the limit of its own speed ──► the row of the greatest utilisation governs
//! permissible speed: the highest v so that every speed up to v keeps the limit, all trains, variants and seeds
//! ```
//!
//! Static load models are a basis of their own: their values belong to no run, and their speed is that of the line.

mod blank;

use std::collections::BTreeSet;

use crate::criterion::{BasisWord, Criteria, Criterion, Place, ResolvedFilter, Sense};
use crate::facts::Facts;
use crate::filter::RAW;
use crate::peak::Peak;
use crate::run::{Basis, Missing, Results, Run};
use crate::statics::{Derived, Loaded, derive};
use crate::verdict::{Status, VERSION, Verdict, Verdicts};

/// Judges results; worst verdicts first.
pub fn judge(criteria: &Criteria, facts: &Facts, results: &Results) -> Verdicts {
    let facts = facts.overruled_by(&criteria.facts);
    let bases: BTreeSet<Basis> = results.runs.iter().map(|run| run.basis).collect();
    let derived = derive(&facts, results);
    let fastest = results.runs.iter().filter_map(|run| run.speed_km_h).reduce(f64::max);
    let line_speed = facts.line_speed_km_h.or(fastest);
    let mut verdicts = Vec::new();
    for criterion in &criteria.all {
        verdicts.extend(Judge { criterion, facts: &facts, results, derived: &derived, line_speed }.all(&bases));
    }
    // Stable: equal ones stay in the order of the files.
    verdicts.sort_by(|a: &Verdict, b: &Verdict| {
        let worst = |v: &Verdict| -v.utilisation.unwrap_or(f64::NEG_INFINITY);
        a.status.cmp(&b.status).then(worst(a).total_cmp(&worst(b)))
    });
    Verdicts { version: VERSION, limits: criteria.files.clone(), facts, verdicts }
}

/// One criterion at work.
struct Judge<'a> {
    criterion: &'a Criterion,
    facts: &'a Facts,
    results: &'a Results,
    derived: &'a Derived,
    /// km/h.
    line_speed: Option<f64>,
}

/// What a value belongs to.
#[derive(Clone, Copy)]
enum By<'a> {
    Run(&'a Run),
    Load(&'a Loaded),
}

/// A value and what it belongs to.
type Row<'a> = (By<'a>, &'a Peak);

/// A row with its limit.
struct Judged<'a> {
    by: By<'a>,
    peak: &'a Peak,
    limit: Option<f64>,
    utilisation: Option<f64>,
    kept: bool,
}

impl<'a> Judge<'a> {
    fn all(&self, bases: &BTreeSet<Basis>) -> Vec<Verdict> {
        if let Some(reason) = &self.criterion.never {
            return vec![self.not_judged(reason.clone(), None)];
        }
        let Some(filter) = self.criterion.filter.resolve(self.facts) else {
            return vec![self.not_judged("the frequencies of the bridge are not known".into(), None)];
        };
        let mut found: Vec<Verdict> = bases.iter().filter_map(|basis| self.on(Some(*basis), filter)).collect();
        let in_basis = found.iter().any(|verdict| verdict.in_basis);
        found.extend(self.on(None, filter));
        // What load models decide needs no run.
        let own = in_basis || found.iter().any(|verdict| verdict.basis.is_none());
        if found.is_empty() {
            return vec![self.not_judged(self.why_missing(filter), Some(filter))];
        }
        if !own {
            let said = |word: &BasisWord| match word {
                BasisWord::Forces => "moving forces",
                BasisWord::Vehicles => "vehicles",
                BasisWord::Smooth => "on a smooth rail",
                BasisWord::Rough => "on a rough rail",
            };
            let words: Vec<&str> = self.criterion.basis.iter().map(said).collect();
            let words = words.join(" ");
            let reason = format!(
                "the code makes this check with {words}, and there is no such run; another basis is judged apart"
            );
            found.push(self.not_judged(reason, Some(filter)));
        }
        found
    }

    /// On one basis, `None` being the load models; `None` without rows.
    fn on(&self, basis: Option<Basis>, filter: ResolvedFilter) -> Option<Verdict> {
        let label = filter.filter.label();
        let rows: Vec<Row> = match basis {
            Some(basis) => {
                self.rows(&label).filter(|(run, _)| run.basis == basis).map(|(r, p)| (By::Run(r), p)).collect()
            }
            None => self.of_loads(&label).collect(),
        };
        let mut judged = Vec::with_capacity(rows.len());
        for (by, peak) in &rows {
            match self.limit(*by, peak) {
                Ok(limit) => judged.push(self.judged(*by, peak, limit)),
                Err(reason) => {
                    let mut verdict = self.not_judged(reason, Some(filter));
                    self.governed_by(&mut verdict, self.worst(&rows)?);
                    return Some(verdict);
                }
            }
        }
        let governing = judged.iter().reduce(|worst, one| if self.is_worse(one, worst) { one } else { worst })?;
        let status = match (governing.limit, judged.iter().all(|one| one.kept)) {
            (None, _) => Status::Informative,
            (Some(_), true) => Status::Fulfilled,
            (Some(_), false) => Status::Exceeded,
        };
        let mut verdict = self.empty(Some(filter));
        verdict.status = status;
        verdict.limit = governing.limit;
        verdict.utilisation = governing.utilisation;
        verdict.runs = judged.iter().filter_map(Judged::run_id).collect::<BTreeSet<_>>().len();
        if filter.assumed {
            verdict.reason =
                Some("the frequencies of the bridge are not known: the cut-off of the filter is assumed".into());
        }
        self.governed_by(&mut verdict, (governing.by, governing.peak));
        if governing.limit.is_some() {
            (verdict.permissible_speed_km_h, verdict.first_exceeded_km_h) = permissible(&judged);
        }
        Some(verdict)
    }

    fn is_asked(&self, peak: &Peak, label: &str) -> bool {
        peak.quantity == self.criterion.quantity && peak.statistic == self.criterion.statistic && peak.filter == label
    }

    /// Values of runs, derived ones behind the others.
    fn rows<'b>(&'b self, label: &'b str) -> impl Iterator<Item = (&'a Run, &'a Peak)> + 'b {
        let (results, derived) = (self.results, self.derived);
        let all = results.rows.iter().chain(&derived.of_runs);
        all.filter(move |(_, peak)| self.is_asked(peak, label)).map(move |(run, peak)| (&results.runs[*run], peak))
    }

    fn of_loads<'b>(&'b self, label: &'b str) -> impl Iterator<Item = Row<'a>> + 'b {
        let derived = self.derived;
        let asked = derived.of_loads.iter().filter(move |loaded| self.is_asked(&loaded.peak, label));
        asked.map(|loaded| (By::Load(loaded), &loaded.peak))
    }

    fn limit(&self, by: By, peak: &Peak) -> Result<Option<f64>, String> {
        let speed_km_h = match by {
            By::Run(run) => run.speed_km_h,
            By::Load(_) => self.line_speed,
        };
        let place = Place { x: peak.x, speed_km_h, static_value: peak.static_value };
        match self.criterion.case(self.facts, speed_km_h)? {
            Some(case) => case.limit.resolve(self.facts, &place).map(Some),
            None if self.criterion.cases.is_empty() => Ok(None),
            None => Err("no limit is known for this track, speed or level of comfort".into()),
        }
    }

    fn judged<'b>(&self, by: By<'b>, peak: &'b Peak, limit: Option<f64>) -> Judged<'b> {
        let value = peak.value;
        let kept = limit.is_none_or(|limit| match self.criterion.sense {
            Sense::AtMost => value <= limit,
            Sense::AtLeast => value >= limit,
        });
        let utilisation = match (limit, self.criterion.sense) {
            (Some(limit), Sense::AtMost) if limit > 0.0 => Some(value / limit),
            (Some(limit), Sense::AtLeast) if value > 0.0 && limit > 0.0 => Some(limit / value),
            _ => None,
        };
        Judged { by, peak, limit, utilisation, kept }
    }

    /// Whether `a` is worse than `b`: by utilisation, else by value.
    fn is_worse(&self, a: &Judged, b: &Judged) -> bool {
        match (a.utilisation, b.utilisation) {
            (Some(a), Some(b)) => a > b,
            _ => self.is_beyond(a.peak.value, b.peak.value),
        }
    }

    fn is_beyond(&self, a: f64, b: f64) -> bool {
        match self.criterion.sense {
            Sense::AtMost => a > b,
            Sense::AtLeast => a < b,
        }
    }

    fn worst(&self, rows: &[Row<'a>]) -> Option<Row<'a>> {
        rows.iter().copied().reduce(|worst, one| if self.is_beyond(one.1.value, worst.1.value) { one } else { worst })
    }

    fn governed_by(&self, verdict: &mut Verdict, (by, peak): Row) {
        verdict.value = Some(peak.value);
        verdict.unit.clone_from(&self.criterion.unit);
        verdict.grade = self.criterion.grade(peak.value).map(str::to_string);
        verdict.place = Some(format!("{} {}", peak.place_kind, peak.place).trim().to_string());
        verdict.x_m = peak.x;
        verdict.time_s = peak.time;
        let run = match by {
            By::Run(run) => run,
            By::Load(loaded) => {
                verdict.train = Some(loaded.load.clone());
                verdict.reason = Some(match verdict.reason.take() {
                    Some(reason) => format!("{reason}; {}", loaded.note),
                    None => loaded.note.clone(),
                });
                return;
            }
        };
        verdict.raw = self
            .rows(RAW)
            .filter(|(other, _)| other.run_id == run.run_id)
            .map(|(_, raw)| raw.value)
            .reduce(|worst, one| if self.is_beyond(one, worst) { one } else { worst });
        verdict.basis = Some(run.basis);
        verdict.in_basis = self.criterion.is_based_on(run.basis);
        verdict.run_id = Some(run.run_id.clone());
        verdict.train = Some(run.train.clone());
        verdict.speed_km_h = run.speed_km_h;
        verdict.variant = Some(run.variant.clone()).filter(|name| !name.is_empty());
        verdict.seed = Some(run.seed.clone()).filter(|name| !name.is_empty());
    }

    /// Why there is no row.
    fn why_missing(&self, filter: ResolvedFilter) -> String {
        let (quantity, label) = (&self.criterion.quantity, filter.filter.label());
        let statistic = self.criterion.statistic.name();
        let is = |one: &&Missing| {
            one.quantity == *quantity
                && one.filter == label
                && one.statistic.as_ref().is_none_or(|missing| missing == statistic)
        };
        let told = self.results.missing.iter().chain(&self.derived.missing).find(is);
        if let Some(missing) = told {
            return missing.reason.clone();
        }
        let same: BTreeSet<&str> = self
            .results
            .rows
            .iter()
            .filter(|(_, peak)| peak.quantity == *quantity)
            .map(|(_, peak)| peak.filter.as_ref())
            .collect();
        let needs = self.criterion.needs.as_ref().map_or_else(String::new, |needs| format!("; needs {needs}"));
        if same.is_empty() {
            return format!("no run gives {quantity}{needs}");
        }
        let have = same.into_iter().collect::<Vec<_>>().join(", ");
        format!("no run gives {quantity}, {}, behind {label}; there is {have}{needs}", self.criterion.statistic)
    }
}

impl Judged<'_> {
    fn run_id(&self) -> Option<&str> {
        match self.by {
            By::Run(run) => Some(run.run_id.as_str()),
            By::Load(_) => None,
        }
    }

    fn speed(&self) -> Option<f64> {
        match self.by {
            By::Run(run) => run.speed_km_h,
            By::Load(_) => None,
        }
    }
}

/// The permissible speed, and the first that is not.
fn permissible(judged: &[Judged]) -> (Option<f64>, Option<f64>) {
    let exceeded = judged.iter().filter(|one| !one.kept).filter_map(Judged::speed).reduce(f64::min);
    let below = |speed: &f64| exceeded.is_none_or(|exceeded| *speed < exceeded);
    let kept = judged.iter().filter_map(Judged::speed).filter(below).reduce(f64::max);
    (kept, exceeded)
}
