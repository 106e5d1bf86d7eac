//! `ttb accuracy`: every reported quantity at several steps against a fine one.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use ttb_contract::finite::{larger, largest};
use ttb_scenario::Checked;
use ttb_scenario::step::Steps;
use ttb_session::observe::Progress;
use ttb_session::{Case, Column, Ended, Plan, Table};

use super::progress::progress_bar;
use crate::cli::Accuracy;
use crate::error::Error;
use crate::files::write;
use crate::pictures::slopes::{Kind, Slopes};
use crate::prepare::auto::decided;
use crate::prepare::fmus::{self, Prepared, prepared};
use crate::results::folder::Folder;
use crate::signals::Stop;

/// What the command writes.
const FILES: [&str; 4] = ["accuracy.md", "accuracy.csv", "accuracy.svg", "accuracy.png"];

/// The command.
pub fn accuracy(arguments: &Accuracy, stop: &Stop) -> Result<(), Error> {
    let (checked, _) = decided(arguments.scenario.as_deref(), &arguments.set)?;
    fmus::only_in_runs(&checked, "ttb accuracy")?;
    let fine = arguments.reference;
    let mut steps = arguments.steps.clone();
    steps.sort_by(|a, b| b.total_cmp(a));
    for h in &steps {
        let parts = (h / fine).round();
        if parts < 2.0 || (h / fine - parts).abs() > 1e-6 * parts {
            return Err(Error::Input(format!("--steps: {h} s is no multiple of the fine run's {fine} s")));
        }
    }
    let folder = Folder::claim(&arguments.output, stop)?;
    stop.gently();
    let mut prepared = prepared(&checked)?;
    let mut run = |h: f64| histories(&checked, &mut prepared, h, arguments.quiet, stop);
    let truth = run(fine)?;
    let mut kinds: BTreeMap<String, Kind> = BTreeMap::new();
    for h in &steps {
        let coarse = run(*h)?;
        let parts = (h / fine).round() as usize;
        for (name, errors) in compare(&truth, &coarse, parts) {
            let kind = kinds.entry(name.clone()).or_insert_with(|| Kind { name, errors: Vec::new() });
            kind.errors.push(errors);
        }
    }
    let kinds: Vec<Kind> = kinds.into_values().collect();
    let text = markdown(&checked, &steps, fine, &kinds);
    folder.begin(|name| FILES.contains(&name), arguments.scenario.as_deref().into_iter())?;
    write(&folder.file("accuracy.md"), text.as_bytes())?;
    write(&folder.file("accuracy.csv"), csv(&steps, &kinds).as_bytes())?;
    Slopes { title: &checked.scenario.title, steps: &steps, kinds: &kinds }.save(&folder.file("accuracy"))?;
    say!("{text}");
    say!("results in {}", folder.path().display());
    Ok(())
}

/// Runs the scenario at a step; all outputs but those of the supports and the wheels' positions.
fn histories(checked: &Checked, prepared: &mut Prepared, h: f64, quiet: bool, stop: &Stop) -> Result<Table, Error> {
    let mut checked = checked.clone();
    checked.set_steps(Steps { step: h, substeps: checked.steps().substeps });
    let case = Case::of(&checked);
    let mut sides = prepared.sides(&checked).map_err(|e| Error::Input(e.to_string()))?;
    let bar = progress_bar(case.axis().steps(), quiet).with_prefix(format!("{:.4} ms ", 1e3 * h));
    let mut tell = |n| bar.set_position(n);
    let (mut table, mut progress) = (Table::default(), Progress::new(&mut tell, stop.flag()));
    let plan = Plan { axis: case.axis(), wanted: &Column::has_extremes, clock: &|| 0.0 };
    let ended = sides.run(&plan, &mut [&mut table, &mut progress])?;
    bar.finish_and_clear();
    match stop.asked() {
        Some(signal) if ended == Ended::Stopped => Err(Error::Interrupted(signal)),
        _ => Ok(table),
    }
}

/// Errors of every kind; the fine run has `parts` steps in one of the coarse run.
fn compare(truth: &Table, coarse: &Table, parts: usize) -> Vec<(String, [f64; 2])> {
    // Per kind: greatest value, greatest difference, greatest difference of peaks.
    let mut kinds: BTreeMap<String, [f64; 3]> = BTreeMap::new();
    for ((column, fine), coarse) in truth.columns.iter().zip(&truth.values).zip(&coarse.values) {
        let kind = kinds.entry(column.series().replace("[]", "[·]")).or_default();
        let peak = |values: &[f64]| largest(values.iter().map(|x| x.abs()));
        kind[0] = larger(kind[0], peak(fine));
        // A last step that was shortened is no multiple of the fine ones.
        let pairs = coarse.iter().zip(fine.iter().step_by(parts)).take((fine.len() - 1) / parts + 1);
        kind[1] = pairs.fold(kind[1], |most, (a, b)| larger(most, (a - b).abs()));
        kind[2] = larger(kind[2], (peak(coarse) - peak(fine)).abs());
    }
    let relative = |[scale, history, peak]: [f64; 3]| [history / scale, peak / scale];
    kinds.into_iter().filter(|(_, k)| k[0] != 0.0).map(|(name, k)| (name, relative(k))).collect()
}

/// History and peak error in percent, a column a step.
fn markdown(checked: &Checked, steps: &[f64], fine: f64, kinds: &[Kind]) -> String {
    let title = if checked.scenario.title.is_empty() { "The scenario" } else { &checked.scenario.title };
    let mut text = format!(
        "{title}, against steps of {} ms. History: greatest difference at any time; peak: difference of the greatest values; \
         both in percent of the greatest value of the kind.\n\n| quantity |",
        milliseconds(fine)
    );
    for h in steps {
        // Writing to a string does not fail.
        let _ = write!(text, " {} ms: history, peak |", milliseconds(*h));
    }
    text += "\n|---|";
    steps.iter().for_each(|_| text += "---|");
    for kind in kinds {
        let _ = write!(text, "\n| `{}` |", kind.name);
        for [history, peak] in &kind.errors {
            let _ = write!(text, " {}, {} |", percent(*history), percent(*peak));
        }
    }
    text + "\n"
}

fn csv(steps: &[f64], kinds: &[Kind]) -> String {
    let mut text = String::from("quantity,step_s,history_error,peak_error\n");
    for kind in kinds {
        for (h, [history, peak]) in steps.iter().zip(&kind.errors) {
            let _ = writeln!(text, "{},{h},{history:.6e},{peak:.6e}", kind.name);
        }
    }
    text
}

/// A step for people, in ms without rounding noise.
fn milliseconds(h: f64) -> f64 {
    (1e9 * h).round() / 1e6
}

/// Two significant digits of a percentage.
fn percent(error: f64) -> String {
    let percent = 100.0 * error;
    if percent < 1e-4 { "< 0.0001".into() } else { format!("{percent:.*}", digits(percent)) }
}

fn digits(x: f64) -> usize {
    (1.0 - x.log10().floor()).max(0.0) as usize
}
