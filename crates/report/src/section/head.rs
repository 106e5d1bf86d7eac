//! Head: what this is, and the answer in one sentence.

use serde::Serialize;
use ttb_assessment::{Status, Verdict};

use super::speed;
use crate::input::Input;

#[derive(Serialize)]
pub(crate) struct Head {
    title: String,
    people: Vec<[String; 2]>,
    version: String,
    date: String,
    hash: String,
    runs: usize,
    /// `exceeded`, `fulfilled` or `open`.
    answer: &'static str,
    sentence: String,
}

impl Head {
    pub fn new(input: &Input) -> Self {
        let verdicts = &input.verdicts.verdicts;
        let of = |status| verdicts.iter().filter(move |verdict| verdict.status == status);
        let (exceeded, fulfilled) = (of(Status::Exceeded).count(), of(Status::Fulfilled).count());
        let answer = match (exceeded, fulfilled) {
            (0, 0) => "open",
            (0, _) => "fulfilled",
            _ => "exceeded",
        };
        Self {
            title: input.title.clone(),
            people: input.people.clone(),
            version: input.version.clone(),
            date: input.date.clone(),
            hash: input.hash.clone().unwrap_or_default(),
            runs: input.results.runs.len(),
            answer,
            sentence: sentence(verdicts),
        }
    }
}

/// Which criteria are fulfilled, which not, and what governs.
fn sentence(verdicts: &[Verdict]) -> String {
    let named = |status: Status| -> Vec<String> {
        let of = verdicts.iter().filter(|verdict| verdict.status == status);
        of.map(|verdict| match verdict.basis {
            Some(basis) => format!("{} ({basis})", verdict.criterion),
            None => verdict.criterion.clone(),
        })
        .collect()
    };
    let (exceeded, fulfilled) = (named(Status::Exceeded), named(Status::Fulfilled));
    let open = verdicts.iter().filter(|verdict| verdict.status == Status::NotJudged).count();
    let mut parts = Vec::new();
    if !exceeded.is_empty() {
        parts.push(format!("Exceeded: {}", exceeded.join(", ")));
    }
    if !fulfilled.is_empty() {
        let word = if exceeded.is_empty() { "Fulfilled" } else { "fulfilled" };
        parts.push(format!("{word}: {}", fulfilled.join(", ")));
    }
    if parts.is_empty() {
        parts.push("No criterion with a limit could be judged".into());
    }
    if open > 0 {
        parts.push(format!("not judged: {open}, with the reasons below"));
    }
    let limited = verdicts.iter().filter(|verdict| verdict.limit.is_some());
    let governing = limited.max_by(|a, b| a.utilisation.unwrap_or(0.0).total_cmp(&b.utilisation.unwrap_or(0.0)));
    let governed = governing.and_then(|verdict| {
        let (train, utilisation) = (verdict.train.as_ref()?, verdict.utilisation?);
        let at = verdict.speed_km_h.map_or_else(String::new, |v| format!(" at {} km/h", speed(Some(v))));
        Some(format!(" Governed by {}: {train}{at}, {:.0} % of the limit.", verdict.criterion, 100.0 * utilisation))
    });
    parts.join("; ") + "." + &governed.unwrap_or_default()
}
