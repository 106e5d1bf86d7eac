//! What is done when a step does not converge: once more by quasi-Newton with an empty memory, then in two halves, or stop.

use crate::error::IterationError;
use crate::probe::identify;
use crate::report::{Outcome, StepInfo};
use crate::scheme::shared::Shared;
use crate::scheme::step::Mode;
use crate::settings::{Method, OnFailure};
use crate::trial::Sides;

/// Halvings of a step at most, under [`OnFailure::Halve`].
const HALVINGS: usize = 4;

/// A step by iteration, accepted; `depth` halvings were made to get here.
pub(crate) fn step(shared: &mut Shared, sides: &mut Sides, depth: usize) -> Result<StepInfo, IterationError> {
    let due = depth == 0 && shared.audit.is_due();
    let info = attempt(shared, sides, due)?;
    let (policy, t, h) = (shared.iteration.settings.on_failure, sides.t, sides.h);
    if info.outcome == Outcome::Converged && due {
        shared.audit.remember(&shared.iteration);
        shared.audit.repeat(&mut shared.iteration.trials, sides)?;
    }
    if info.outcome == Outcome::Converged || policy == OnFailure::Accept {
        let work = shared.accept(sides, false)?;
        if shared.iteration.strategy.observe(info.iterations).is_some() {
            shared.note(t);
        }
        return Ok(StepInfo { work, ..info });
    }
    if policy == OnFailure::Stop || depth == HALVINGS {
        return Err(not_converged(shared, sides, info)?);
    }
    sides.restore()?;
    let first = step(shared, &mut sides.over(t, 0.5 * h), depth + 1)?;
    let second = step(shared, &mut sides.over(t + 0.5 * h, 0.5 * h), depth + 1)?;
    let mut work = first.work;
    work += second.work;
    Ok(StepInfo {
        work,
        iterations: info.iterations + first.iterations + second.iterations,
        train_track_trials: info.train_track_trials + first.train_track_trials + second.train_track_trials,
        roll_backs: info.roll_backs + 1 + first.roll_backs + second.roll_backs,
        halvings: 1 + first.halvings + second.halvings,
        rescues: info.rescues + first.rescues + second.rescues,
        ..second
    })
}

/// The step at this size: looked at where that is due, measured before the first one, with a model where one is wanted,
/// begun again once.
fn attempt(shared: &mut Shared, sides: &mut Sides, due: bool) -> Result<StepInfo, IterationError> {
    sides.save()?;
    shared.iteration.trials.predict(sides.h);
    if due {
        shared.audit.look(&mut shared.iteration.trials, sides, &mut shared.report)?;
    }
    if shared.report.contraction.is_none() {
        shared.report.contraction = Some(shared.contraction(sides)?.rho);
    }
    if shared.iteration.strategy.wants_model() {
        let found = identify(&mut shared.iteration.trials, sides)?;
        shared.report.identification_trials += found.trials;
        shared.report.model = Some(found.source);
        shared.iteration.strategy.take(found.model, sides.h);
        shared.note(sides.t);
    }
    let iteration = &mut shared.iteration;
    iteration.begin(sides.h);
    let limit = iteration.settings.max_iterations;
    let plain = iteration.settings.method == Method::FixedPoint;
    let (info, failed) = match iteration.iterate(sides, Mode::RollBack, limit) {
        Ok(info) if info.outcome == Outcome::Converged || plain => return Ok(info),
        Ok(info) => (info, None),
        // Not the step is impossible, but forces that were tried on the way.
        Err(failed @ (IterationError::Subsystem(_) | IterationError::NotFinite { .. }))
            if iteration.made > 1 && !plain =>
        {
            let (iterations, roll_backs) = (iteration.made, iteration.made - 1);
            (StepInfo { iterations, roll_backs, train_track_trials: iterations, ..StepInfo::default() }, Some(failed))
        }
        Err(error) => return Err(error),
    };
    iteration.trials.predict(sides.h);
    iteration.strategy.begin_rescue(shared.report.contraction);
    let rescued = iteration.iterate(sides, Mode::RollBack, limit).map_err(|error| failed.unwrap_or(error))?;
    Ok(StepInfo {
        iterations: info.iterations + rescued.iterations,
        train_track_trials: info.train_track_trials + rescued.train_track_trials,
        roll_backs: info.roll_backs + 1 + rescued.roll_backs,
        rescues: 1,
        ..rescued
    })
}

/// The error of a step that did not converge, with ρ where it can be measured; or that the bridge does not come back to its
/// state, which may be why. Both sides are put back.
fn not_converged(shared: &mut Shared, sides: &mut Sides, info: StepInfo) -> Result<IterationError, IterationError> {
    let (t, h) = (sides.t, sides.h);
    shared.iteration.trials.predict(h);
    let rho = diagnose(shared, sides);
    sides.restore()?;
    Ok(match rho {
        Err(error @ IterationError::NoReturn { .. }) => error,
        rho => IterationError::NotConverged { t, h, info: Box::new(info), rho: rho.ok() },
    })
}

/// ρ at the predicted forces, measured between two equal trials of the bridge.
fn diagnose(shared: &mut Shared, sides: &mut Sides) -> Result<f64, IterationError> {
    shared.iteration.run_plain(sides)?;
    shared.audit.remember(&shared.iteration);
    let rho = shared.contraction(sides)?.rho;
    shared.audit.repeat(&mut shared.iteration.trials, sides)?;
    Ok(rho)
}
