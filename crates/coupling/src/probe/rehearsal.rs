//! Trial steps before the first one, on each side alone: does a subsystem come back to a saved state, and does the deck answer forces as a
//! deck does?
//!
//! A few runs of four steps (of fewer, if there are not as many) start from the same state: under the forces at hand, and
//! under others that grow by v within the first step and then stay. The differences of the motion are what v does:
//!
//! ```text
//! Δd_k = Δd(t + k h),  Δḋ_k        after k steps
//! m_d  = Σ v² · h² (k²/2 − k/2 + 1/4) / Σ v Δd_k        the mass a support that would be displaced so
//! m_v  = Σ v² · h (k − 1/2)           / Σ v Δḋ_k        the mass a support that would gain such a velocity
//! ```
//!
//! Both are the mass itself for a free mass and the trapezoidal rule, and m_d ≈ m_v for anything that moves by its
//! velocity; a sign or a unit that is wrong shows in one or in both ([`super::response`]). Of all k the one that answers
//! most counts, so that an output that comes a step late does no harm.
//!
//! A bridge that cannot roll back is asked for another instance of itself for every run.

use std::ops::Range;

use ttb_contract::Ports;
use ttb_contract::finite::{larger, largest};

use crate::error::IterationError;
use crate::probe::contraction::shape;
use crate::probe::response::Response;
use crate::trial::{Sides, Trials};

/// Steps of a run.
const STEPS: usize = 4;
/// Forces tried, axle loads.
pub(crate) const FORCE: f64 = 0.1;
/// Motion of the deck tried on the train–track subsystem, m.
pub(crate) const MOTION: f64 = 1e-5;
/// A repeated step may differ by this part of what the trials in between had changed, and by this part of its value.
const REPEATED: [f64; 2] = [1e-8, 1e-13];

/// What was found out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Probe {
    /// By how much a step of the train–track subsystem repeated from a saved state differed, relative to what the trials in
    /// between had changed; none if it cannot roll back.
    pub train_track: Option<f64>,
    /// The same of every group; empty if the bridge cannot roll back.
    pub bridge: Vec<f64>,
    /// Of every group of forces that act on a deck of their own; empty if the bridge cannot be probed.
    pub responses: Vec<Response>,
}

/// Whether a repeated step that differs so much shows a subsystem that comes back to its states.
pub fn returns(difference: f64) -> bool {
    difference <= REPEATED[0]
}

/// By how much the motion `repeated` differs from `first`, relative to its distance from `other`; rounding does not count.
/// Positions, rates and others are looked at each by themselves. NaN if one of the numbers is.
pub(crate) fn difference(ports: &Ports, first: &[f64], repeated: &[f64], other: &[f64]) -> f64 {
    let parts = |of| ports.parts(of).each();
    let each = parts(first).into_iter().zip(parts(repeated)).zip(parts(other));
    largest(each.map(|((first, repeated), other)| alike(first, repeated, other)))
}

/// The same of numbers of one kind.
pub(crate) fn alike(first: &[f64], repeated: &[f64], other: &[f64]) -> f64 {
    let apart = |a: &[f64], b: &[f64]| largest(a.iter().zip(b).map(|(a, b)| (a - b).abs()));
    let rounding = REPEATED[1] * largest(first.iter().map(|a| a.abs()));
    let off = larger(apart(first, repeated) - rounding, 0.0);
    if off == 0.0 { 0.0 } else { off / apart(first, other) }
}

/// Tries both sides over at most `steps` steps; afterwards they are where they were. `groups` are the ports, by position,
/// that act on a deck of their own each.
pub(crate) fn rehearse(
    trials: &mut Trials,
    sides: &mut Sides,
    groups: &[Range<usize>],
    steps: usize,
) -> Result<Probe, IterationError> {
    let steps = steps.min(STEPS);
    let mut probe = Probe::default();
    if sides.train_track.can_roll_back() {
        probe.train_track = Some(repeat_train_track(trials, sides, steps)?);
    }
    let n = trials.lambda.len();
    let (rolls_back, h) = (sides.bridge.can_roll_back(), sides.h);
    if rolls_back {
        sides.bridge.save()?;
    }
    let load: Vec<f64> = (0..n).map(|i| FORCE * trials.scale * shape(i)).collect();
    let Some(loaded) = run_bridge(trials, sides, steps, &load)? else { return Ok(probe) };
    let Some(base) = run_bridge(trials, sides, steps, &vec![0.0; n])? else { return Ok(probe) };
    let ports = trials.exchange.ports().clone();
    let mut responses: Vec<Response> =
        groups.iter().map(|g| Response::new(&ports, g.clone(), &load, &loaded, &base, h)).collect();
    // One force at a time; on every deck at once, since they do not know of each other.
    let several = responses.iter().map(|response| response.probed.len()).max().unwrap_or(0);
    for j in 0..if rolls_back && ports.complete() { several } else { 0 } {
        let mut single = vec![0.0; n];
        for i in responses.iter().filter_map(|response| response.probed.get(j)) {
            single[*i] = load[*i];
        }
        let Some(answer) = run_bridge(trials, sides, steps, &single)? else { break };
        responses.iter_mut().for_each(|response| response.add(j, &single, &answer, &base));
    }
    if ports.complete() {
        probe.responses = responses;
    }
    if rolls_back {
        if let Some(repeated) = run_bridge(trials, sides, steps, &load)? {
            let runs = || loaded.iter().zip(&repeated).zip(&base);
            probe.bridge = if ports.complete() {
                let off = |group: &Range<usize>| largest(runs().map(|((a, b), c)| group_off(&ports, group, a, b, c)));
                groups.iter().map(off).collect()
            } else {
                vec![largest(runs().map(|((a, b), c)| difference(&ports, a, b, c)))]
            };
        }
        sides.bridge.restore()?;
    }
    Ok(probe)
}

/// [`difference`] over the ports of a group.
fn group_off(ports: &Ports, group: &Range<usize>, first: &[f64], repeated: &[f64], other: &[f64]) -> f64 {
    let [first, repeated, other] = [first, repeated, other].map(|motion| ports.parts(motion));
    let positions =
        alike(&first.positions[group.clone()], &repeated.positions[group.clone()], &other.positions[group.clone()]);
    let rates = alike(&first.rates[group.clone()], &repeated.rates[group.clone()], &other.rates[group.clone()]);
    larger(positions, rates)
}

/// Motions after each of some steps under the forces at hand, which `change` joins in the course of the first one.
fn run_bridge(
    trials: &mut Trials,
    sides: &mut Sides,
    steps: usize,
    change: &[f64],
) -> Result<Option<Vec<Vec<f64>>>, IterationError> {
    let now = trials.forces.now().to_vec();
    let after: Vec<f64> = now.iter().zip(change).map(|(now, change)| now + change).collect();
    let mut another = None;
    if sides.bridge.can_roll_back() {
        sides.bridge.restore()?;
    } else {
        another = sides.bridge.trial_instance(&now)?;
        if another.is_none() {
            return Ok(None);
        }
    }
    let (t, h) = (sides.t, sides.h);
    let bridge = another.as_deref_mut().unwrap_or(&mut *sides.bridge);
    let mut trial = Sides { train_track: &mut *sides.train_track, bridge, t, h };
    let mut motions = Vec::new();
    for k in 0..steps {
        trial.t = t + k as f64 * h;
        trials.exchange.bridge(&mut trial, if k == 0 { &now } else { &after }, &after, true)?;
        motions.push(trials.exchange.motion.clone());
    }
    Ok(Some(motions))
}

/// The same for the train–track subsystem: over the deck as it stands, over one that moves, and again.
fn repeat_train_track(trials: &mut Trials, sides: &mut Sides, steps: usize) -> Result<f64, IterationError> {
    let still = trials.exchange.now.clone();
    let mut moved = still.clone();
    let positions = trials.exchange.ports().parts_mut(&mut moved).positions;
    positions.iter_mut().enumerate().for_each(|(i, d)| *d += MOTION * shape(i));
    sides.train_track.save()?;
    let mut answers = Vec::new();
    for motion in [&still, &moved, &still] {
        sides.train_track.restore()?;
        let mut answer = vec![0.0; trials.answer.len()];
        for k in 0..steps.min(2) {
            trials.exchange.motion.copy_from_slice(motion);
            let mut later = sides.over(sides.t + k as f64 * sides.h, sides.h);
            trials.exchange.train_track(&mut later, &mut answer, true)?;
        }
        answers.push(answer);
    }
    sides.train_track.restore()?;
    Ok(alike(&answers[0], &answers[2], &answers[1]))
}
