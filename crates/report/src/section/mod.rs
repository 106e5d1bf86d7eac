//! The sections of the report, each as the values that its template shows.

mod amplification;
mod deck;
mod head;
mod model;
mod passages;
mod seeds;
mod speed;
mod vehicle;
mod verdicts;

use serde::Serialize;

use crate::input::Input;
use crate::number::digits;

/// A chart with its table.
#[derive(Serialize)]
pub(crate) struct Figure {
    /// Heading.
    pub title: String,
    /// SVG; empty: nothing to draw.
    pub svg: String,
    /// One sentence on what it shows.
    pub note: String,
    /// The same as text.
    pub table: Table,
}

/// A table as text.
#[derive(Default, Serialize)]
pub(crate) struct Table {
    /// Names of columns.
    pub head: Vec<String>,
    /// Rows.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    fn new(head: &[&str]) -> Self {
        Self { head: head.iter().map(|name| (*name).to_string()).collect(), rows: Vec::new() }
    }
}

/// A change of the governing value.
#[derive(Serialize)]
struct ChangeRow {
    what: String,
    before: String,
    after: String,
    percent: String,
}

/// The whole page.
#[derive(Serialize)]
pub(crate) struct Page {
    head: head::Head,
    verdicts: verdicts::Verdicts,
    model: model::Model,
    trains: Vec<Figure>,
    speed: Vec<Figure>,
    deck: Vec<Figure>,
    passages: Vec<passages::Passage>,
    vehicle: vehicle::Vehicle,
    seeds: Vec<Figure>,
    amplification: amplification::Amplification,
    changes: Vec<ChangeRow>,
    more_changes: String,
    commands: Vec<String>,
    files: Vec<[String; 2]>,
    warnings: Vec<String>,
    style: &'static str,
    script: &'static str,
}

impl Page {
    /// Of an input.
    pub fn new(input: &Input) -> Self {
        let changes = input.changes.iter().map(|change| {
            let percent = 100.0 * (change.after / change.before - 1.0);
            ChangeRow {
                what: change.what.clone(),
                before: crate::number::with_unit(change.before, &change.unit),
                after: crate::number::with_unit(change.after, &change.unit),
                percent: if percent.is_finite() { format!("{percent:+.2} %") } else { "–".into() },
            }
        });
        Self {
            head: head::Head::new(input),
            verdicts: verdicts::Verdicts::new(input),
            model: model::Model::new(input),
            trains: model::trains(input),
            speed: speed::figures(input),
            deck: deck::figures(input),
            passages: passages::all(input),
            vehicle: vehicle::Vehicle::new(input),
            seeds: seeds::figures(input),
            amplification: amplification::Amplification::new(input),
            changes: changes.collect(),
            more_changes: input.more_changes.clone(),
            commands: input.commands.clone(),
            files: input.files.clone(),
            warnings: input.warnings.clone(),
            style: include_str!("../../templates/style.css"),
            script: crate::SCRIPT,
        }
    }
}

/// A speed in km/h as it was asked for.
fn speed(v: Option<f64>) -> String {
    v.map_or_else(|| "–".into(), crate::number::short)
}

/// A number or a dash.
fn optional(value: Option<f64>, significant: i32) -> String {
    value.map_or_else(|| "–".into(), |value| digits(value, significant))
}
