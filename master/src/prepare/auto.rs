//! `"step": "auto"`: macro step and sub-steps before the run starts.
//!
//! ```text
//! 1  frequencies of speed, irregularity, supports, wheel on rail → H, m              ttb_scenario::step
//! 2  a short stretch at (H, m) and at (H/2, m): all steps halved                     super::stretch
//!    error of a kind of quantity ≈ 4/3 · largest change / largest value     (second order)
//! 3  an error above the one allowed: H ← H/2, back to 2
//! ```

use std::path::Path;

use ttb_contract::finite::{larger, largest};
use ttb_fmi::temporary::Temporary;
use ttb_scenario::Checked;
use ttb_scenario::step::{Excited, Steps};

use super::fmus;
use super::stretch::{self, Seen, Stage};
use crate::connect::connected::Given;
use crate::connect::isolate::Isolated;
use crate::error::Error;
use crate::results::choice::{Choice, KindError, Tried};

/// Greatest error where the scenario says nothing.
const ERROR: f64 = 0.02;
/// Halvings at most.
const HALVINGS: usize = 5;
/// Richardson's factor for order 2: q − q_h ≈ 4/3 (q_{h/2} − q_h).
const RICHARDSON: f64 = 4.0 / 3.0;

/// Chooses, prints and sets the steps of a scenario that asks for it; without `given` bridges one is built.
pub fn choose(checked: &mut Checked, given: &[Given], isolated: &Isolated) -> Result<Option<Choice>, Error> {
    let time = checked.scenario.time;
    if time.step.given().is_some() {
        return Ok(None);
    }
    let folder = Temporary::new("ttb-auto-").map_err(Error::io(std::path::Path::new("temporary folder")))?;
    let built = if given.is_empty() { Some(fmus::bridge(checked, folder.path())?.0) } else { None };
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
    };
    let mut steps = checked.steps();
    let mut coarse = stretch::run(&short, steps, &stage)?;
    for _ in 0..=HALVINGS {
        let half = Steps { step: 0.5 * steps.step, ..steps };
        let fine = stretch::run(&short, half, &stage)?;
        choice.errors = coarse.as_ref().zip(fine.as_ref()).map_or_else(Vec::new, |(coarse, fine)| errors(coarse, fine));
        let worst = choice.errors.iter().map(|kind| kind.error).reduce(larger);
        choice.tried.push(Tried { step_s: steps.step, substeps: steps.substeps, error: worst });
        checked.set_steps(steps);
        if worst.is_some_and(|error| error <= choice.allowed_error) {
            break;
        }
        (steps, coarse) = (half, fine);
    }
    choice.print();
    Ok(Some(choice))
}

/// As [`fmus::scenario`], with a step that is left to the program chosen.
pub fn decided(path: Option<&Path>) -> Result<Checked, Error> {
    let mut checked = fmus::scenario(path)?;
    choose(&mut checked, &[], &Isolated::default())?;
    Ok(checked)
}

/// Errors by kind: by the extremes, which long steps also miss, and by all values at the times of the coarse steps where
/// they are known, since extremes may agree by chance.
fn errors(coarse: &[Seen], fine: &[Seen]) -> Vec<KindError> {
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
    let error = |(kind, change, size): (String, f64, f64)| KindError {
        kind,
        error: if size == 0.0 { 0.0 } else { RICHARDSON * change / size },
    };
    kinds.into_iter().map(error).collect()
}

fn change<'a>(pairs: impl Iterator<Item = (&'a f64, &'a f64)>) -> f64 {
    largest(pairs.map(|(a, b)| (a - b).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_that_of_the_worst_member_relative_to_the_largest() {
        let seen = |series: &str, range, history: Option<&[f64]>| Seen {
            series: series.into(),
            range,
            history: history.map(<[f64]>::to_vec),
        };
        let (force, point) = ("wheel[].contact_force", "point[].acceleration");
        let coarse = [seen(force, [0.0, 99.0], Some(&[0.0, 90.0, 10.0])), seen(point, [-0.5, 1.0], None)];
        // The fine steps end on the coarse ones, too; the last coarse one was shortened.
        let fine = [seen(force, [0.0, 100.0], Some(&[0.0, 100.0, 87.0, 50.0])), seen(point, [-0.5, 1.1], None)];
        let found: Vec<(String, f64)> = errors(&coarse, &fine).into_iter().map(|k| (k.kind, k.error)).collect();
        assert_eq!(found[0], ("wheel[].contact_force".into(), RICHARDSON * 3.0 / 100.0));
        assert!(found[1].0 == "point[].acceleration" && (found[1].1 - RICHARDSON * 0.1 / 1.1).abs() < 1e-15);
        // The worst member counts, relative to the largest.
        let (worse, other) =
            (seen("wheel[].contact_force", [0.0, 40.0], None), seen("wheel[].contact_force", [0.0, 50.0], None));
        let both = errors(&[coarse[0].clone(), worse], &[fine[0].clone(), other]);
        assert_eq!((both.len(), both[0].error), (1, RICHARDSON * 10.0 / 100.0));
    }
}
