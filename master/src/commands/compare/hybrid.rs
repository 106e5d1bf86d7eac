//! Rows of the product: both subsystems in this process, coupled by the scenario's iteration.

use ttb_scenario::Checked;
use ttb_scenario::step::Steps;
use ttb_session::{Case, Coupled, Sides};

use super::bench::Bench;
use super::rows::{Method, Planned, sub_steps};
use crate::clock::cpu;
use crate::error::Error;
use crate::prepare::fmus;
use crate::results::ran::Ran;

/// Runs a row.
pub fn run(bench: &Bench, row: &Planned) -> Result<Ran, Error> {
    let checked = with_step(bench.checked, row);
    let begin = cpu();
    let Sides { mut train_track, mut bridge, mut coupling, .. } = fmus::sides(&checked)?;
    let axis = Case::of(&checked).axis();
    let mut ran = Ran { method: row.name.clone(), step: row.step, steps: axis.steps(), ..Ran::default() };
    ran.preparation = cpu() - begin;
    bench.step(&mut Coupled::new(&mut train_track, &mut bridge, &mut coupling), axis, &mut ran)?;
    Ok(ran)
}

/// The scenario at a row's step, a multi-time-step row with sub-steps of train and track.
fn with_step(checked: &Checked, row: &Planned) -> Checked {
    let mut checked = checked.clone();
    let substeps = if row.method == Method::Multi { sub_steps(&checked) } else { 1 };
    checked.set_steps(Steps { step: row.step, substeps });
    checked
}
