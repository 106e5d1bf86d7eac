//! `ttb compare`: one case by the methods of the paper, its Table 2 and its Figures 7 to 10.

mod bench;
mod hybrid;
mod plan;
mod reference;
mod rows;
mod table;

use std::sync::atomic::Ordering;

use super::signals::stop_on_interrupt;
use crate::cli::Compare;
use crate::error::Error;
use crate::pictures::figures;
use crate::prepare::auto::decided;
use crate::results::ran::Watched;
use bench::Bench;
use plan::plan;
use rows::{Method, Planned};

/// The command.
pub fn compare(arguments: &Compare) -> Result<(), Error> {
    let checked = decided(arguments.scenario.as_deref())?;
    let watched = Watched::new(&checked, arguments.point.as_deref(), arguments.car, arguments.wheel)?;
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
            Method::Hybrid | Method::Multi => hybrid::run(&bench, row),
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
