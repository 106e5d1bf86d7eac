//! A model of the interface for one step: how motion and answer change with the forces.
//!
//! ```text
//! H = ∂(d, ḋ)/∂λ,      J = I − ∂G/∂λ        for the step from the saved states, about the forces at hand
//! ```

use crate::acceleration::newton::Model;
use crate::error::IterationError;
use crate::probe::contraction::{CHANGE, alike, shape};
use crate::report::Source;
use crate::trial::{Sides, Trials};

/// The model, where it came from, and the trials it took.
pub(crate) struct Identified {
    pub model: Model,
    pub source: Source,
    pub trials: usize,
}

/// Identifies H and J: by directional derivatives of the bridge where they stand a test, else by its steps; the train–track
/// side steps once for every force. The forces stay.
pub(crate) fn identify(trials: &mut Trials, sides: &mut Sides) -> Result<Identified, IterationError> {
    let n = trials.lambda.len();
    let at = trials.lambda.clone();
    trials.run(sides)?;
    let (base, motion) = (trials.answer.clone(), trials.exchange.motion.clone());
    let scale = CHANGE * trials.scale;
    let asked = sides.bridge.can_derive();
    let derivatives = asked && derivatives_hold(trials, sides, &at, &motion)?;
    let (mut jacobian, mut compliance) = (vec![0.0; n * n], vec![0.0; n * motion.len()]);
    let (mut seed, mut change) = (vec![0.0; n], vec![0.0; motion.len()]);
    let share = scale * trials.exchange.share_of_force(sides.bridge);
    for j in 0..n {
        if derivatives {
            seed[j] = share;
            sides.bridge.derivative(&seed, &mut change)?;
            seed[j] = 0.0;
            sides.train_track.restore()?;
            trials.exchange.motion.iter_mut().zip(&motion).zip(&change).for_each(|((m, at), d)| *m = at + d);
            trials.run_train_track(sides, true)?;
        } else {
            trials.lambda[j] = at[j] + scale;
            trials.run(sides)?;
            trials.lambda[j] = at[j];
        }
        for i in 0..n {
            jacobian[i * n + j] = f64::from(u8::from(i == j)) - (trials.answer[i] - base[i]) / scale;
        }
        for (i, at) in motion.iter().enumerate() {
            compliance[i * n + j] = (trials.exchange.motion[i] - at) / scale;
        }
    }
    trials.lambda = at;
    Ok(Identified {
        model: Model { compliance, jacobian, ports: trials.exchange.ports().clone() },
        source: if derivatives { Source::Derivatives } else { Source::Trials },
        trials: n + 1 + usize::from(asked),
    })
}

/// Whether the bridge's directional derivatives are those of its steps *as the forces are sent*: along one change of all
/// forces they must give what a step gives. The bridge is left at the end of the step at λ⁰.
fn derivatives_hold(
    trials: &mut Trials,
    sides: &mut Sides,
    at: &[f64],
    motion: &[f64],
) -> Result<bool, IterationError> {
    let scale = CHANGE * trials.scale;
    let share = trials.exchange.share_of_force(sides.bridge);
    let wave = |i: usize| scale * shape(i);
    let seed: Vec<f64> = (0..at.len()).map(|i| share * wave(i)).collect();
    let mut change = vec![0.0; motion.len()];
    let derived = sides.bridge.derivative(&seed, &mut change);
    let probe: Vec<f64> = at.iter().enumerate().map(|(i, t)| t + wave(i)).collect();
    sides.bridge.restore()?;
    trials.exchange.bridge(sides, trials.forces.now(), &probe, true)?;
    let seen: Vec<f64> = trials.exchange.motion.iter().zip(motion).map(|(seen, before)| seen - before).collect();
    let holds = derived.is_ok() && alike(trials.exchange.ports(), &seen, &change);
    sides.bridge.restore()?;
    trials.exchange.bridge(sides, trials.forces.now(), at, true)?;
    Ok(holds)
}
