//! ρ, the contraction of the plain iteration: the largest eigenvalue of −∂G/∂λ, by power iteration with trials.
//!
//! ```text
//! v ← G(λ⁰ + v) − G(λ⁰),    ρ ≈ |v_{k+1}|/|v_k|
//! ```
//!
//! All eigenvalues are real and not negative, so the quotients grow towards ρ. A deck yields most to loads that are alike
//! everywhere; that is where v begins. On the way it is seen how far forces can accelerate the deck:
//!
//! ```text
//! Δa = 2 Δḋ/h  (= 4 Δd/h² where no rates are known),    α = max |Δa|/|v|,  1/kg
//! ```

use ttb_contract::finite::larger;
use ttb_contract::{Ports, Subsystem};

use crate::algebra::norm;
use crate::error::IterationError;
use crate::report::STABLE;
use crate::trial::{Sides, Trials};

/// Trials of the power iteration beyond the first.
const POWER: usize = 3;
/// Change of a force to see its effect, axle loads: large beside the rounding of any FMU, small beside the contacts'
/// curvature.
pub(crate) const CHANGE: f64 = 1e-3;

/// A load that is much alike everywhere, with something of every other shape: multiples of the golden section, modulo 1.
pub(crate) fn shape(i: usize) -> f64 {
    0.5 + (i as f64 * 0.618_033_988_749_895).fract()
}

/// What the trials showed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Strength {
    /// ρ.
    pub rho: f64,
    /// α: how far a change of the forces at the end of a step accelerates the deck there, 1/kg.
    pub acceleration: f64,
    /// How many trials it took.
    pub trials: usize,
}

/// |Δa| of a change of the motion over a step.
fn accelerated(ports: &Ports, change: &[f64], h: f64) -> f64 {
    let parts = ports.parts(change);
    if parts.rates.is_empty() { 4.0 * norm(parts.positions) / (h * h) } else { 2.0 * norm(parts.rates) / h }
}

/// v of the start, and the trial load's size.
fn begin(trials: &Trials) -> (Vec<f64>, f64) {
    let n = trials.lambda.len();
    ((0..n).map(shape).collect(), CHANGE * trials.scale * (n as f64).sqrt())
}

/// ρ and α of the step from the saved states, about the forces at hand. The forces stay.
pub(crate) fn contraction(trials: &mut Trials, sides: &mut Sides) -> Result<Strength, IterationError> {
    let (mut v, load) = begin(trials);
    let at = trials.lambda.clone();
    trials.run(sides)?;
    let (base, still) = (trials.answer.clone(), trials.exchange.motion.clone());
    let mut strength = Strength { trials: POWER + 1, ..Strength::default() };
    for _ in 0..POWER {
        let size = norm(&v);
        if !(size > 0.0 && size.is_finite()) {
            break;
        }
        let factor = load / size;
        trials.lambda.iter_mut().zip(&at).zip(&v).for_each(|((l, t), v)| *l = t + factor * v);
        trials.run(sides)?;
        v.iter_mut().zip(&trials.answer).zip(&base).for_each(|((v, g), base)| *v = (g - base) / factor);
        strength.rho = norm(&v) / size;
        let change: Vec<f64> = trials.exchange.motion.iter().zip(&still).map(|(a, b)| a - b).collect();
        let seen = accelerated(trials.exchange.ports(), &change, sides.h) / load;
        strength.acceleration = larger(strength.acceleration, seen);
    }
    trials.lambda = at;
    Ok(strength)
}

/// The same without a step of the bridge itself: by trial instances of it, and by trials of the train–track side. Directional
/// derivatives may mean the instant and not the step: they save trial instances once they have given what a step gives. Where
/// there are no trial instances they can only warn: what says that all is well may be the wrong derivative. `None` if the bridge
/// has neither.
pub(crate) fn apart(trials: &mut Trials, sides: &mut Sides) -> Result<Option<Strength>, IterationError> {
    let (mut v, load) = begin(trials);
    let share = trials.exchange.share_of_force(sides.bridge);
    let mut change = vec![0.0; trials.exchange.now.len()];
    sides.train_track.save()?;
    trials.exchange.motion.clone_from(&trials.exchange.now);
    trials.run_train_track(sides, true)?;
    let base = trials.answer.clone();
    // Derivatives are those for inputs as they will be given.
    trials.exchange.announce(sides, trials.forces.now(), trials.forces.now())?;
    let (mut strength, mut at_rest) = (None::<Strength>, None);
    let mut derivatives = Derivatives::of(sides.bridge);
    for _ in 0..POWER {
        let size = norm(&v);
        if !(size > 0.0 && size.is_finite()) {
            break;
        }
        let factor = load / size;
        v.iter_mut().for_each(|v| *v *= factor);
        let seed: Vec<f64> = v.iter().map(|v| v * share).collect();
        let mut known = false;
        if matches!(derivatives, Derivatives::None | Derivatives::Untested) {
            known = change_apart(trials, sides, &v, &mut at_rest, &mut change)?;
            if known && matches!(derivatives, Derivatives::Untested) {
                let holds = derivatives_hold_apart(trials, sides, &seed, &change)?;
                derivatives = if holds { Derivatives::Hold } else { Derivatives::None };
            }
        }
        if !known && !matches!(derivatives, Derivatives::None) {
            known = sides.bridge.derivative(&seed, &mut change).is_ok();
            if matches!(derivatives, Derivatives::Untested) {
                derivatives = Derivatives::Untestable;
            }
        }
        if !known {
            break;
        }
        let exchange = &mut trials.exchange;
        let moved = exchange.motion.iter_mut().zip(&exchange.now).zip(&change);
        moved.for_each(|((m, now), c)| *m = now + c);
        sides.train_track.restore()?;
        trials.run_train_track(sides, true)?;
        v.iter_mut().zip(&trials.answer).zip(&base).for_each(|((v, g), base)| *v = (g - base) / factor);
        let seen = accelerated(trials.exchange.ports(), &change, sides.h) / load;
        let acceleration = larger(seen, strength.map_or(0.0, |known| known.acceleration));
        strength = Some(Strength { rho: norm(&v) / size, acceleration, trials: 0 });
    }
    sides.train_track.restore()?;
    let vouched = |strength: &Strength| strength.rho > STABLE || !matches!(derivatives, Derivatives::Untestable);
    Ok(strength.filter(vouched))
}

/// What is known of a bridge's directional derivatives.
enum Derivatives {
    /// There are none, or they are not those of a step.
    None,
    /// Nothing yet.
    Untested,
    /// There is no trial instance to test them on.
    Untestable,
    /// They are those of a step.
    Hold,
}

impl Derivatives {
    fn of(bridge: &dyn Subsystem) -> Self {
        if bridge.can_derive() { Self::Untested } else { Self::None }
    }
}

/// Derivatives off by more than this, relatively, are not those of the steps.
const CREDIBLE: f64 = 1e-3;

/// Whether derived changes of the motion are those that were seen. Positions and rates have different units: each part is
/// compared with itself.
pub(crate) fn alike(ports: &Ports, seen: &[f64], derived: &[f64]) -> bool {
    let parts = ports.parts(seen).each().into_iter().zip(ports.parts(derived).each());
    parts.into_iter().all(|(seen, derived)| {
        let off: f64 = seen.iter().zip(derived).map(|(seen, derived)| (seen - derived).powi(2)).sum();
        let whole: f64 = seen.iter().map(|seen| seen.powi(2)).sum();
        off <= CREDIBLE * CREDIBLE * whole
    })
}

/// Whether a trial instance that stands where the bridge stands derives the change that a step showed. The bridge itself is
/// not asked: one that refuses could not go on.
fn derivatives_hold_apart(
    trials: &mut Trials,
    sides: &mut Sides,
    seed: &[f64],
    seen: &[f64],
) -> Result<bool, IterationError> {
    let now = trials.forces.now();
    let Some(mut bridge) = sides.bridge.trial_instance(now)? else { return Ok(false) };
    let mut trial = Sides { train_track: &mut *sides.train_track, bridge: &mut *bridge, t: sides.t, h: sides.h };
    trials.exchange.announce(&mut trial, now, now)?;
    let mut derived = vec![0.0; seen.len()];
    let answered = trial.bridge.derivative(seed, &mut derived).is_ok();
    Ok(answered && alike(trials.exchange.ports(), seen, &derived))
}

/// What a change of the forces changes of the motion after a step, seen on trial instances; `at_rest` keeps the motion
/// without it.
fn change_apart(
    trials: &mut Trials,
    sides: &mut Sides,
    force: &[f64],
    at_rest: &mut Option<Vec<f64>>,
    change: &mut [f64],
) -> Result<bool, IterationError> {
    if at_rest.is_none() {
        *at_rest = step_apart(trials, sides, &vec![0.0; force.len()])?;
    }
    let (Some(base), Some(motion)) = (at_rest, step_apart(trials, sides, force)?) else { return Ok(false) };
    change.iter_mut().zip(&motion).zip(base).for_each(|((c, m), b)| *c = m - *b);
    Ok(true)
}

/// The motion after a step of a trial instance under the forces at hand and `force`.
fn step_apart(trials: &mut Trials, sides: &mut Sides, force: &[f64]) -> Result<Option<Vec<f64>>, IterationError> {
    let now = trials.forces.now();
    let Some(mut bridge) = sides.bridge.trial_instance(now)? else { return Ok(None) };
    let after: Vec<f64> = now.iter().zip(force).map(|(now, force)| now + force).collect();
    let mut trial = Sides { train_track: &mut *sides.train_track, bridge: &mut *bridge, t: sides.t, h: sides.h };
    trials.exchange.bridge(&mut trial, now, &after, false)?;
    Ok(Some(trials.exchange.motion.clone()))
}
