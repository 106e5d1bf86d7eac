//! `ttb compare`: one case by the methods of the paper, its Table 2 and its Figures 7 to 10.

mod bench;
mod histories;
mod hybrid;
mod plan;
mod reference;
mod rows;
mod table;

use crate::cli::Compare;
use crate::error::Error;
use crate::pictures::figures;
use crate::prepare::auto::decided;
use crate::prepare::fmus;
use crate::results::folder::Folder;
use crate::results::ran::Watched;
use crate::signals::Stop;
use bench::Bench;
use plan::plan;
use rows::{Method, Planned};

/// Histories of all rows, as they are drawn.
const HISTORIES: &str = "histories.csv";

/// The command.
pub fn compare(arguments: &Compare, stop: &Stop) -> Result<(), Error> {
    let (checked, _) = decided(arguments.scenario.as_deref(), &arguments.set)?;
    fmus::only_in_runs(&checked, "ttb compare")?;
    fmus::only_plane(&checked, "ttb compare")?;
    let watched = Watched::new(&checked, arguments.point.as_deref(), arguments.car, arguments.wheel)?;
    let folder = Folder::claim(&arguments.output, stop)?;
    let mut bench = Bench { checked: &checked, watched, budget: f64::INFINITY, stop, quiet: arguments.quiet };
    let mut prepared = reference::Prepared::default();
    let planned = plan(arguments, &bench, &mut prepared)?;
    stop.gently();
    folder.begin(is_ours, arguments.scenario.as_deref().into_iter())?;
    let fine = arguments.reference.fine(checked.train_track.step);
    // The fine run is not timed against the others and takes what it takes.
    let truth = match fine {
        Some(h) => Some(hybrid::run(&bench, &Planned::reference(h))?),
        None => None,
    };
    let mut done = Vec::new();
    for row in planned.iter().take_while(|_| stop.asked().is_none()) {
        bench.budget = row.budget(&arguments.budget);
        let ran = match row.method {
            Method::Hybrid | Method::Multi => hybrid::run(&bench, row),
            _ => reference::run(&bench, row, &mut prepared),
        };
        done.push(ran?);
    }
    figures::draw(&done, truth.as_ref(), &bench.watched, folder.path())?;
    histories::write(truth.iter().chain(&done), &folder.file(HISTORIES))?;
    done.extend(truth.clone());
    let table = table::Table::new(&done, truth.as_ref(), &bench.watched);
    table.write(&checked, folder.path())?;
    table.print(&checked, folder.path());
    stop.asked().map_or(Ok(()), |signal| Err(Error::Interrupted(signal)))
}

/// Whether a file in the folder is one that this command writes.
fn is_ours(name: &str) -> bool {
    let figure = name.starts_with("figure-") && [".svg", ".png"].iter().any(|ending| name.ends_with(ending));
    figure || ["compare.csv", "compare.json", HISTORIES].contains(&name)
}
