//! The truth about roll-back: a state that comes back must bring back everything.

use std::time::{Duration, Instant};

use ttb_fmi::platform::resident;

use super::context::Context;
use super::drive::{Drive, open, reference};
use super::finding::Finding;
use super::run::growth;

/// Steps before the state is saved, steps that are repeated, steps after which it is restored again.
const BEFORE: usize = 10;
const REPEATED: usize = 5;
const LATER: usize = 40;

/// What counts as rounding, relative to the largest value.
const ROUNDING: f64 = 1e-12;

/// Saves and restores in the search for a leak, and time for it.
const CYCLES: usize = 3000;
const CYCLE_TIME: Duration = Duration::from_secs(2);

/// Whether there is anything to test.
fn declared(context: &Context) -> bool {
    context.description.co_simulation.can_get_and_set_state
}

/// First step, repeated, repeated after another trial, repeated later in the run.
pub fn roll_back(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    let later = plan.steps(LATER);
    if !declared(context) || !probe.has_states() || later < BEFORE + REPEATED {
        return Ok(());
    }
    let repeated = BEFORE..BEFORE + REPEATED;
    let expected = reference(&probe, &plan, repeated.end)?;

    let mut drive = Drive::fresh(&probe, &plan)?;
    drive.steps(0..BEFORE, 0.0)?;
    let inputs = plan.values(plan.time(BEFORE - 1), 0.0);
    let state = drive.save(None)?;
    let first = drive.steps(repeated.clone(), 0.0)?;
    if let Some(difference) = expected.and_then(|run| drive.differ(&run[BEFORE..], &first, ROUNDING)) {
        let what = "fmi2GetFMUstate disturbs the run";
        context.find(Finding::error("roll-back-save", what).at(at(&plan)).seen(difference));
    }
    drive.restore(&state)?;
    let second = drive.steps(repeated.clone(), 0.0)?;
    drive.restore(&state)?;
    let third = drive.steps(repeated.clone(), 0.0)?;
    drive.restore(&state)?;
    drive.steps(repeated.clone(), 3.0)?;
    drive.restore(&state)?;
    let after_trial = drive.steps(repeated.clone(), 0.0)?;
    let untrue = "fmi2SetFMUstate does not bring back all of the state: a repeated step differs";
    let difference = drive.differ(&second, &third, ROUNDING).or(drive.differ(&second, &after_trial, ROUNDING));
    if let Some(difference) = difference {
        context.find(Finding::error("roll-back", untrue).at(at(&plan)).seen(difference));
        return Ok(());
    }
    if let Some(difference) = drive.differ(&first, &second, ROUNDING) {
        let what = "the first step after saving differs from its repetitions: restore before the first trial, too";
        context.find(Finding::warning("roll-back-first", what).at(at(&plan)).seen(difference));
    }
    drive.steps(repeated.end..later, 0.0)?;
    drive.restore(&state)?;
    let late = drive.steps(repeated.clone(), 0.0)?;
    if let Some(difference) = drive.differ(&second, &late, ROUNDING) {
        let what = "a state restored later in the run does not repeat its step";
        context.find(Finding::error("roll-back-later", what).at(at(&plan)).seen(difference));
    }
    inputs_come_back(context, &mut drive, &state, &inputs)?;
    let (status, nulled) = drive.instance.free_state(state);
    drive.ok(status, "fmi2FreeFMUstate")?;
    if !nulled {
        context.find(Finding::warning("free-state", "fmi2FreeFMUstate does not set the handle to NULL"));
    }
    drive.instance.free();
    Ok(())
}

/// The inputs belong to the state.
fn inputs_come_back(
    context: &Context,
    drive: &mut Drive,
    state: &ttb_fmi2::probe::State,
    inputs: &[f64],
) -> Result<(), Finding> {
    drive.set(&drive.plan.values(drive.plan.time(BEFORE), 5.0))?;
    drive.restore(state)?;
    let mut back = vec![0.0; inputs.len()];
    if inputs.is_empty() || drive.instance.get_real(drive.plan.inputs(), &mut back) > ttb_fmi2::types::Status::Warning {
        return Ok(()); // reading inputs here is not everyone's strength
    }
    if let Some(i) = (0..inputs.len()).find(|&i| inputs[i] != back[i]) {
        let what = "fmi2SetFMUstate does not bring back the inputs";
        context.find(Finding::warning("roll-back-inputs", what).seen(format!("{} instead of {}", back[i], inputs[i])));
    }
    Ok(())
}

/// Through bytes, into the same instance and into another.
pub fn serialize(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    let can = declared(context) && context.description.co_simulation.can_serialize_state;
    if !can || !probe.has_states() || !probe.has_serialization() || plan.steps(LATER) < BEFORE + REPEATED {
        return Ok(());
    }
    let repeated = BEFORE..BEFORE + REPEATED;
    reference(&probe, &plan, repeated.end)?;
    let mut drive = Drive::fresh(&probe, &plan)?;
    drive.steps(0..BEFORE, 0.0)?;
    let state = drive.save(None)?;
    let broken = |evidence: String| Finding::error("serialize", "a state does not become bytes").seen(evidence);
    let bytes = drive.instance.serialize(&state).map_err(broken)?;
    let again = drive.instance.serialize(&state).map_err(broken)?;
    if bytes.len() != again.len() {
        let seen = format!("{} and {} bytes", bytes.len(), again.len());
        context.find(Finding::warning("serialize", "the same state has several sizes").seen(seen));
    }
    drive.restore(&state)?;
    let wanted = drive.steps(repeated.clone(), 0.0)?;
    let (status, copy) = drive.instance.deserialize(&bytes);
    drive.ok(status, "fmi2DeSerializeFMUstate")?;
    drive.restore(&copy)?;
    let untrue = "a state that went through bytes does not repeat its step";
    let same = drive.steps(repeated.clone(), 0.0)?;
    if let Some(difference) = drive.differ(&wanted, &same, ROUNDING) {
        context.find(Finding::error("serialize", untrue).at("the same instance").seen(difference));
        return Ok(());
    }
    drive.instance.free_state(state);
    drive.instance.free_state(copy);
    drive.instance.free();
    if !plan.several {
        return Ok(());
    }
    let mut other = Drive::fresh(&probe, &plan)?;
    let (status, copy) = other.instance.deserialize(&bytes);
    other.ok(status, "fmi2DeSerializeFMUstate")?;
    other.restore(&copy)?;
    let there = other.steps(repeated, 0.0)?;
    if let Some(difference) = other.differ(&wanted, &there, ROUNDING) {
        context.find(Finding::error("serialize", untrue).at("another instance").seen(difference));
    }
    other.instance.free_state(copy);
    other.instance.free();
    Ok(())
}

/// Thousands of saves and restores, over one state and with fresh ones.
pub fn memory(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    if !declared(context) || !probe.has_states() {
        return Ok(());
    }
    let mut drive = Drive::fresh(&probe, &plan)?;
    let mut kept = drive.save(None)?;
    let mut resident_after = Vec::with_capacity(CYCLES);
    let begin = Instant::now();
    for _ in 0..CYCLES {
        kept = drive.save(Some(kept))?;
        drive.restore(&kept)?;
        let fresh = drive.save(None)?;
        let (status, _) = drive.instance.free_state(fresh);
        drive.ok(status, "fmi2FreeFMUstate")?;
        resident_after.push(resident());
        if begin.elapsed() > CYCLE_TIME {
            break;
        }
    }
    if let Some(seen) = growth(&resident_after) {
        context.find(Finding::warning("state-leak", "memory grows with every saved state").seen(seen));
    }
    drive.instance.free_state(kept);
    drive.instance.free();
    Ok(())
}

fn at(plan: &super::plan::Plan) -> String {
    format!("t = {} s", plan.time(BEFORE))
}
