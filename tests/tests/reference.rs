//! The paper's methods against each other: at equal step strongly coupled (both forms), loosely coupled and hybrid give
//! the same solution, and the loosely coupled one converges as far as theory says.

use ttb_record::Table as Record;
use ttb_reference::{Method, ReferenceError, Stepper, Whole};
use ttb_scenario::Checked;
use ttb_scenario::types::Method as Acceleration;
use ttb_tests::{example, library_run};

const COMMAND: &str = "-p ttb-tests --test reference";

/// First point's displacement and acceleration, first car's acceleration, third axle's force over time.
#[derive(Default)]
struct Ran {
    histories: [Vec<f64>; 4],
    iterations: usize,
    factors: usize,
}

const NAMES: [&str; 4] = ["displacement", "deck acceleration", "car acceleration", "contact force"];

fn prepared(checked: &Checked) -> Whole {
    Whole::new(&checked.train_track, &checked.bridge).unwrap_or_else(|e| panic!("{e}"))
}

fn try_run(whole: &Whole, method: Method, h: f64, end: f64, tolerance: f64) -> Result<Ran, ReferenceError> {
    let mut stepper = Stepper::new(whole, method, h, tolerance)?;
    let mut ran = Ran::default();
    let record = |stepper: &Stepper, ran: &mut Ran| {
        let ([u, _, a], state) = (stepper.point(0), stepper.state());
        let values = [u, a, state.cars.a[0], state.forces[2]];
        ran.histories.iter_mut().zip(values).for_each(|(history, x)| history.push(x));
    };
    record(&stepper, &mut ran);
    for _ in 0..(end / h).round() as usize {
        let report = stepper.step()?;
        ran.iterations += report.iterations;
        ran.factors += report.factors;
        record(&stepper, &mut ran);
    }
    Ok(ran)
}

/// Largest difference of two histories, relative to the largest value.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let scale = a.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / scale
}

/// Runs the case by every method at its own step and compares all with the hybrid algorithm.
fn all_methods_agree(mut checked: Checked, methods: &[Method], allowed: f64) {
    checked.scenario.coupling.tolerance = 1e-10;
    let table = library_run(&checked);
    let point = &checked.bridge.points[0].name;
    let names = [
        format!("point[{point}].displacement"),
        format!("point[{point}].acceleration"),
        "car[1].acceleration".into(),
        "wheel[3].contact_force".into(),
    ];
    let (whole, spec) = (prepared(&checked), &checked.train_track);
    for method in methods {
        let ran = try_run(&whole, *method, spec.step, spec.end, 1e-11).unwrap_or_else(|e| panic!("{method:?}: {e}"));
        for ((name, what), history) in names.iter().zip(NAMES).zip(&ran.histories) {
            let off = difference(table.column(name), history);
            println!("{method:?}, {what}: {off:.1e}");
            assert!(off < allowed, "{method:?}, {what}: differs from the hybrid run by {off:e}");
        }
    }
}

#[test]
fn every_method_gives_the_hybrid_solution_of_r1_at_equal_step() {
    let mut checked = example("r1.json");
    all_methods_agree(checked.clone(), &[Method::Scm, Method::Schur, Method::Lcm(0.45)], 1e-7);
    // Accelerations are differences of displacements over h²: rounding shows the more the shorter the step.
    (checked.train_track.step, checked.bridge.step) = (2e-4, 2e-4);
    all_methods_agree(checked, &[Method::Scm, Method::Schur, Method::Lcm(1.0)], 1e-6);
}

#[test]
fn also_of_eight_cars_on_ballast_over_the_cable_stayed_bridge() {
    let mut checked = example("default.json");
    // The leading cars are on the bridge from the beginning.
    let spec = &mut checked.train_track;
    (spec.front_wheel, spec.pre_roll, spec.end) = (300.0, 50.0, 0.3);
    all_methods_agree(checked, &[Method::Scm, Method::Schur, Method::Lcm(0.36)], 1e-6);
}

#[test]
fn the_independent_solver_agrees_with_the_quick_ones() {
    let mut checked = example("r1.json");
    checked.train_track.end = 0.4;
    let independent = ttb_reference::run(&checked.train_track, &checked.bridge).expect("monolithic run");
    let whole = prepared(&checked);
    for method in [Method::Scm, Method::Schur] {
        let ran = try_run(&whole, method, 1e-3, 0.4, 1e-11).unwrap_or_else(|e| panic!("{e}"));
        assert!(difference(&independent.points[0], &ran.histories[0]) < 1e-8);
        assert!(difference(&independent.wheels[2], &ran.histories[3]) < 1e-8);
    }
}

#[test]
fn one_factor_a_step_serves_the_strongly_coupled_method() {
    let checked = example("r1.json");
    let ran = try_run(&prepared(&checked), Method::Scm, 1e-3, 1.1, 1e-6).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(ran.factors, 1100);
    assert!(ran.iterations < 4 * 1100, "{}", ran.iterations);
}

/// The step at which k_H (Y_w + Y_r) = 1.
fn limit(whole: &Whole) -> f64 {
    let (mut low, mut high) = (1e-4, 1e-3);
    for _ in 0..30 {
        let h = 0.5 * (low + high);
        let gains = Stepper::new(whole, Method::Lcm(1.0), h, 1e-6).and_then(|mut s| s.wheel_rail_gains(0.0));
        let [_, most] = gains.expect("a step").expect("a constant factor");
        if most < 1.0 { low = h } else { high = h }
    }
    low
}

#[test]
fn the_loosely_coupled_method_converges_as_far_as_theory_says() {
    let source = "docs/theory.md, T67: k_H (Y_w + Y_r) = 1 at the static load; computed: R1 on a smooth rail run to 0.2 s, the \
                  longest step that converges, between 0.97 and 1.03 of it";
    let title = "methods of the paper: where the loosely coupled one stops converging, ms";
    let mut record = Record::new(title, source, COMMAND);
    for (wheels, expected) in [(1, 0.43e-3..0.5e-3), (2, 0.3e-3..0.37e-3)] {
        let mut checked = example("r1-smooth.json");
        checked.train_track.contact.wheels_per_axle = wheels;
        let whole = prepared(&checked);
        let limit = limit(&whole);
        println!("{wheels} contacts an axle: k_H (Y_w + Y_r) = 1 at h = {:.4} ms", 1e3 * limit);
        assert!(expected.contains(&limit), "{limit}");
        let below = try_run(&whole, Method::Lcm(1.0), 0.97 * limit, 0.2, 1e-6).unwrap_or_else(|e| panic!("{e}"));
        println!("  0.97 of it: {:.1} trials a step", below.iterations as f64 / below.histories[0].len() as f64);
        let above = try_run(&whole, Method::Lcm(1.0), 1.03 * limit, 0.2, 1e-6);
        assert!(matches!(&above, Err(ReferenceError::Step { what, .. }) if what.contains("wheels' forces")));
        // Between: by halves.
        let (mut low, mut high) = (0.97 * limit, 1.03 * limit);
        while high - low > 2e-3 * limit {
            let h = 0.5 * (low + high);
            if try_run(&whole, Method::Lcm(1.0), h, 0.2, 1e-6).is_ok() { low = h } else { high = h }
        }
        record.row(format!("R1, smooth, {wheels} contacts an axle"), 1e3 * limit, 1e3 * low, 0.03);
        // The relaxed method converges at longer steps.
        try_run(&whole, Method::Lcm(0.4), 1e-3, 0.2, 1e-6).unwrap_or_else(|e| panic!("{e}"));
    }
    record.finish();
}

#[test]
fn the_hybrid_algorithm_converges_from_a_tenth_to_four_milliseconds() {
    for h in [1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 4e-3] {
        let mut checked = example("r1.json");
        checked.scenario.coupling.method = Acceleration::FixedPoint;
        (checked.train_track.step, checked.bridge.step, checked.train_track.end) = (h, h, 0.8);
        let table = library_run(&checked);
        let mean = table.steps.iter().map(|step| step.iterations).sum::<usize>() as f64 / table.steps.len() as f64;
        println!("{h} s: {mean:.2} trials a step");
        assert!(mean < 5.0, "{h} s: {mean:.2}");
    }
}
