//! Directional derivatives against differences of rolled-back steps.
//!
//! What a derivative at a communication point means for co-simulation the standard leaves open. Accepted are, for each
//! output y and input u: Δy/Δu of the step just done with u held, the same with u interpolated (its derivative set to 0),
//! and Δy/Δu without a step (direct feed-through).

use ttb_fmi2::types::Status;

use super::context::Context;
use super::drive::{Drive, Plan, open};
use super::finding::Finding;

/// Steps before the test.
const BEFORE: usize = 10;

/// Inputs tested at most.
const INPUTS: usize = 6;

/// Allowed error, relative to the largest derivative of the output kind.
const TOLERANCE: f64 = 1e-3;

/// How the trial step is made.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    Held,
    Interpolated,
    NoStep,
}

/// The check.
pub fn derivatives(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    let capabilities = &context.description.co_simulation;
    let testable = capabilities.provides_directional_derivative && capabilities.can_get_and_set_state;
    if !testable || !probe.has_derivatives() || !probe.has_states() || plan.steps(BEFORE + 1) <= BEFORE {
        return Ok(());
    }
    let mut ways = vec![Way::Held, Way::NoStep];
    if capabilities.can_interpolate_inputs {
        ways.push(Way::Interpolated);
    }
    let mut drive = Drive::fresh(&probe, &plan)?;
    drive.steps(0..BEFORE, 0.0)?;
    let state = drive.save(None)?;
    let n = plan.input_count();
    let stride = n.div_ceil(INPUTS).max(1);
    for i in (0..n).step_by(stride) {
        let mut closest: Option<(f64, String)> = None;
        for way in &ways {
            let (error, words) = compare(&mut drive, &plan, &state, i, *way)?;
            if closest.as_ref().is_none_or(|(e, _)| error < *e) {
                closest = Some((error, words));
            }
        }
        if let Some((error, words)) = closest
            && (error > TOLERANCE || error.is_nan())
        {
            let what = "directional derivatives are not those of the outputs";
            context
                .find(Finding::error("derivatives", what).at(format!("t = {} s", plan.time(BEFORE + 1))).seen(words));
            break;
        }
    }
    drive.instance.free_state(state);
    drive.instance.free();
    Ok(())
}

/// Largest error of the derivatives with respect to one input, relative to the largest derivative of the same output's
/// neighbours, and the worst pair in words.
fn compare(
    drive: &mut Drive,
    plan: &Plan,
    state: &ttb_fmi2::probe::State,
    input: usize,
    way: Way,
) -> Result<(f64, String), Finding> {
    let Some((reference, amplitude)) = plan.input(input) else { return Ok((0.0, String::new())) };
    let t = plan.time(BEFORE);
    let mut trial = |shift: f64| -> Result<Vec<f64>, Finding> {
        drive.restore(state)?;
        let mut values = plan.values(t, 0.0);
        values[input] += shift;
        drive.set(&values)?;
        if way == Way::Interpolated {
            let status = drive.instance.set_rates(plan.inputs(), &vec![0.0; values.len()]);
            drive.ok(status, "fmi2SetRealInputDerivatives")?;
        }
        if way != Way::NoStep {
            let status = drive.instance.step(t, plan.h);
            drive.ok(status, "fmi2DoStep")?;
        }
        drive.outputs()
    };
    let shift = 1e-2 * amplitude;
    let (up, down) = (trial(shift)?, trial(-shift)?);
    trial(0.0)?;
    let mut given = vec![0.0; plan.outputs.len()];
    let status: Status = drive.instance.derivatives(&plan.outputs, reference, &mut given);
    drive.ok(status, "fmi2GetDirectionalDerivative")?;
    let seen: Vec<f64> = up.iter().zip(&down).map(|(up, down)| (up - down) / (2.0 * shift)).collect();
    let mut worst = (0.0, String::new());
    for i in 0..given.len() {
        // What the difference of two rounded outputs cannot tell.
        let noise = 1e-13 * up[i].abs().max(down[i].abs()) / shift.abs();
        let scale = series_scale(plan, &seen, i).max(noise / TOLERANCE);
        let error = if given[i] == seen[i] { 0.0 } else { (given[i] - seen[i]).abs() / scale };
        if error > worst.0 || error.is_nan() {
            let words =
                format!("d {}/d input #{reference} is {:e}, by differences {:e}", plan.name(i), given[i], seen[i]);
            worst = (error, words);
        }
    }
    Ok(worst)
}

/// The largest difference quotient among outputs of the same series, `x[1]`, `x[2]` …: far from the input the numbers are
/// small and their errors are not.
fn series_scale(plan: &Plan, seen: &[f64], i: usize) -> f64 {
    let stem = |name: &str| name.chars().filter(|c| !c.is_ascii_digit()).collect::<String>();
    let own = stem(plan.name(i));
    (0..seen.len()).filter(|&k| stem(plan.name(k)) == own).map(|k| seen[k].abs()).fold(0.0, f64::max)
}
