//! `ttb compare`: one case by the methods of the paper, its Table 2 and its Figures 7 to 10. And `ttb accuracy`
//! ([`accuracy`]): one case by the product at several steps.

pub mod accuracy;
mod figures;
mod hybrid;
mod ran;
mod reference;
mod rows;
mod slopes;
mod table;

use std::sync::atomic::{AtomicBool, Ordering};

use indicatif::ProgressBar;
use ttb_scenario::Checked;

use crate::build;
use crate::cli::Compare;
use crate::error::Error;
use crate::run::stop_on_interrupt;
use ran::{Ran, Watched};
use rows::{Planned, plan};

/// What all rows share.
struct Bench<'a> {
    checked: &'a Checked,
    watched: Watched,
    /// CPU seconds a row may take.
    budget: f64,
    stop: &'a AtomicBool,
    quiet: bool,
}

/// The command.
pub fn compare(arguments: &Compare) -> Result<(), Error> {
    let checked = build::decided(arguments.scenario.as_deref())?;
    let watched = Watched::new(&checked, arguments)?;
    let folder = &arguments.output;
    std::fs::create_dir_all(folder).map_err(Error::io(folder))?;
    let stop = stop_on_interrupt();
    let mut bench = Bench { checked: &checked, watched, budget: f64::INFINITY, stop: &stop, quiet: arguments.quiet };
    let mut prepared = reference::Prepared::default();
    let planned = plan(arguments, &bench, &mut prepared)?;
    let fine = arguments.reference.fine(checked.train_track.step);
    // The fine run is not timed against the others and takes what it takes.
    let truth = match fine {
        Some(h) => Some(hybrid::run(&bench, &Planned::reference(h))?),
        None => None,
    };
    let mut done = Vec::new();
    for row in planned.iter().take_while(|_| !stop.load(Ordering::Relaxed)) {
        bench.budget = row.budget(&arguments.budget);
        let ran = match row.method {
            rows::Method::Hybrid | rows::Method::Multi => hybrid::run(&bench, row),
            _ => reference::run(&bench, row, &mut prepared),
        };
        done.push(ran?);
    }
    figures::draw(&done, truth.as_ref(), &bench.watched, folder)?;
    done.extend(truth.clone());
    let table = table::Table::new(&done, truth.as_ref(), &bench.watched);
    table.write(&checked, folder)?;
    table.print(&checked, folder);
    if stop.load(Ordering::Relaxed) { Err(Error::Interrupted) } else { Ok(()) }
}

/// A row's progress on a terminal.
fn progress(bench: &Bench, name: &str, steps: u64) -> ProgressBar {
    crate::run::progress_bar(steps, bench.quiet).with_prefix(format!("{name:<24} "))
}
