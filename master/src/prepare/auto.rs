//! `"step": "auto"`: macro step and sub-steps before the run starts.
//!
//! ```text
//! 1  frequencies of speed, irregularity, supports, wheel on rail → H, m              ttb_scenario::step
//! 2  a short stretch at (H, m) and at (H/2, m): all steps halved                     super::stretch
//!    the error of each kind of quantity by what changes                              super::levels
//! 3  an error above the one allowed that still falls: H ← H/2, back to 2
//! ```

use std::path::Path;
use std::sync::Arc;

use ttb_bridge::Prepared;
use ttb_contract::finite::{larger, largest};
use ttb_fmi::temporary::Temporary;
use ttb_scenario::Checked;
use ttb_scenario::step::{Excited, Steps};

use super::fmus;
use super::levels::Levels;
use super::stretch::{self, Seen, Stage};
use crate::cli::Set;
use crate::connect::connected::Given;
use crate::connect::isolate::Isolated;
use crate::error::Error;
use crate::results::choice::Choice;

/// Greatest error where the scenario says nothing.
const ERROR: f64 = 0.02;
/// Halvings at most.
const HALVINGS: usize = 5;

/// As [`found`]; prints what was chosen.
pub fn choose(
    checked: &mut Checked,
    given: &[Given],
    isolated: &Isolated,
) -> Result<(Option<Choice>, Option<Arc<Prepared>>), Error> {
    let found = found(checked, given, isolated)?;
    found.0.iter().for_each(Choice::print);
    Ok(found)
}

/// Chooses and sets the steps of a scenario that asks for it. Without `given` bridges the scenario's is prepared, and
/// handed back for the run.
pub fn found(
    checked: &mut Checked,
    given: &[Given],
    isolated: &Isolated,
) -> Result<(Option<Choice>, Option<Arc<Prepared>>), Error> {
    let time = checked.scenario.time;
    if time.step.given().is_some() {
        return Ok((None, None));
    }
    let prepared = if given.is_empty() { Some(fmus::prepared_bridge(checked)?) } else { None };
    let folder = Temporary::new("ttb-auto-").map_err(Error::io(std::path::Path::new("temporary folder")))?;
    let built = prepared.as_ref().map(|prepared| fmus::bridge(prepared, checked, folder.path())).transpose()?;
    let ours: Vec<Given> = built.iter().map(|path| Given { path, map: None }).collect();
    let stage = Stage { bridges: if given.is_empty() { &ours } else { given }, ours: given.is_empty(), isolated };
    let short = stretch::stretch(checked);
    let excited = Excited::of(&checked.train_track);
    let mut choice = Choice {
        irregularity_hz: excited.irregularity,
        supports_hz: excited.supports,
        wheel_rail_hz: excited.wheel_rail,
        allowed_error: time.error.unwrap_or(ERROR),
        tried: Vec::new(),
        errors: Vec::new(),
        not_falling: Vec::new(),
        warnings: Vec::new(),
    };
    let mut steps = checked.steps();
    let mut levels = Levels::new(choice.allowed_error);
    let mut coarse = stretch::run(&short, steps, &stage)?;
    for _ in 0..=HALVINGS {
        let half = Steps { step: 0.5 * steps.step, ..steps };
        let fine = stretch::run(&short, half, &stage)?;
        let changes = coarse.as_ref().zip(fine.as_ref()).map(|(coarse, fine)| changes(coarse, fine));
        if levels.add(steps, changes) {
            break;
        }
        (steps, coarse) = (half, fine);
    }
    (choice.tried, choice.errors, choice.not_falling) = (levels.tried(), levels.errors(levels.taken()), levels.stuck());
    if let Some(taken) = choice.tried.iter().find(|tried| tried.taken) {
        checked.set_steps(Steps { step: taken.step_s, substeps: taken.substeps });
    }
    choice.warn();
    Ok((Some(choice), prepared))
}

/// As [`fmus::scenario`], with a step that is left to the program chosen; and the bridge, if it was prepared for
/// that.
pub fn decided(path: Option<&Path>, set: &Set) -> Result<(Checked, Option<Arc<Prepared>>), Error> {
    let mut checked = fmus::scenario(path, set)?;
    let (_, prepared) = choose(&mut checked, &[], &Isolated::default())?;
    Ok((checked, prepared))
}

/// Changes by kind, relative to its largest extreme: of the extremes, which long steps also miss, and of all values at the times
/// of the coarse steps where they are known, since extremes may agree by chance.
fn changes(coarse: &[Seen], fine: &[Seen]) -> Vec<(String, f64)> {
    let mut kinds: Vec<(String, f64, f64)> = Vec::new();
    for (a, b) in coarse.iter().zip(fine) {
        let at_times = a.history.iter().zip(&b.history).map(|(a, b)| change(a.iter().zip(b.iter().step_by(2))));
        let change = at_times.fold(change(a.range.iter().zip(&b.range)), larger);
        let size = largest(b.range.iter().map(|x| x.abs()));
        match kinds.iter_mut().find(|known| known.0 == a.series) {
            Some(known) => (known.1, known.2) = (larger(known.1, change), larger(known.2, size)),
            None => kinds.push((a.series.clone(), change, size)),
        }
    }
    let relative = |(kind, change, size): (String, f64, f64)| (kind, if size == 0.0 { 0.0 } else { change / size });
    kinds.into_iter().map(relative).collect()
}

fn change<'a>(pairs: impl Iterator<Item = (&'a f64, &'a f64)>) -> f64 {
    largest(pairs.map(|(a, b)| (a - b).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_that_of_the_worst_member_relative_to_the_largest() {
        let seen = |series: &str, range, history: Option<&[f64]>| Seen {
            series: series.into(),
            range,
            history: history.map(<[f64]>::to_vec),
        };
        let (force, point) = ("wheel[].contact_force", "point[].acceleration");
        let coarse = [seen(force, [0.0, 99.0], Some(&[0.0, 90.0, 10.0])), seen(point, [-0.5, 1.0], None)];
        // The fine steps end on the coarse ones, too; the last coarse one was shortened.
        let fine = [seen(force, [0.0, 100.0], Some(&[0.0, 100.0, 87.0, 50.0])), seen(point, [-0.5, 1.1], None)];
        let found: Vec<(String, f64)> = changes(&coarse, &fine);
        assert_eq!(found[0], ("wheel[].contact_force".into(), 3.0 / 100.0));
        assert!(found[1].0 == "point[].acceleration" && (found[1].1 - 0.1 / 1.1).abs() < 1e-15);
        // The worst member counts, relative to the largest.
        let (worse, other) =
            (seen("wheel[].contact_force", [0.0, 40.0], None), seen("wheel[].contact_force", [0.0, 50.0], None));
        let both = changes(&[coarse[0].clone(), worse], &[fine[0].clone(), other]);
        assert_eq!((both.len(), both[0].1), (1, 10.0 / 100.0));
    }
}
