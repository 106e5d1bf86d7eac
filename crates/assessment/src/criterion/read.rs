//! Limits files read, and sets of criteria made of several: a later file overrides single entries of earlier ones by their id.
//!
//! An entry that overrides another gives only the keys that change. It must have a `source` of its own, and is marked `user`
//! unless it says otherwise, so that a report never shows a project's number under the name of a code.

use serde_json::{Map, Value};

use super::bundled;
use super::keys::{FILE, nearest};
use super::problem::LimitsProblem;
use super::{Criterion, FilterRule};
use crate::facts::{Facts, WORDS};
use crate::filter::Filter;
use crate::peak::Statistic;

/// A set of criteria in the order of their files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Criteria {
    /// All.
    pub all: Vec<Criterion>,
    /// Facts that the user's files give.
    pub facts: Facts,
    /// What the user's files say for the head of a report: project, author, checker; name and text.
    pub people: Vec<[String; 2]>,
    /// Names of the files.
    pub files: Vec<String>,
}

impl Criteria {
    /// Of texts of limits files, each with its name, in this order.
    ///
    /// # Errors
    /// All problems of all files.
    pub fn read<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Result<Self, Vec<LimitsProblem>> {
        let (mut set, mut problems) = (Self::default(), Vec::new());
        // As they were read, so that a later file can give single keys.
        let mut entries: Vec<(String, Map<String, Value>)> = Vec::new();
        for (name, text) in files {
            set.files.push(name.into());
            match serde_json::from_str::<Value>(text) {
                Ok(file) => {
                    people(name, &file, &mut set.people, &mut problems);
                    add(name, &file, &mut entries, &mut set.facts, &mut problems);
                }
                Err(error) => problems.push(problem(name, "", "must be JSON", error.to_string())),
            }
        }
        for (path_file, entry) in entries {
            let id = entry.get("id").and_then(Value::as_str).unwrap_or_default().to_string();
            match serde_json::from_value::<Criterion>(Value::Object(entry)) {
                Ok(criterion) => {
                    check(&criterion, &path_file, &mut problems);
                    set.all.push(criterion);
                }
                Err(error) => problems.push(problem(&path_file, &format!("$.criteria[{id}]"), &error.to_string(), "")),
            }
        }
        if problems.is_empty() { Ok(set) } else { Err(problems) }
    }

    /// Of bundled files by name.
    ///
    /// # Errors
    /// A name is not known.
    pub fn bundled(names: &[&str]) -> Result<Self, Vec<LimitsProblem>> {
        let found: Result<Vec<_>, _> = names
            .iter()
            .map(|name| bundled::text(name).map(|text| (*name, text)).ok_or_else(|| vec![unknown_file(name)]))
            .collect();
        Self::read(found?)
    }

    /// What the criteria ask for of each quantity: statistic and filter, without repetition; the raw value of everything
    /// that is judged behind a filter is among them.
    pub fn wanted(&self, facts: &Facts) -> Vec<Wanted> {
        let mut wanted: Vec<Wanted> = Vec::new();
        for criterion in self.all.iter().filter(|criterion| criterion.never.is_none()) {
            let filters = criterion.filter.resolve(facts).map(|resolved| resolved.filter);
            for filter in filters.into_iter().chain([Filter::Raw]) {
                let one = Wanted { quantity: criterion.quantity.clone(), statistic: criterion.statistic, filter };
                if !wanted.contains(&one) {
                    wanted.push(one);
                }
            }
        }
        wanted
    }

    /// The filters behind which a quantity is judged, each once, in the order of the criteria.
    pub fn filters(&self, quantity: &str, facts: &Facts) -> Vec<Filter> {
        let mut filters = Vec::new();
        for wanted in self.wanted(&facts.overruled_by(&self.facts)) {
            if wanted.quantity == quantity && wanted.filter != Filter::Raw && !filters.contains(&wanted.filter) {
                filters.push(wanted.filter);
            }
        }
        filters
    }
}

/// A reduced value that a criterion asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Quantity.
    pub quantity: String,
    /// Statistic.
    pub statistic: Statistic,
    /// Filter.
    pub filter: Filter,
}

/// A name that is neither a bundled file nor one of the user's.
pub(crate) fn unknown_file(name: &str) -> LimitsProblem {
    let rule = format!("no limits file of this name; bundled are {}", bundled::names().collect::<Vec<_>>().join(", "));
    LimitsProblem { suggestion: nearest(name, bundled::names()), ..problem(name, "", &rule, "") }
}

fn problem(file: &str, path: &str, rule: &str, value: impl Into<String>) -> LimitsProblem {
    LimitsProblem { file: file.into(), path: path.into(), rule: rule.into(), value: value.into(), suggestion: None }
}

/// Adds one file's free fields.
fn people(name: &str, file: &Value, people: &mut Vec<[String; 2]>, problems: &mut Vec<LimitsProblem>) {
    for (key, value) in file.get("people").and_then(Value::as_object).into_iter().flatten() {
        match value.as_str() {
            Some(text) => people.push([key.clone(), text.into()]),
            None => problems.push(problem(name, &format!("$.people.{key}"), "must be a text", value.to_string())),
        }
    }
}

/// Adds one file's entries, and its facts.
fn add(
    name: &str,
    file: &Value,
    entries: &mut Vec<(String, Map<String, Value>)>,
    facts: &mut Facts,
    problems: &mut Vec<LimitsProblem>,
) {
    FILE.check(file, name, "$", problems);
    if !file.is_object() {
        problems.push(problem(name, "$", "must be an object with `criteria`", ""));
    }
    if let Some(given) = file.get("facts") {
        words(name, given, problems);
        match serde_json::from_value::<Facts>(without_comments(given)) {
            Ok(given) => *facts = facts.overruled_by(&given),
            Err(error) => problems.push(problem(name, "$.facts", &error.to_string(), "")),
        }
    }
    let list = file.get("criteria").map_or(&[][..], |list| list.as_array().map_or(&[][..], Vec::as_slice));
    for (i, entry) in list.iter().enumerate() {
        let path = format!("$.criteria[{i}]");
        let Value::Object(mut entry) = without_comments(entry) else {
            problems.push(problem(name, &path, "must be an object", ""));
            continue;
        };
        let Some(id) = entry.get("id").and_then(Value::as_str).map(str::to_string) else {
            problems.push(problem(name, &path, "must have an `id`", ""));
            continue;
        };
        let bundled = bundled::text(name).is_some();
        if !bundled && entry.get("source").and_then(|source| source.as_str()).is_none_or(str::is_empty) {
            let rule = "must say in `source` where its numbers come from";
            problems.push(problem(name, &path, rule, format!("`{id}`")));
        }
        let known: Vec<&str> = entries.iter().filter_map(|(_, e)| e.get("id")?.as_str()).collect();
        let own = |key: &str| file.get(key).and_then(Value::as_str).unwrap_or_default();
        entry.insert("file".into(), name.into());
        if !bundled {
            entry.entry("verified").or_insert("user".into());
        }
        if let Some(at) = known.iter().position(|known| *known == id) {
            // Another code's or the project's edition and note, never those of the entry it replaces.
            for (key, text) in [("edition", own("edition")), ("note", "")] {
                entry.entry(key).or_insert(text.into());
            }
            let (_, earlier) = &mut entries[at];
            earlier.extend(entry);
            entries[at].0 = name.into();
        } else if entry.contains_key("quantity") {
            for key in ["edition", "source"] {
                let text = own(key);
                entry.entry(key).or_insert(text.into());
            }
            entries.push((name.into(), entry));
        } else {
            let suggestion = nearest(&id, known.iter().copied());
            let rule = "unknown criterion: a new one must have a `quantity`, another overrides one of an earlier file";
            problems
                .push(LimitsProblem { suggestion, ..problem(name, &format!("{path}.id"), rule, format!("`{id}`")) });
        }
    }
}

/// Words and numbers of facts that cannot be.
fn words(name: &str, given: &Value, problems: &mut Vec<LimitsProblem>) {
    for (key, known) in WORDS {
        if let Some(word) = given.get(key).and_then(Value::as_str).filter(|word| !known.contains(word)) {
            let rule = format!("must be one of {}", known.join(", "));
            let told = problem(name, &format!("$.facts.{key}"), &rule, format!("`{word}`"));
            problems.push(LimitsProblem { suggestion: nearest(word, known.iter().copied()), ..told });
        }
    }
    for key in ["n0_hz", "third_mode_hz", "l_phi_m", "alpha", "line_speed_km_h", "overhang_m"] {
        let found = given.get(key).and_then(Value::as_f64);
        let least = if key == "overhang_m" { -f64::MIN_POSITIVE } else { 0.0 };
        if let Some(value) = found.filter(|value| *value <= least) {
            problems.push(problem(name, &format!("$.facts.{key}"), "must be positive", value.to_string()));
        }
    }
    let spans = given.get("spans_m").and_then(Value::as_array);
    if spans.is_some_and(|spans| spans.is_empty() || spans.iter().any(|span| span.as_f64().is_some_and(|l| l <= 0.0))) {
        problems.push(problem(
            name,
            "$.facts.spans_m",
            "must be lengths of spans, each positive",
            given["spans_m"].to_string(),
        ));
    }
}

fn without_comments(value: &Value) -> Value {
    match value {
        Value::Object(object) => {
            let kept = object.iter().filter(|(key, _)| !matches!(key.as_str(), "$comment" | "$schema"));
            Value::Object(kept.map(|(key, value)| (key.clone(), without_comments(value))).collect())
        }
        Value::Array(items) => Value::Array(items.iter().map(without_comments).collect()),
        other => other.clone(),
    }
}

/// Numbers that cannot be.
fn check(criterion: &Criterion, file: &str, problems: &mut Vec<LimitsProblem>) {
    let path = format!("$.criteria[{}]", criterion.id);
    for (i, case) in criterion.cases.iter().enumerate() {
        if let super::Limit::Chart { chart, .. } = &case.limit
            && let Err(rule) = chart.check()
        {
            problems.push(problem(file, &format!("{path}.cases[{i}].limit.chart"), &rule, ""));
        }
        let positive = match case.limit {
            super::Limit::Span { span_over } => span_over,
            _ => 1.0,
        };
        if positive <= 0.0 {
            problems.push(problem(file, &format!("{path}.cases"), "span_over must be positive", positive.to_string()));
        }
    }
    if let FilterRule::Butterworth { order, .. } = &criterion.filter
        && !(1..=20).contains(order)
    {
        problems.push(problem(file, &format!("{path}.filter.order"), "must be from 1 to 20", order.to_string()));
    }
    if criterion.source.is_empty() || criterion.verified.is_empty() {
        problems.push(problem(file, &path, "must have `source` and `verified`", ""));
    }
}
