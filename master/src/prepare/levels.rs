//! Which step is short enough: what halving it changes, level by level.
//!
//! ```text
//! d_k   largest change of a kind of quantity from H/2^k to H/2^{k+1}, relative to its largest value;
//!       counted as d_{k−1}/4 at least: a single change may be small by chance
//! r     least of the known d_{k−1}/d_k and d_k/d_{k+1}, from 4/3 to 4; 2 where none is known: 4 is order two, 2 order one
//! ε_k = 2 d_k r/(r − 1)                                        Richardson's estimate at H/2^k, doubled
//! ```
//!
//! ε is an estimate and no bound: of another stretch than the run, from two or three steps. A kind whose d falls by less than
//! √2 where it is still above what is allowed would drive the step down in vain: it is told and counts no more.

use ttb_contract::finite::larger;
use ttb_scenario::step::Steps;

use crate::results::choice::{KindError, Tried};

/// On Richardson's estimate.
const SAFETY: f64 = 2.0;
/// Bounds of r, and r where it is not known.
const RATIO: [f64; 2] = [4.0 / 3.0, 4.0];
const UNKNOWN: f64 = 2.0;
/// What falls by less in a halving does not fall.
const FALLS: f64 = std::f64::consts::SQRT_2;

/// What halving a step changed: kinds and relative changes; nothing if the iteration did not converge.
pub type Changes = Option<Vec<(String, f64)>>;

/// The steps that were tried.
pub struct Levels {
    allowed: f64,
    levels: Vec<(Steps, Changes)>,
}

impl Levels {
    /// None yet; `allowed` is the greatest error.
    pub fn new(allowed: f64) -> Self {
        Self { allowed, levels: Vec::new() }
    }

    /// Takes in the next level, and tells whether it is the last that is needed.
    pub fn add(&mut self, steps: Steps, changes: Changes) -> bool {
        self.levels.push((steps, changes));
        self.enough().is_some()
    }

    /// The level that is taken: the first that is short enough, or the last.
    pub fn taken(&self) -> usize {
        self.enough().unwrap_or(self.levels.len().saturating_sub(1))
    }

    fn enough(&self) -> Option<usize> {
        let stuck = self.stuck();
        let within = |k: &usize| {
            let counted = |error: &&KindError| !stuck.contains(&error.kind);
            let errors = self.errors(*k);
            !errors.is_empty() && errors.iter().filter(counted).all(|error| error.error <= self.allowed)
        };
        (0..self.levels.len()).find(within)
    }

    /// Kinds whose error is too large and does not fall from the last level but one to the last.
    pub fn stuck(&self) -> Vec<String> {
        let Some(last) = self.levels.len().checked_sub(1).filter(|last| *last > 0) else { return Vec::new() };
        let does_not_fall = |error: &KindError| {
            let (before, after) = (self.change(last - 1, &error.kind), self.change(last, &error.kind));
            error.error > self.allowed && before.zip(after).is_some_and(|(before, after)| before < FALLS * after)
        };
        self.errors(last).into_iter().filter(does_not_fall).map(|error| error.kind).collect()
    }

    /// Estimated errors at a level.
    pub fn errors(&self, k: usize) -> Vec<KindError> {
        let Some((_, Some(changes))) = self.levels.get(k) else { return Vec::new() };
        let error = |(kind, change): &(String, f64)| {
            let before = k.checked_sub(1).and_then(|before| self.change(before, kind));
            let change = before.map_or(*change, |before| change.max(before / RATIO[1]));
            let ratios = [before.map(|before| before / change), self.change(k + 1, kind).map(|after| change / after)];
            let ratio = ratios.into_iter().flatten().reduce(f64::min).unwrap_or(UNKNOWN).clamp(RATIO[0], RATIO[1]);
            let error = if change > 0.0 { SAFETY * change * ratio / (ratio - 1.0) } else { 0.0 };
            KindError { kind: kind.clone(), error }
        };
        changes.iter().map(error).collect()
    }

    fn change(&self, k: usize, kind: &str) -> Option<f64> {
        let (_, changes) = self.levels.get(k)?;
        changes.as_ref()?.iter().find(|(known, _)| known == kind).map(|(_, change)| *change)
    }

    /// For the summary.
    pub fn tried(&self) -> Vec<Tried> {
        let taken = self.taken();
        let tried = |(k, (steps, changes)): (usize, &(Steps, Changes))| Tried {
            step_s: steps.step,
            substeps: steps.substeps,
            error: changes.as_ref().map(|_| self.errors(k).iter().map(|error| error.error).fold(0.0, larger)),
            taken: k == taken,
        };
        self.levels.iter().enumerate().map(tried).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels(allowed: f64, changes: &[&[f64]]) -> Levels {
        let mut levels = Levels::new(allowed);
        for (k, changes) in changes.iter().enumerate() {
            let named = changes.iter().enumerate().map(|(i, change)| (format!("kind {i}"), *change)).collect();
            let last = levels.add(Steps { step: 0.5_f64.powi(k as i32), substeps: 1 }, Some(named));
            assert!(!last || levels.taken() < changes.len() + k);
        }
        levels
    }

    fn of(levels: &Levels, k: usize) -> Vec<f64> {
        levels.errors(k).iter().map(|error| error.error).collect()
    }

    /// q_h = q + c h^p: the true error at h is c h^p, the change c h^p (1 − 2^{−p}).
    #[test]
    fn the_estimate_holds_the_error_of_orders_from_a_half_to_two() {
        for order in [0.5_f64, 1.0, 1.5, 2.0] {
            let error = |k: i32| 0.1 * 2.0_f64.powf(-order * f64::from(k));
            let change = |k: i32| error(k) - error(k + 1);
            let found = of(&levels(1e-9, &[&[change(0)], &[change(1)], &[change(2)]]), 2)[0] / error(2);
            assert!((2.0 - 1e-9..2.1).contains(&found), "order {order}: {found}");
            // From one change alone, of whatever order.
            assert!(of(&levels(1e-9, &[&[change(0)]]), 0)[0] / error(0) > 1.1, "order {order}");
        }
    }

    #[test]
    fn a_change_that_is_small_by_chance_counts_as_a_quarter_of_the_one_before() {
        let found = levels(1e-9, &[&[0.08], &[1e-6]]);
        assert!((of(&found, 1)[0] - 2.0 * 0.02 * 4.0 / 3.0).abs() < 1e-15);
    }

    #[test]
    fn what_does_not_fall_is_told_and_does_not_drive_the_step() {
        let found = levels(0.02, &[&[0.002, 0.9], &[0.0005, 0.8]]);
        assert_eq!((found.taken(), found.stuck()), (0, vec!["kind 1".to_string()]));
        let tried = found.tried();
        assert_eq!((tried[0].taken, tried[1].taken), (true, false));
        // While it falls, it does.
        let falls = levels(0.02, &[&[0.002, 0.9], &[0.0005, 0.3]]);
        assert!(falls.stuck().is_empty() && falls.enough().is_none() && falls.taken() == 1);
    }

    #[test]
    fn an_iteration_that_did_not_converge_is_no_choice() {
        let mut found = Levels::new(0.02);
        let steps = Steps { step: 1e-3, substeps: 2 };
        assert!(!found.add(steps, None));
        assert!(found.add(steps, Some(vec![("a".into(), 1e-3)])));
        assert_eq!((found.taken(), found.tried()[0].error), (1, None));
    }
}
