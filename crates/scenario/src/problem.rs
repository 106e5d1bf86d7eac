//! What can be wrong with a scenario, said in one line each: where, which rule, what was found.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

/// So many problems of one kind are listed; of the others only the number is told.
const LISTED: usize = 20;

/// The rule against which nothing is ever found, as a test tries to show.
pub(crate) const MUST_FIT: &str = "must fit the schema";

/// One broken rule.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Problem {
    /// The scenario file as the user named it.
    pub file: String,
    /// Where, as a JSON path such as `$.train.cars[2].body_mass`; empty for the file as a whole.
    pub path: String,
    /// The rule.
    pub rule: String,
    /// What was found there instead.
    pub value: String,
    /// The nearest thing that would have been right.
    pub suggestion: Option<String>,
}

impl Problem {
    /// Of an input as a whole, in a sentence.
    pub fn whole(rule: String) -> Self {
        Self { file: String::new(), path: String::new(), rule, value: String::new(), suggestion: None }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.file.is_empty() {
            write!(f, "{}: ", self.file)?;
        }
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        f.write_str(&self.rule)?;
        if !self.value.is_empty() {
            write!(f, ": {}", self.value)?;
        }
        match &self.suggestion {
            Some(name) => write!(f, " (did you mean `{name}`?)"),
            None => Ok(()),
        }
    }
}

/// What is allowed, but rarely meant.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Warning {
    /// The value it is about, as a JSON path; empty: the scenario as a whole.
    pub path: String,
    /// The quantity, if it is one with a usual range.
    pub name: String,
    /// Its value.
    pub value: Option<f64>,
    /// Its unit.
    pub unit: String,
    /// Where it usually lies.
    pub usual: [Option<f64>; 2],
    /// What may have been meant.
    pub slip: Option<String>,
    /// Where the range comes from.
    pub source: String,
    /// All of it as a sentence, with the path.
    pub text: String,
}

impl Warning {
    /// Without a range.
    pub(crate) fn at(path: &str, text: impl Into<String>) -> Self {
        Self { path: path.into(), text: text.into(), ..Self::default() }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// All problems of a scenario; never empty where it is an error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problems(pub Vec<Problem>);

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            problem.fmt(f)?;
        }
        Ok(())
    }
}

impl std::error::Error for Problems {}

/// Collects problems and warnings of one file.
pub(crate) struct Report {
    file: String,
    /// Broken rules.
    pub problems: Vec<Problem>,
    /// What is allowed, but rarely meant.
    pub warnings: Vec<Warning>,
    /// How often each rule was broken.
    broken: BTreeMap<String, usize>,
}

impl Report {
    pub fn new(file: &str) -> Self {
        Self { file: file.to_owned(), problems: Vec::new(), warnings: Vec::new(), broken: BTreeMap::new() }
    }

    /// Another problem of this kind would only be counted: spare the search for a suggestion.
    pub fn is_full(&self, rule: &str) -> bool {
        self.broken.get(rule).is_some_and(|times| *times >= LISTED)
    }

    /// All that was noted, with the number of those that were not listed.
    pub fn into_problems(mut self) -> Problems {
        for (rule, times) in std::mem::take(&mut self.broken) {
            if let more @ 1.. = times.saturating_sub(LISTED) {
                let value = format!("and {} more", grouped(more));
                self.problems.push(Problem {
                    file: self.file.clone(),
                    path: String::new(),
                    rule,
                    value,
                    suggestion: None,
                });
            }
        }
        Problems(self.problems)
    }

    /// Takes over what was found in another file.
    pub fn absorb(&mut self, other: Self) {
        self.warnings.extend_from_slice(&other.warnings);
        self.problems.extend(other.into_problems().0);
    }

    /// Notes that `value` was found at `path` against `rule`.
    pub fn problem(&mut self, path: impl Into<String>, rule: impl Into<String>, value: impl fmt::Display) {
        self.suggest(path, rule, value, None);
    }

    /// As [`Report::problem`], with what may have been meant.
    pub fn suggest(
        &mut self,
        path: impl Into<String>,
        rule: impl Into<String>,
        value: impl fmt::Display,
        suggestion: Option<String>,
    ) {
        let rule = rule.into();
        let times = self.broken.entry(rule.clone()).or_default();
        *times += 1;
        if *times > LISTED {
            return;
        }
        self.problems.push(Problem {
            file: self.file.clone(),
            path: path.into(),
            rule,
            value: value.to_string(),
            suggestion,
        });
    }

    /// Warns of something that belongs to no single value.
    pub fn warn(&mut self, text: impl Into<String>) {
        self.note(Warning::at("", text));
    }

    /// Notes a warning, unless the same value of the same quantity has been noted.
    pub fn note(&mut self, warning: Warning) {
        let same =
            |other: &Warning| other.name == warning.name && other.value == warning.value && warning.value.is_some();
        if !self.warnings.iter().any(same) {
            self.warnings.push(warning);
        }
    }
}

/// 1234567 as 1,234,567.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// The name most like `name`, if one is like it at all.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    /// Below this likeness (0…1) a suggestion would puzzle more than help.
    const LIKE: f64 = 0.5;
    let like = |other: &str| strsim::normalized_damerau_levenshtein(&name.to_lowercase(), &other.to_lowercase());
    known
        .into_iter()
        .map(|other| (like(other), other))
        .filter(|(likeness, _)| *likeness >= LIKE)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, other)| other.to_owned())
}
