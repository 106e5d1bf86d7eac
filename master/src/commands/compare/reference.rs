//! Rows of the paper's other methods.

use ttb_reference::{Method as Reference, ReferenceError, Stepped, Stepper, Whole};
use ttb_scenario::Checked;
use ttb_scenario::spec::TrainTrackSpec;
use ttb_session::TimeAxis;

use super::bench::Bench;
use super::rows::{Method, Planned};
use crate::clock::cpu;
use crate::error::Error;
use crate::results::ran::Ran;

/// What the rows share: the case, assembled once.
#[derive(Default)]
pub struct Prepared {
    whole: Option<Whole>,
    preparation: f64,
    /// Step at which the plain loosely coupled method stops converging, s.
    pub limit: Option<f64>,
}

impl Prepared {
    /// The case.
    pub fn whole(&mut self, checked: &Checked) -> Result<&Whole, Error> {
        if self.whole.is_none() {
            let begin = cpu();
            // These methods have one step for all.
            let spec = TrainTrackSpec { substeps: 1, ..checked.train_track.clone() };
            let whole = Whole::new(&spec, &checked.bridge).map_err(case)?;
            self.preparation = cpu() - begin;
            self.whole = Some(whole);
        }
        self.whole.as_ref().ok_or_else(|| Error::Input("the case could not be assembled".into()))
    }
}

fn case(error: ReferenceError) -> Error {
    Error::Input(error.to_string())
}

/// Trials of ω at the start of a relaxed run: steps each, and factors on the first guess.
const TRIED: usize = 30;
const FACTORS: [f64; 5] = [1.0, 1.15, 1.3, 1.5, 0.87];

/// Runs a row.
pub fn run(bench: &Bench, row: &Planned, prepared: &mut Prepared) -> Result<Ran, Error> {
    let tolerance = bench.checked.scenario.coupling.tolerance;
    let limit = prepared.limit;
    prepared.whole(bench.checked)?;
    let shared = prepared.preparation;
    let whole = prepared.whole(bench.checked)?;
    let begin = cpu();
    let mut notes = Vec::new();
    let method = match row.method {
        Method::Scm => Reference::Scm,
        Method::Schur => Reference::Schur,
        Method::Relaxed => {
            let (omega, iterations) = best_relaxation(whole, row.step, tolerance)?;
            notes.push(format!("ω = {omega:.2}, best of {} tried: {iterations:.1} iterations", FACTORS.len()));
            Reference::Lcm(omega)
        }
        _ => {
            notes.extend(limit.map(|h| format!("converges up to {:.3} ms: k_H (Y_w + Y_r) = 1 there", 1e3 * h)));
            Reference::Lcm(1.0)
        }
    };
    let stepper = Stepper::new(whole, method, row.step, tolerance).map_err(case)?;
    // A last step that the step does not divide is left out.
    let steps = (bench.checked.train_track.end / row.step + 1e-9).floor();
    let mut ran = Ran { method: row.name.clone(), step: row.step, steps: steps as u64, notes, ..Ran::default() };
    ran.preparation = shared + cpu() - begin;
    let points = bench.checked.bridge.points.iter().map(|point| point.name.clone()).collect();
    let mut stepped = Stepped::new(stepper, points);
    bench.step(&mut stepped, TimeAxis::new(row.step, steps * row.step), &mut ran)?;
    ran.factors = stepped.factors;
    Ok(ran)
}

/// ω with the fewest iterations over the first steps, and their number; the first guess is 2/(2 + μ + ρ) of the start.
fn best_relaxation(whole: &Whole, h: f64, tolerance: f64) -> Result<(f64, f64), Error> {
    let gains = Stepper::new(whole, Reference::Lcm(1.0), h, tolerance).and_then(|mut s| s.wheel_rail_gains(0.0));
    let [least, most] = gains.map_err(case)?.unwrap_or([0.0; 2]);
    let guess = 2.0 / (2.0 + least + most);
    let mut best = (guess, f64::INFINITY);
    for omega in FACTORS.map(|factor| (factor * guess).min(1.0)) {
        let mut stepper = Stepper::new(whole, Reference::Lcm(omega), h, tolerance).map_err(case)?;
        let mut iterations = 0;
        let converged = (0..TRIED).all(|_| stepper.step().map(|report| iterations += report.iterations).is_ok());
        let mean = iterations as f64 / TRIED as f64;
        if converged && mean < best.1 {
            best = (omega, mean);
        }
    }
    Ok(best)
}
