//! Steps as masters send them: with rounding noise, halved, next to nothing; and one that no master should send, which
//! begins elsewhere than the last one has ended.

use ttb_contract::finite::not_finite;
use ttb_fmi::Status;

use super::context::Context;
use super::drive::{Drive, confirmed, open, reference};
use super::finding::{Finding, Severity};

/// Steps compared.
const STEPS: usize = 100;

/// Allowed difference between a run and one with rounding noise in its times, relative.
const NOISE: f64 = 1e-6;

/// Jitter for all; halves and tiny steps for those that say they can.
pub fn steps(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    let n = plan.steps(STEPS);
    let exact = reference(&probe, &plan, n)?;

    let mut drive = Drive::fresh(&probe, &plan)?;
    let noisy = |k: usize| {
        // Times added up, as many masters do: t and h lose their last digits.
        let t: f64 = (0..k).fold(plan.start, |t, _| t + plan.h);
        (t, if k.is_multiple_of(2) { plan.time(k + 1) - t } else { plan.h * (1.0 - 3e-16 * k as f64) })
    };
    let run: Result<Vec<_>, _> =
        (0..n.saturating_sub(1)).map(|k| drive.step_from(noisy(k).0, noisy(k).1, 0.0)).collect();
    let varies = context.description.co_simulation.can_handle_variable_communication_step_size;
    let what = "rounding noise in time and step size disturbs it";
    // Sizes that differ by their last digits are of different size, if one takes it exactly.
    let found = Finding::error("step-jitter", what).of(if varies { Severity::Error } else { Severity::Warning });
    drive.instance.free();
    match (run, exact) {
        (Err(refused), _) => {
            // Who discards a step lets the master choose another one.
            let severity = refused.severity.max(found.severity);
            context.find(found.of(severity).at(refused.at).seen(refused.what));
        }
        (Ok(run), Some(exact)) => {
            if let Some(difference) = confirmed(&probe, &plan, &exact, &run, NOISE)? {
                context.find(found.seen(difference));
            }
        }
        (Ok(_), None) => {}
    }
    if !varies || n < 4 || !plan.several {
        return Ok(());
    }

    let mut drive = Drive::fresh(&probe, &plan)?;
    let h = plan.h;
    let sizes = [
        (0.0, h, "step-halved"),
        (h, 0.5 * h, "step-halved"),
        (1.5 * h, 0.5 * h, "step-halved"),
        (2.0 * h, 1e-17 * h, "step-tiny"),
        (2.0 * h, h, "step-tiny"),
    ];
    for (t, h, name) in sizes {
        let what =
            if name == "step-tiny" { "it stumbles over a step of next to nothing" } else { "it does not step by h/2" };
        let finding = Finding::error(name, what).at(format!("fmi2DoStep from t = {} s by {h:e} s", plan.start + t));
        match drive.step_from(plan.start + t, h, 0.0) {
            Err(refused) => {
                // Who discards a step lets the master choose another one; no master needs the tiny one.
                let mild = refused.severity > Severity::Error || name == "step-tiny";
                let finding = if mild { finding.of(Severity::Warning) } else { finding };
                context.find(finding.seen(format!("{} {}", refused.what, refused.evidence)));
                return Ok(());
            }
            Ok(values) => {
                if let Some(i) = not_finite(&values) {
                    context.find(finding.seen(format!("{} is {}", plan.name(i), values[i])));
                    return Ok(());
                }
            }
        }
    }
    drive.instance.free();
    Ok(())
}

/// A step that leaves out ten, which FMI 2.0 (section 4.2.2) leaves no master free to ask for: an FMU that takes it goes on
/// as if nothing had happened, and a mistake of a master stays hidden.
pub fn elsewhere(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    let n = plan.steps(12);
    if n < 4 {
        return Ok(());
    }
    let mut drive = Drive::fresh(&probe, &plan)?;
    drive.step(0, 0.0)?;
    let (t, h) = (plan.time(n - 1), plan.h);
    drive.set(&plan.values(t, 0.0))?;
    if drive.instance.step(t, h) <= Status::Warning {
        let what = "it takes a step that does not begin where the last one has ended";
        let at = format!("fmi2DoStep from t = {t} s by {h} s, the last step ended at {} s", plan.time(1));
        context.find(Finding::remark("step-elsewhere", what).at(at));
    }
    drive.instance.free();
    Ok(())
}
