//! From a folder to the values of a report.

mod accuracy;
mod bridge;
mod histories;
mod losses;
mod trains;

use serde_json::Value;
use ttb_assessment::{Status, Verdict, Verdicts};
use ttb_report::{Envelope, Input, render};

use crate::error::Error;
use crate::folder::Opened;

/// Extremes along the deck, of all runs.
const ENVELOPE: &str = "envelope.csv";

/// What the files of a folder hold.
const FILES: [(&str, &str); 13] = [
    ("runs.csv", "a run a row: train, speed, variant, seed, basis, step"),
    ("peaks.csv", "a reduced value a row"),
    ("envelope.csv", "extremes along the deck"),
    ("verdicts.json", "the verdicts of this page"),
    ("assessment.json", "what was taken for bridge and track"),
    ("results.csv", "histories, SI units, 17 digits"),
    ("results.h5", "histories and tables as HDF5"),
    ("iterations.csv", "the iteration of every step"),
    ("summary.json", "how the run went, every file read with its hash"),
    ("scenario.resolved.json", "the scenario with all defaults"),
    ("plan.json", "the plan of the sweep"),
    ("coupled-check.json", "governing runs by the other way"),
    ("verified.json", "the governing run once more: half the step, a deck that does not move"),
];

/// The page. `date` is the day that it names.
///
/// # Errors
/// A table cannot be read; the template has a fault.
pub fn page(opened: &Opened, verdicts: &Verdicts, people: &[[String; 2]], date: String) -> Result<String, Error> {
    let text = |value: &Value| value.as_str().map(str::to_string);
    let trains = trains::all(opened);
    let (bridge, modal) = bridge::of(opened);
    let governing = governing(verdicts);
    let passages = histories::all(opened, governing, modal.as_ref());
    let summary = opened.summary.as_ref();
    let mut commands: Vec<String> = summary
        .and_then(|summary| summary["command"].as_array())
        .map(|words| words.iter().filter_map(Value::as_str).collect::<Vec<_>>().join(" "))
        .into_iter()
        .collect();
    commands.push(format!("ttb report {}", opened.files.name()));
    let present = FILES.iter().filter(|(name, _)| opened.files.has(name));
    let title = if opened.assessment.title.is_empty() { "Assessment".into() } else { opened.assessment.title.clone() };
    let input = Input {
        title,
        people: people.to_vec(),
        version: env!("CARGO_PKG_VERSION").into(),
        date,
        hash: summary
            .and_then(|summary| text(&summary["scenario_sha256"]))
            .or_else(|| opened.plan.as_ref().and_then(|plan| text(&plan["scenario_sha256"]))),
        verdicts,
        results: &opened.results,
        bridge,
        given: bridge::given(opened),
        trains,
        envelopes: envelopes(opened, governing)?,
        passages,
        changes: accuracy::changes(opened, governing, modal.as_ref()),
        more_changes: accuracy::more(opened),
        losses: losses::of(opened),
        comfort: accuracy::comfort(opened),
        commands,
        files: present.map(|(name, what)| [(*name).to_string(), (*what).to_string()]).collect(),
        warnings: opened.warnings.clone(),
    };
    Ok(render(&input)?)
}

/// The worst verdict with a limit, else the first with a run.
fn governing(verdicts: &Verdicts) -> Option<&Verdict> {
    let judged = || verdicts.verdicts.iter().filter(|v| v.status != Status::NotJudged && v.run_id.is_some());
    let share = |verdict: &&Verdict| verdict.utilisation.unwrap_or(0.0);
    judged()
        .filter(|v| v.utilisation.is_some())
        .max_by(|a, b| share(a).total_cmp(&share(b)))
        .or_else(|| judged().next())
}

/// Envelopes of the governing run.
fn envelopes(opened: &Opened, governing: Option<&Verdict>) -> Result<Vec<Envelope>, Error> {
    let Some(run_id) = governing.and_then(|verdict| verdict.run_id.as_ref()) else { return Ok(Vec::new()) };
    let Some(content) = opened.files.open(ENVELOPE)? else { return Ok(Vec::new()) };
    let mut found: Vec<Envelope> = Vec::new();
    let wrong = |e: csv::Error| Error::Input(format!("{}: {e}", opened.files.shown(ENVELOPE)));
    let mut reader = csv::Reader::from_reader(content);
    for row in reader.records() {
        let row = row.map_err(wrong)?;
        let field = |at: usize| row.get(at).unwrap_or_default();
        let numbers: Vec<f64> = (3..6).filter_map(|at| field(at).parse().ok()).collect();
        let (true, &[x, min, max]) = (field(0) == run_id, numbers.as_slice()) else { continue };
        if !found.last().is_some_and(|one| one.quantity == field(1) && one.filter == field(2)) {
            let (x, min, max) = (Vec::new(), Vec::new(), Vec::new());
            let (quantity, filter) = (field(1).to_string(), field(2).to_string());
            found.push(Envelope { run_id: run_id.clone(), quantity, filter, x, min, max });
        }
        if let Some(one) = found.last_mut() {
            one.x.push(x);
            one.min.push(min);
            one.max.push(max);
        }
    }
    Ok(found)
}
