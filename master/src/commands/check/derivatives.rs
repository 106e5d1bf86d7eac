//! Directional derivatives against differences of rolled-back steps.
//!
//! What a derivative at a communication point means for co-simulation the standard leaves open. Accepted are, for each
//! output y and input u by itself: Δy/Δu of the step just done with u held, the same with u interpolated (its derivative set
//! to 0), and Δy/Δu without a step (direct feed-through).

use std::collections::HashMap;

use ttb_fmi2::types::Status;

use super::context::Context;
use super::drive::{Drive, open, reference};
use super::finding::Finding;
use super::plan::Plan;

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
    reference(&probe, &plan, BEFORE + 1)?;
    let mut drive = Drive::fresh(&probe, &plan)?;
    drive.steps(0..BEFORE, 0.0)?;
    let state = drive.save(None)?;
    let n = plan.input_count();
    let stride = n.div_ceil(INPUTS).max(1);
    for i in (0..n).step_by(stride) {
        let mut closest: Vec<(f64, String)> = Vec::new();
        for way in &ways {
            let errors = compare(&mut drive, &plan, &state, i, *way)?;
            if closest.is_empty() {
                closest = errors;
                continue;
            }
            for (best, other) in closest.iter_mut().zip(errors) {
                if best.0.is_nan() || other.0 < best.0 {
                    *best = other;
                }
            }
        }
        let off = closest
            .into_iter()
            .enumerate()
            .filter(|(i, (error, _))| !plan.is_random(*i) && (*error > TOLERANCE || error.is_nan()));
        if let Some((_, words)) = off.map(|(_, found)| found).max_by(|a, b| a.0.total_cmp(&b.0)) {
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

/// Error of every output's derivative with respect to one input, relative to the largest derivative of the output's
/// neighbours, and both in words.
fn compare(
    drive: &mut Drive,
    plan: &Plan,
    state: &ttb_fmi2::probe::State,
    input: usize,
    way: Way,
) -> Result<Vec<(f64, String)>, Finding> {
    let Some((reference, amplitude)) = plan.input(input) else { return Ok(Vec::new()) };
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
    let scales = series_scales(plan, &seen);
    let error = |i: usize| {
        // What the difference of two rounded outputs cannot tell.
        let noise = 1e-13 * up[i].abs().max(down[i].abs()) / shift.abs();
        let scale = scales[i].max(noise / TOLERANCE);
        let error = if given[i] == seen[i] { 0.0 } else { (given[i] - seen[i]).abs() / scale };
        (error, format!("d {}/d input #{reference} is {:e}, by differences {:e}", plan.name(i), given[i], seen[i]))
    };
    Ok((0..given.len()).map(error).collect())
}

/// Of every output the largest difference quotient among those of its series, `x[1]`, `x[2]` …: far from the input the numbers
/// are small and their errors are not.
fn series_scales(plan: &Plan, seen: &[f64]) -> Vec<f64> {
    let stem = |i: usize| plan.name(i).chars().filter(|c| !c.is_ascii_digit()).collect::<String>();
    let stems: Vec<String> = (0..seen.len()).map(stem).collect();
    let mut largest: HashMap<&str, f64> = HashMap::new();
    for (stem, seen) in stems.iter().zip(seen) {
        let largest = largest.entry(stem).or_default();
        *largest = largest.max(seen.abs());
    }
    stems.iter().map(|stem| largest[stem.as_str()]).collect()
}
