//! Criteria applied to results: one verdict a criterion and basis.
//!
//! ```text
//! rows of the criterion's quantity, statistic and filter, of runs of one basis
//!   └─ each with the limit of its own speed ──► the row of the greatest utilisation governs
//! permissible speed: the highest v so that every speed up to v keeps the limit, all trains, variants and seeds
//! ```

use std::collections::BTreeSet;

use crate::criterion::{BasisWord, Criteria, Criterion, ResolvedFilter, Sense};
use crate::facts::Facts;
use crate::filter::RAW;
use crate::peak::Peak;
use crate::run::{Basis, Results, Run};
use crate::verdict::{Status, VERSION, Verdict, Verdicts};

/// Judges results; worst verdicts first.
pub fn judge(criteria: &Criteria, facts: &Facts, results: &Results) -> Verdicts {
    let facts = facts.overruled_by(&criteria.facts);
    let bases: BTreeSet<Basis> = results.runs.iter().map(|run| run.basis).collect();
    let mut verdicts = Vec::new();
    for criterion in &criteria.all {
        verdicts.extend(Judge { criterion, facts: &facts, results }.all(&bases));
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
}

/// A row with its limit.
struct Judged<'a> {
    run: &'a Run,
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
        let found: Vec<Verdict> = bases.iter().filter_map(|basis| self.on(*basis, filter)).collect();
        let own = found.iter().any(|verdict| verdict.in_basis);
        if found.is_empty() {
            return vec![self.not_judged(self.why_missing(filter), Some(filter))];
        }
        let mut found = found;
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

    /// On one basis; `None` without rows.
    fn on(&self, basis: Basis, filter: ResolvedFilter) -> Option<Verdict> {
        let label = filter.filter.label();
        let rows: Vec<(&Run, &Peak)> = self.rows(&label).filter(|(run, _)| run.basis == basis).collect();
        let mut judged = Vec::with_capacity(rows.len());
        for (run, peak) in &rows {
            match self.limit(run, peak) {
                Ok(limit) => judged.push(self.judged(run, peak, limit)),
                Err(reason) => {
                    let mut verdict = self.not_judged(reason, Some(filter));
                    self.governed_by(&mut verdict, self.worst(&rows)?, basis);
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
        verdict.runs = judged.iter().map(|one| one.run.run_id.as_str()).collect::<BTreeSet<_>>().len();
        self.governed_by(&mut verdict, (governing.run, governing.peak), basis);
        if governing.limit.is_some() {
            (verdict.permissible_speed_km_h, verdict.first_exceeded_km_h) = permissible(&judged);
        }
        if filter.assumed {
            verdict.reason =
                Some("the frequencies of the bridge are not known: the cut-off of the filter is assumed".into());
        }
        Some(verdict)
    }

    fn rows<'b>(&'b self, label: &'b str) -> impl Iterator<Item = (&'a Run, &'a Peak)> + 'b {
        let of = move |peak: &Peak| {
            peak.quantity == self.criterion.quantity
                && peak.statistic == self.criterion.statistic
                && peak.filter == label
        };
        let results = self.results;
        results.rows.iter().filter(move |(_, peak)| of(peak)).map(move |(run, peak)| (&results.runs[*run], peak))
    }

    fn limit(&self, run: &Run, peak: &Peak) -> Result<Option<f64>, String> {
        match self.criterion.case(self.facts, run.speed_km_h)? {
            Some(case) => case.limit.resolve(self.facts, peak.static_value).map(Some),
            None if self.criterion.cases.is_empty() => Ok(None),
            None => Err("no limit is known for this track, speed or level of comfort".into()),
        }
    }

    fn judged<'b>(&self, run: &'b Run, peak: &'b Peak, limit: Option<f64>) -> Judged<'b> {
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
        Judged { run, peak, limit, utilisation, kept }
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

    fn worst(&self, rows: &[(&'a Run, &'a Peak)]) -> Option<(&'a Run, &'a Peak)> {
        rows.iter().copied().reduce(|worst, one| if self.is_beyond(one.1.value, worst.1.value) { one } else { worst })
    }

    fn governed_by(&self, verdict: &mut Verdict, (run, peak): (&Run, &Peak), basis: Basis) {
        verdict.value = Some(peak.value);
        verdict.unit.clone_from(&self.criterion.unit);
        verdict.raw = self
            .rows(RAW)
            .filter(|(other, _)| other.run_id == run.run_id)
            .map(|(_, raw)| raw.value)
            .reduce(|worst, one| if self.is_beyond(one, worst) { one } else { worst });
        verdict.grade = self.criterion.grade(peak.value).map(str::to_string);
        verdict.basis = Some(basis);
        verdict.in_basis = self.criterion.is_based_on(basis);
        verdict.run_id = Some(run.run_id.clone());
        verdict.train = Some(run.train.clone());
        verdict.speed_km_h = run.speed_km_h;
        verdict.variant = Some(run.variant.clone()).filter(|name| !name.is_empty());
        verdict.seed = Some(run.seed.clone()).filter(|name| !name.is_empty());
        verdict.place = Some(format!("{} {}", peak.place_kind, peak.place).trim().to_string());
        verdict.x_m = peak.x;
        verdict.time_s = peak.time;
    }

    /// Why there is no row.
    fn why_missing(&self, filter: ResolvedFilter) -> String {
        let (quantity, label) = (&self.criterion.quantity, filter.filter.label());
        let statistic = self.criterion.statistic.name();
        let told = self.results.missing.iter().find(|one| {
            one.quantity == *quantity
                && one.filter == label
                && one.statistic.as_ref().is_none_or(|missing| missing == statistic)
        });
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

    fn not_judged(&self, reason: String, filter: Option<ResolvedFilter>) -> Verdict {
        Verdict { status: Status::NotJudged, reason: Some(reason), ..self.empty(filter) }
    }

    fn empty(&self, filter: Option<ResolvedFilter>) -> Verdict {
        let criterion = self.criterion.clone();
        Verdict {
            criterion: criterion.id,
            title: criterion.title,
            status: Status::NotJudged,
            value: None,
            limit: None,
            utilisation: None,
            unit: criterion.unit,
            raw: None,
            quantity: criterion.quantity,
            statistic: criterion.statistic.name().into(),
            filter: filter.map_or_else(String::new, |filter| filter.filter.label()),
            filter_assumed: filter.is_some_and(|filter| filter.assumed),
            grade: None,
            basis: None,
            in_basis: true,
            runs: 0,
            run_id: None,
            train: None,
            speed_km_h: None,
            variant: None,
            seed: None,
            place: None,
            x_m: None,
            time_s: None,
            permissible_speed_km_h: None,
            first_exceeded_km_h: None,
            clause: criterion.clause,
            edition: criterion.edition,
            verified: criterion.verified,
            source: criterion.source,
            limits: criterion.file,
            reason: None,
            note: criterion.note,
        }
    }
}

/// The permissible speed, and the first that is not.
fn permissible(judged: &[Judged]) -> (Option<f64>, Option<f64>) {
    let exceeded = judged.iter().filter(|one| !one.kept).filter_map(|one| one.run.speed_km_h).reduce(f64::min);
    let below = |speed: &f64| exceeded.is_none_or(|exceeded| *speed < exceeded);
    let kept = judged.iter().filter_map(|one| one.run.speed_km_h).filter(below).reduce(f64::max);
    (kept, exceeded)
}
