//! Rules inside the sections on train, track, irregularity and time.

use crate::problem::Report;
use crate::types::{CarChoice, Irregularity, Newmark, Rail, Speed, Time};

/// More steps than any run has, and few enough to count exactly.
const MOST_STEPS: f64 = 1e9;

/// Wheelsets stand in order inside their car.
pub(super) fn cars(cars: &[Option<CarChoice>], report: &mut Report) {
    for (i, choice) in cars.iter().enumerate() {
        let Some(CarChoice::Data(car)) = choice else { continue };
        let path = format!("$.train.cars[{i}]");
        if car.wheelbase >= car.bogie_distance {
            let rule = "the wheelbase must be shorter than bogie_distance";
            report.problem(format!("{path}.wheelbase"), rule, format!("{} ≥ {} m", car.wheelbase, car.bogie_distance));
        }
        if car.bogie_distance + car.wheelbase > car.length {
            let rule = "the car must be at least as long as from its first to its last wheel";
            let wheels = car.bogie_distance + car.wheelbase;
            report.problem(format!("{path}.length"), rule, format!("{} < {wheels} m", car.length));
        }
    }
}

pub(super) fn speed(speed: &Speed, report: &mut Report) {
    let Speed::Profile(points) = speed else { return };
    let path = "$.train.speed.profile";
    for (i, pair) in points.windows(2).enumerate() {
        if pair[1][0] <= pair[0][0] {
            let found = format!("{} s after {} s", pair[1][0], pair[0][0]);
            report.problem(format!("{path}[{}][0]", i + 1), "times must increase", found);
        }
    }
    for (i, [_, speed]) in points.iter().enumerate() {
        if !(0.0..=300.0).contains(speed) {
            report.problem(format!("{path}[{i}][1]"), "speeds must lie between 0 and 300 m/s", speed);
        }
    }
}

pub(super) fn rail(rail: &Rail, report: &mut Report) {
    if rail.rotary_inertia > 0.0 && rail.shear_stiffness.is_none() {
        let rule = "rotary inertia needs a shear_stiffness (Timoshenko rail)";
        report.problem("$.track.type.rail.rotary_inertia", rule, rail.rotary_inertia);
    }
}

pub(super) fn irregularity(irregularity: &Irregularity, report: &mut Report) {
    let Irregularity::Spectrum { wavelengths: [short, long], .. } = irregularity else { return };
    if !(0.0 < *short && short < long) {
        let rule = "wavelengths must be [shortest, longest] with 0 < shortest < longest";
        report.problem("$.irregularity.wavelengths", rule, format!("[{short}, {long}]"));
    }
}

pub(super) fn time(time: &Time, report: &mut Report) {
    if time.step > time.end {
        report.problem(
            "$.time.step",
            "the step must not be longer than the run",
            format!("{} > {} s", time.step, time.end),
        );
    }
    if time.step > 0.0 && time.end / time.step > MOST_STEPS {
        let found = format!("{:e}", time.end / time.step);
        report.problem("$.time.step", "the run must have at most 1e9 steps", found);
    }
}

/// Below the limit of unconditional stability the stiffest element would have to set the step.
pub(super) fn newmark(newmark: &Newmark, report: &mut Report) {
    let limit = 0.5 * newmark.gamma;
    if newmark.beta < limit * (1.0 - 1e-12) {
        let rule = format!("β must be at least γ/2 = {limit} (unconditional stability)");
        report.problem("$.time.newmark.beta", rule, newmark.beta);
    }
}
