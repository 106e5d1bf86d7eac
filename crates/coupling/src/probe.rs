//! Trial steps before the first one: does a subsystem come back to a saved state, and does the deck answer forces as a
//! deck does?
//!
//! A few runs of some steps ([`STEPS`], if there are as many) start from the same state: under the forces at hand, and
//! under others that grow by v within the first step and then stay. The differences of the motion are what v does:
//!
//! ```text
//! Δd_k = Δd(t + k h),  Δḋ_k        after k steps
//! m_d  = Σ v² · h² (k²/2 − k/2 + 1/4) / Σ v Δd_k        the mass a support that would be displaced so
//! m_v  = Σ v² · h (k − 1/2)           / Σ v Δḋ_k        the mass a support that would gain such a velocity
//! ```
//!
//! Both are the mass itself for a free mass and the trapezoidal rule, and m_d ≈ m_v for anything that moves by its
//! velocity; a sign or a unit that is wrong shows in one or in both ([`crate::verdict`]). Of all k the one that answers
//! most counts, so that an output that comes a step late does no harm.
//!
//! A bridge that cannot roll back is asked for another instance of itself for every run.

use std::ops::Range;

use crate::exchange::Sides;
use crate::identify::shape;
use crate::iteration::Coupling;
use crate::report::{IterationError, Side};
use crate::run::TimeAxis;
use crate::verdict::Response;
use ttb_contract::Subsystem;

/// Steps of a run.
const STEPS: usize = 4;
/// Forces tried, axle loads.
const FORCE: f64 = 0.1;
/// Motion of the deck tried on the train–track subsystem, m.
const MOTION: f64 = 1e-5;
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

/// Whether a repeated step that differs so much shows that a subsystem does not come back to its states.
pub fn is_lie(difference: f64) -> bool {
    difference > REPEATED[0]
}

/// By how much `repeated` differs from `first`, relative to its distance from `other`; rounding does not count. The two
/// halves, displacements and velocities, are looked at each by itself.
pub(crate) fn difference(first: &[f64], repeated: &[f64], other: &[f64], halves: usize) -> f64 {
    let most = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    let size = first.len().div_ceil(halves).max(1);
    let half = |((a, b), c): ((&[f64], &[f64]), &[f64])| {
        let rounding = REPEATED[1] * a.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
        let off = (most(a, b) - rounding).max(0.0);
        if off == 0.0 { 0.0 } else { off / most(a, c) }
    };
    first.chunks(size).zip(repeated.chunks(size)).zip(other.chunks(size)).map(half).fold(0.0, f64::max)
}

impl Coupling {
    /// Probes both sides between initialization and the first step of `axis`; afterwards they are where they were.
    /// `groups` are the forces, by position, that act on a deck of their own each.
    ///
    /// # Errors
    /// A subsystem fails or answers NaN.
    pub fn probe(
        &mut self,
        train_track: &mut dyn Subsystem,
        bridge: &mut dyn Subsystem,
        groups: &[Range<usize>],
        axis: TimeAxis,
    ) -> Result<Probe, IterationError> {
        let h = axis.size(0);
        let steps = (0..axis.steps()).take(STEPS).take_while(|n| axis.size(*n) == h).count();
        let mut sides = Sides { train_track, bridge, t: axis.time(0), h };
        let mut probe = Probe::default();
        if sides.train_track.can_roll_back() {
            probe.train_track = Some(self.repeat_train_track(&mut sides, steps)?);
        }
        let n = self.lambda.len();
        let rolls_back = sides.bridge.can_roll_back();
        if rolls_back {
            sides.bridge.save()?;
        }
        let load: Vec<f64> = (0..n).map(|i| FORCE * self.settings.force_scale * shape(i)).collect();
        let Some(loaded) = self.run_bridge(&mut sides, steps, &load)? else { return Ok(probe) };
        let Some(base) = self.run_bridge(&mut sides, steps, &vec![0.0; n])? else { return Ok(probe) };
        let comparable = self.exchange.now.len() == 2 * n;
        let mut responses: Vec<Response> =
            groups.iter().map(|g| Response::new(g.clone(), &load, &loaded, &base, h)).collect();
        // One force at a time; on every deck at once, since they do not know of each other.
        let several = responses.iter().map(|response| response.probed.len()).max().unwrap_or(0);
        for j in 0..if rolls_back && comparable { several } else { 0 } {
            let mut single = vec![0.0; n];
            for i in responses.iter().filter_map(|response| response.probed.get(j)) {
                single[*i] = load[*i];
            }
            let Some(answer) = self.run_bridge(&mut sides, steps, &single)? else { break };
            responses.iter_mut().for_each(|response| response.add(j, &single, &answer, &base));
        }
        if comparable {
            probe.responses = responses;
        }
        if rolls_back {
            if let Some(repeated) = self.run_bridge(&mut sides, steps, &load)? {
                let off = |group: &Range<usize>| {
                    let own = |motion: &Vec<f64>| -> Vec<f64> {
                        let halves = if comparable { 2 } else { 1 };
                        (0..halves).flat_map(|half| &motion[half * n..][group.clone()]).copied().collect()
                    };
                    let each = loaded.iter().zip(&repeated).zip(&base);
                    each.map(|((a, b), c)| difference(&own(a), &own(b), &own(c), 2)).fold(0.0, f64::max)
                };
                probe.bridge = groups.iter().map(off).collect();
            }
            sides.bridge.restore()?;
        }
        Ok(probe)
    }

    /// Motions after each of some steps under the forces at hand, which `change` joins in the course of the first one.
    fn run_bridge(
        &mut self,
        sides: &mut Sides,
        steps: usize,
        change: &[f64],
    ) -> Result<Option<Vec<Vec<f64>>>, IterationError> {
        let now = self.forces.now().to_vec();
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
            self.exchange.bridge(&mut trial, if k == 0 { &now } else { &after }, &after, true)?;
            motions.push(self.exchange.motion.clone());
        }
        Ok(Some(motions))
    }

    /// The same for the train–track subsystem: over the deck as it stands, over one that moves, and again.
    fn repeat_train_track(&mut self, sides: &mut Sides, steps: usize) -> Result<f64, IterationError> {
        let still = self.exchange.now.clone();
        let half = still.len() / 2;
        let wave = |(i, d): (usize, &f64)| if i < half { d + MOTION * shape(i) } else { *d };
        let moved: Vec<f64> = still.iter().enumerate().map(wave).collect();
        sides.train_track.save()?;
        let mut answers = Vec::new();
        for motion in [&still, &moved, &still] {
            sides.train_track.restore()?;
            let mut answer = vec![0.0; self.answer.len()];
            for k in 0..steps.min(2) {
                self.exchange.motion.copy_from_slice(motion);
                let mut later = sides.over(sides.t + k as f64 * sides.h, sides.h);
                self.exchange.train_track(&mut later, &mut answer, true)?;
            }
            answers.push(answer);
        }
        sides.train_track.restore()?;
        Ok(difference(&answers[0], &answers[2], &answers[1], 1))
    }

    /// Whether a step that has converged is to be repeated to see if the bridge comes back to the same motion: the 1st,
    /// the 2nd, the 4th and so on.
    pub(crate) fn audit_is_due(&mut self) -> bool {
        self.converged += 1;
        self.converged.is_power_of_two()
    }

    /// Repeats the bridge's part of the trial that gave [`Coupling::repeated`], under the same forces λ.
    pub(crate) fn audit(&mut self, sides: &mut Sides) -> Result<(), IterationError> {
        sides.bridge.restore()?;
        self.exchange.bridge(sides, self.forces.now(), &self.lambda, true)?;
        let off = difference(&self.repeated, &self.exchange.motion, &self.exchange.now, 2);
        if is_lie(off) {
            return Err(IterationError::NoReturn { t: sides.t, side: Side::Bridge, difference: off });
        }
        Ok(())
    }
}
