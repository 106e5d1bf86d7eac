//! Several instances, and one that is used again.

use super::context::Context;
use super::drive::{Drive, confirmed, open, reference};
use super::finding::Finding;

/// Steps compared.
const STEPS: usize = 30;

/// A repeated run must be the same to the last bit or nearly so.
const ROUNDING: f64 = 1e-12;

/// A run alone, repeated, and beside another instance.
pub fn instances(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    if !plan.several {
        return Ok(());
    }
    let n = plan.steps(STEPS);
    let mut alone = Drive::fresh(&probe, &plan)?;
    let wanted = alone.steps(0..n, 0.0)?;
    alone.instance.free();
    let mut again = Drive::fresh(&probe, &plan)?;
    let repeated = again.steps(0..n, 0.0)?;
    if let Some(difference) = again.differ(&wanted, &repeated, ROUNDING) {
        let what = "the same run in a second instance, after the first was freed, gives something else";
        context.find(Finding::warning("not-repeatable", what).seen(difference));
    }
    again.instance.free();
    // Outputs that differ anyway say nothing about what follows.
    reference(&probe, &plan, n)?;
    let (mut a, mut b) = (Drive::fresh(&probe, &plan)?, Drive::fresh(&probe, &plan)?);
    let mut beside = Vec::new();
    for k in 0..n {
        beside.push(a.step(k, 0.0)?);
        b.step(k, 3.0)?;
    }
    a.instance.free();
    b.instance.free();
    if let Some(difference) = confirmed(&probe, &plan, &wanted, &beside, ROUNDING)? {
        let what = "two instances in one process disturb each other";
        context.find(Finding::error("instances", what).seen(difference));
    }
    Ok(())
}

/// After fmi2Reset all must be as in a fresh instance.
pub fn reset(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    let n = plan.steps(STEPS);
    let fresh = reference(&probe, &plan, n)?;
    let mut drive = Drive::fresh(&probe, &plan)?;
    let fresh = match fresh {
        // The run before the reset has other inputs, so that what stays of them shows.
        Some(fresh) => {
            drive.steps(0..n / 2, 3.0)?;
            fresh
        }
        None => drive.steps(0..n, 0.0)?,
    };
    let status = drive.instance.reset();
    drive.ok(status, "fmi2Reset")?;
    drive.begin()?;
    let after = drive.steps(0..n, 0.0)?;
    drive.instance.free();
    if let Some(difference) = confirmed(&probe, &plan, &fresh, &after, ROUNDING)? {
        let what = "a run after fmi2Reset is not that of a fresh instance";
        context.find(Finding::error("reset", what).seen(difference));
    }
    Ok(())
}
