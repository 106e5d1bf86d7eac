//! Rules inside the sections on train, track, irregularity and time.

use crate::limits::{GREATEST_SPEED, STEP, pre_roll_steps, steps};
use crate::pieces::Pieces;
use crate::problem::Report;
use crate::spec::TrainTrackSpec;
use crate::travel::speed_at;
use crate::types::{
    CarChoice, CouplingSettings, Csv, Decimal, Forces, Irregularity, Newmark, Rail, Sending, Separator, Speed, Time,
};
use crate::vehicle::{Equations, Fault};

/// Wheelsets stand in order inside their car.
pub(super) fn cars(cars: &[Option<CarChoice>], report: &mut Report) {
    for (i, choice) in cars.iter().enumerate() {
        let path = format!("$.train.cars[{i}]");
        if let Some(CarChoice::Vehicle(vehicle)) = choice {
            for Fault { path: inside, rule, found } in Equations::new(vehicle).err().into_iter().flatten() {
                report.problem(path.clone() + &inside, rule, found);
            }
        }
        let Some(CarChoice::Data(car)) = choice else { continue };
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

/// Cars or forces, and forces in order.
pub(super) fn train(pieces: &Pieces, report: &mut Report) {
    let rule = "a train has either cars or forces";
    match (pieces.has_cars, pieces.has_forces) {
        (true, true) => report.problem("$.train", rule, "both"),
        (false, false) if pieces.has_train => report.problem("$.train.cars", rule, "neither"),
        _ => {}
    }
    let Some(Forces::Axles(axles)) = &pieces.forces else { return };
    for (i, [x, load]) in axles.iter().enumerate() {
        let path = format!("$.train.forces[{i}]");
        let before = i.checked_sub(1).map(|before| axles[before][0]);
        if before.is_some_and(|before| *x <= before) || (i == 0 && *x != 0.0) {
            let rule = "axles must be listed from the first one, which is at 0, backwards";
            report.problem(format!("{path}[0]"), rule, format!("{x} m"));
        }
        if *load <= 0.0 {
            report.problem(format!("{path}[1]"), "the force of an axle must be greater than 0", format!("{load} N"));
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
        if !(0.0..=GREATEST_SPEED).contains(speed) {
            let rule = format!("speeds must lie between 0 and {GREATEST_SPEED} m/s");
            report.problem(format!("{path}[{i}][1]"), rule, speed);
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

/// `end` is the run's, given or chosen.
pub(super) fn time(time: &Time, end: Option<f64>, report: &mut Report) {
    let Some(step) = time.step.given() else { return };
    if let Some(end) = end.filter(|end| step > *end) {
        report.problem("$.time.step", "the step must not be longer than the run", format!("{step} > {end} s"));
    }
    // What is not above 0 has been reported.
    if let Some(end) = end.filter(|end| step > 0.0 && *end > 0.0) {
        let part = step / time.substeps.unwrap_or(1).max(1) as f64;
        if part < STEP[0] || step > STEP[1] {
            let rule = format!("steps and sub-steps must lie between {:e} and {} s", STEP[0], STEP[1]);
            report.problem("$.time.step", rule, format!("{part:e} s"));
        }
        if let Err(exceeded) = steps(end, step) {
            report.problem("$.time.step", exceeded.rule, exceeded.found);
        }
    }
    if let Some(error) = time.error {
        report.problem("$.time.error", "belongs to a step that is chosen: \"step\": \"auto\"", error);
    }
}

/// Columns can be told from decimals.
pub(super) fn csv(csv: &Csv, report: &mut Report) {
    if csv.decimal == Decimal::Comma && csv.separator == Separator::Comma {
        let rule = "a decimal comma needs another separator: \"semicolon\" or \"tab\"";
        report.problem("$.output.csv.separator", rule, "comma");
    }
}

/// How many steps a run and its pre-roll have whose step was chosen.
pub(crate) fn chosen_steps(spec: &TrainTrackSpec, report: &mut Report) {
    if let Err(exceeded) = steps(spec.end, spec.step) {
        report.problem("$.time.end", exceeded.rule, exceeded.found);
    }
    let distance = if spec.pre_roll > 0.0 { spec.pre_roll + spec.length() } else { 0.0 };
    if let Err(exceeded) = pre_roll_steps(distance, speed_at(&spec.speed, 0.0), spec.step / spec.substeps as f64) {
        report.problem("$.train.pre_roll", exceeded.rule, exceeded.found);
    }
}

/// Several sub-steps: the bridge gets held means, which are exact for the trapezoidal rule only.
pub(super) fn substeps(time: &Time, coupling: Option<&CouplingSettings>, report: &mut Report) {
    let chosen = time.step.given().is_none() && time.substeps.is_none();
    if !chosen && time.substeps.unwrap_or(1) == 1 {
        return;
    }
    let found = if chosen { "step auto chooses several; substeps 1 forbids it" } else { "several" };
    if time.newmark != Newmark::default() {
        let Newmark { gamma, beta } = time.newmark;
        let rule = "sub-steps need γ = 0.5, β = 0.25: the force on the bridge is a mean";
        report.problem("$.time.newmark", rule, format!("γ = {gamma}, β = {beta}; substeps: {found}"));
    }
    if coupling.is_some_and(|coupling| coupling.send == Sending::Rate) {
        let rule = "with sub-steps the force on the bridge is a mean and sent as such";
        report.problem("$.coupling.send", rule, format!("rate; substeps: {found}"));
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
