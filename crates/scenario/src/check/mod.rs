//! Rules between the fields of a scenario, which no schema can say. All of them are tried.

mod advice;
mod bridge;
mod frame;
mod frequency;
mod graph;
mod layout;
pub(crate) mod model;
mod passage;
mod places;
mod plausible;
mod run;
mod space;

pub(crate) use run::chosen_steps;

use crate::pieces::Pieces;
use crate::placement::Placement;
use crate::problem::Report;
use crate::resolve::Resolved;

/// Reports every broken rule, and as warnings what is allowed but rarely meant.
pub(crate) fn check(pieces: &Pieces, resolved: &Resolved, placed: &Placement, report: &mut Report) {
    run::cars(&pieces.cars, report);
    run::train(pieces, report);
    if let Some(speed) = &pieces.speed {
        run::speed(speed, report);
    }
    if let Some(rail) = &pieces.rail {
        run::rail(rail, report);
    }
    if let Some(irregularity) = &pieces.irregularity {
        run::irregularity(irregularity, report);
    }
    if let Some(time) = &pieces.time {
        run::time(time, placed.end, report);
        run::substeps(time, pieces.coupling.as_ref(), report);
    }
    if let Some(csv) = &pieces.csv {
        run::csv(csv, report);
    }
    if let Some(newmark) = &pieces.newmark {
        run::newmark(newmark, report);
    }
    bridge::check(pieces, resolved, report);
    layout::check(pieces, resolved, placed, report);
    plausible::check(pieces, resolved, report);
    space::check(pieces, resolved, report);
}
