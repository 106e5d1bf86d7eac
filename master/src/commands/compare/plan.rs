//! Which rows the table has: the paper's, every method at its own step, or all methods at the steps asked for.

use ttb_reference::{Method as Reference, Stepper};

use super::bench::Bench;
use super::reference::Prepared;
use super::rows::{Method, Planned, sub_steps};
use crate::cli::Compare;
use crate::error::Error;

/// The plain loosely coupled method is tried at most this close to its limit: there it takes hundreds of iterations.
const MARGIN: f64 = 0.9;

/// All rows, in the order of the table.
pub fn plan(arguments: &Compare, bench: &Bench, prepared: &mut Prepared) -> Result<Vec<Planned>, Error> {
    let methods: Vec<Method> = arguments.methods.iter().map(|m| Method::from(*m)).collect();
    if !arguments.steps.is_empty() {
        let rows = arguments.steps.iter().flat_map(|h| methods.iter().map(|m| Planned::new(*m, *h)));
        return Ok(rows.collect());
    }
    let own = bench.checked.train_track.step;
    let mut rows: Vec<Planned> = Vec::new();
    let mut loose = None;
    if methods.contains(&Method::Lcm) {
        let limit = limit(bench, prepared)?;
        prepared.limit = Some(limit);
        // As in the paper: a whole part of the others' step.
        loose = Some(own / (own / (MARGIN * limit)).ceil().max(1.0));
    }
    for method in &methods {
        rows.push(Planned::new(*method, if *method == Method::Lcm { loose.unwrap_or(own) } else { own }));
    }
    if let Some(step) = loose.filter(|step| *step < own && methods.contains(&Method::Hybrid)) {
        rows.push(Planned::new(Method::Hybrid, step));
    }
    // What sub-steps are to be measured with: all in steps as short as theirs. The reference run may be that already.
    let short = own / sub_steps(bench.checked) as f64;
    let known = arguments.reference.fine(own).is_some_and(|fine| (fine / short - 1.0).abs() < 1e-9);
    if methods.contains(&Method::Multi) && methods.contains(&Method::Hybrid) && !known {
        rows.push(Planned::new(Method::Hybrid, short));
    }
    Ok(rows)
}

/// The step at which k_H (Y_w + Y_r), the greatest eigenvalue of D Y at the start, is 1: to 1 %.
fn limit(bench: &Bench, prepared: &mut Prepared) -> Result<f64, Error> {
    let own = bench.checked.train_track.step;
    let whole = prepared.whole(bench.checked)?;
    let gain = |h: f64| -> Result<f64, Error> {
        let gains = Stepper::new(whole, Reference::Lcm(1.0), h, 1e-6).and_then(|mut s| s.wheel_rail_gains(0.0));
        Ok(gains.map_err(|e| Error::Input(e.to_string()))?.map_or(0.0, |[_, most]| most))
    };
    let (mut low, mut high) = (0.0, own);
    if gain(own)? < 1.0 {
        return Ok(own);
    }
    // The gain grows about as h^1.5: secants in logarithms get there quickly, halves make it sure.
    let mut h = 0.4 * own;
    for _ in 0..20 {
        let g = gain(h)?;
        if g < 1.0 {
            low = h
        } else {
            high = h
        }
        if high - low <= 0.01 * high {
            break;
        }
        let next = h * g.powf(-1.0 / 1.5);
        let inside = next > low * 1.005 && next < high * 0.995;
        h = if inside { next } else { 0.5 * (low + high) };
        if low > 0.0 && high - low <= 0.03 * high {
            h = 0.5 * (low + high);
        }
    }
    Ok(low)
}
