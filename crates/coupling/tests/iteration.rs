//! The iteration on two scalar subsystems with known answers.

use ttb_contract::{Component, Known, Port, Ports};
use ttb_contract::{Failure, Subsystem};
use ttb_coupling::report::Side;
use ttb_coupling::{Coupling, IterationError, Method, OnFailure, Outcome, Predictor, Settings};

/// Answers `constant(t) + gain · (input at the end of the step)`; counts what it was asked.
struct Line {
    gain: f64,
    constant: fn(f64) -> f64,
    interpolates: bool,
    input: f64,
    rate: f64,
    output: f64,
    saved: f64,
    roll_backs: usize,
    steps: Vec<(f64, f64)>,
    /// What it answers after initialization mode, if that is something else than in it.
    after: Option<f64>,
    /// Its gain grows with h².
    by_step: bool,
}

impl Line {
    fn new(gain: f64, constant: fn(f64) -> f64) -> Self {
        let (input, rate, output, saved) = (0.0, 0.0, 0.0, 0.0);
        Self {
            gain,
            constant,
            interpolates: true,
            input,
            rate,
            output,
            saved,
            roll_backs: 0,
            steps: Vec::new(),
            after: None,
            by_step: false,
        }
    }
}

impl Subsystem for Line {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        (self.input, self.rate) = (values[0], rates.map_or(0.0, |r| r[0]));
        if self.steps.is_empty() {
            self.output = (self.constant)(0.0) + self.gain * self.input;
        }
        Ok(())
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        outputs[0] = self.output;
        Ok(())
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.output = self.after.unwrap_or(self.output);
        Ok(())
    }
    fn step(&mut self, t: f64, h: f64, _may_restore: bool) -> Result<(), Failure> {
        self.steps.push((t, h));
        let gain = self.gain * if self.by_step { 10.0 * h * h } else { 1.0 };
        self.output = (self.constant)(t + h) + gain * (self.input + h * self.rate);
        Ok(())
    }
    fn save(&mut self) -> Result<(), Failure> {
        self.saved = self.output;
        Ok(())
    }
    fn restore(&mut self) -> Result<(), Failure> {
        self.roll_backs += 1;
        self.output = self.saved;
        Ok(())
    }
    fn name(&self) -> &str {
        "line"
    }
    fn can_interpolate(&self) -> bool {
        self.interpolates
    }
}

/// A force, 1 N at least, and a position.
fn one() -> Ports {
    let known = Known::Position;
    let port = Port { support: 1, component: Component::Vertical, scale: 1.0, known };
    Ports::new(vec![port], 0).expect("a port")
}

fn settings() -> Settings {
    Settings {
        method: Method::Aitken,
        reuse: 2,
        predictor: Predictor::Linear,
        tolerance: 1e-12,
        max_iterations: 30,
        hold_forces: false,
        mean_forces: false,
        on_failure: OnFailure::Stop,
    }
}

/// λ = load(t) − ρ λ, so λ = load/(1 + ρ).
fn pair(rho: f64) -> (Line, Line) {
    (Line::new(-rho, |t| 100.0 * (1.0 + t * t)), Line::new(1.0, |_| 0.0))
}

#[test]
fn every_step_ends_on_the_known_force() {
    let (mut train_track, mut bridge) = pair(0.4);
    let mut coupling = Coupling::new(one(), settings());
    coupling.initialise(&mut train_track, &mut bridge, 0.0).unwrap();
    assert!((coupling.forces()[0] - 100.0 / 1.4).abs() < 1e-9);
    for n in 0..20 {
        let t = f64::from(n) * 0.1;
        let info = coupling.step(&mut train_track, &mut bridge, t, 0.1).unwrap();
        let exact = 100.0 * (1.0 + (t + 0.1).powi(2)) / 1.4;
        assert_eq!(info.outcome, Outcome::Converged);
        assert!((coupling.forces()[0] / exact - 1.0).abs() < 1e-10, "{} {exact}", coupling.forces()[0]);
        assert_eq!(info.roll_backs, info.iterations - 1);
    }
    // One restored state more than trials repeated: also before the first trial of a step, and of ρ.
    assert_eq!(bridge.roll_backs, bridge.steps.len());
    assert_eq!(coupling.report().contraction.map(|rho| (rho * 1e6).round()), Some(4e5));
}

#[test]
fn a_subsystem_that_cannot_interpolate_gets_the_mean() {
    let (mut train_track, mut bridge) = pair(0.0);
    bridge.interpolates = false;
    let mut coupling = Coupling::new(one(), settings());
    coupling.initialise(&mut train_track, &mut bridge, 0.0).unwrap();
    coupling.step(&mut train_track, &mut bridge, 0.0, 1.0).unwrap();
    assert_eq!((bridge.input, bridge.rate), (150.0, 0.0));
}

#[test]
fn a_step_that_does_not_converge_follows_the_policy() {
    // Two trials do not suffice for the fixed point here.
    let run = |on_failure: OnFailure| {
        let (mut train_track, mut bridge) = pair(0.4);
        let mut coupling = Coupling::new(
            one(),
            Settings { method: Method::FixedPoint, tolerance: 1e-6, max_iterations: 2, on_failure, ..settings() },
        );
        coupling.initialise(&mut train_track, &mut bridge, 0.0).unwrap();
        let result = coupling.step(&mut train_track, &mut bridge, 0.0, 1.0);
        // Without the four trials of the first step that measure ρ, and the two that look at a restored state.
        (result, bridge.steps.split_off(6))
    };
    let (stopped, _) = run(OnFailure::Stop);
    assert!(matches!(stopped, Err(IterationError::NotConverged { t: 0.0, h: 1.0, .. })));
    let (accepted, steps) = run(OnFailure::Accept);
    assert_eq!(accepted.unwrap().outcome, Outcome::IterationLimit);
    assert_eq!(steps.len(), 2);
    // Halving does not help an iteration whose contraction does not depend on the step: it ends at a sixteenth.
    let (halved, steps) = run(OnFailure::Halve);
    assert!(matches!(halved, Err(IterationError::NotConverged { h: 0.0625, .. })));
    assert_eq!(steps.last(), Some(&(0.0, 0.0625)));
}

#[test]
fn one_pass_neither_saves_nor_restores_and_carries_the_answer_on() {
    let (mut train_track, mut bridge) = pair(0.01);
    let one_pass = Settings { max_iterations: 1, on_failure: OnFailure::Accept, ..settings() };
    let mut coupling = Coupling::new(one(), one_pass);
    coupling.initialise(&mut train_track, &mut bridge, 0.0).unwrap();
    for n in 0..100 {
        coupling.step(&mut train_track, &mut bridge, f64::from(n) * 0.01, 0.01).unwrap();
    }
    assert_eq!((train_track.roll_backs, bridge.roll_backs), (0, 0));
    let exact = 200.0 / 1.01;
    assert!((coupling.forces()[0] / exact - 1.0).abs() < 1e-3, "{} {exact}", coupling.forces()[0]);
    let mut stopping = Coupling::new(one(), Settings { on_failure: OnFailure::Stop, ..one_pass });
    let (mut train_track, mut bridge) = pair(0.01);
    stopping.initialise(&mut train_track, &mut bridge, 0.0).unwrap();
    let stopped = stopping.step(&mut train_track, &mut bridge, 0.0, 0.01);
    assert!(matches!(stopped, Err(IterationError::NotConverged { .. })));
}

#[test]
fn a_force_that_is_no_number_stops_the_run_at_its_step() {
    let (mut train_track, mut bridge) =
        (Line::new(0.0, |t| if t > 0.5 { f64::NAN } else { 1.0 }), Line::new(1.0, |_| 0.0));
    let mut coupling = Coupling::new(one(), settings());
    coupling.initialise(&mut train_track, &mut bridge, 0.0).unwrap();
    coupling.step(&mut train_track, &mut bridge, 0.0, 0.5).unwrap();
    let stopped = coupling.step(&mut train_track, &mut bridge, 0.5, 0.5);
    let Err(IterationError::NotFinite { t, side, output, value, .. }) = stopped else { panic!("{stopped:?}") };
    assert_eq!((t, side, output.as_str()), (1.0, Side::TrainTrack, "coupled output number 1"));
    assert!(value.is_nan());
}

#[test]
fn the_first_step_starts_from_what_both_sides_say_after_initialization_mode() {
    let (mut train_track, mut bridge) = pair(0.4);
    (train_track.after, bridge.after) = (Some(80.0), Some(7.0));
    bridge.interpolates = false;
    let mut coupling = Coupling::new(one(), settings());
    coupling.initialise(&mut train_track, &mut bridge, 0.0).unwrap();
    assert_eq!(coupling.forces(), [80.0]);
    coupling.step(&mut train_track, &mut bridge, 0.0, 1.0).unwrap();
    // The bridge got the mean of 80 and λ, and λ = 200 − 0.4 d, d = (80 + λ)/2.
    let lambda = (200.0 - 0.2 * 80.0) / 1.2;
    assert!((coupling.forces()[0] - lambda).abs() < 1e-9, "{:?}", coupling.forces());
    assert!((bridge.input - 0.5 * (80.0 + lambda)).abs() < 1e-9, "{}", bridge.input);
}

#[test]
fn a_residual_is_relative_to_the_answer_or_to_one_axle_load_whichever_is_greater() {
    let residual = |load: fn(f64) -> f64| {
        let (mut train_track, mut bridge) = (Line::new(0.0, load), Line::new(1.0, |_| 0.0));
        let one_pass = Settings { max_iterations: 1, on_failure: OnFailure::Accept, ..settings() };
        let mut coupling = Coupling::new(one(), one_pass);
        coupling.initialise(&mut train_track, &mut bridge, 0.0).unwrap();
        coupling.step(&mut train_track, &mut bridge, 0.0, 1.0).unwrap().residual
    };
    // From 100 to 200, of 200; from 0.1 to 0.3, of 1.
    assert!((residual(|t| 100.0 * (1.0 + t)) - 0.5).abs() < 1e-12);
    assert!((residual(|t| 0.1 + 0.2 * t) - 0.2).abs() < 1e-12);
}

#[test]
fn the_halves_of_a_step_follow_each_other() {
    // ρ = 3 h² as of a free mass: 3, 0.75, 0.1875 … with h = 1, 0.5, 0.25.
    let (mut train_track, mut bridge) = (Line::new(-0.3, |t| 100.0 * (1.0 + t)), Line::new(1.0, |_| 0.0));
    bridge.by_step = true;
    let halving = Settings {
        method: Method::FixedPoint,
        tolerance: 1e-9,
        max_iterations: 40,
        on_failure: OnFailure::Halve,
        ..settings()
    };
    let mut coupling = Coupling::new(one(), halving);
    coupling.initialise(&mut train_track, &mut bridge, 0.0).unwrap();
    let info = coupling.step(&mut train_track, &mut bridge, 0.0, 1.0).unwrap();
    assert_eq!((info.outcome, info.halvings), (Outcome::Converged, 3));
    let mut ends: Vec<f64> = bridge.steps.iter().map(|(t, h)| t + h).collect();
    ends.dedup();
    // All of it and its first half in vain, two quarters; its second half in vain, two quarters.
    assert_eq!(ends, [1.0, 0.5, 0.25, 0.5, 1.0, 0.75, 1.0]);
    assert!((train_track.steps.last().unwrap().0 - 0.75).abs() < 1e-15);
}

#[test]
fn the_work_that_is_counted_is_that_of_forces_and_displacements() {
    let run = |means: bool| {
        let (mut train_track, mut bridge) = (Line::new(0.0, |t| 100.0 * (1.0 + t)), Line::new(0.5, |_| 0.0));
        let mut coupling = Coupling::new(one(), Settings { mean_forces: means, ..settings() });
        coupling.initialise(&mut train_track, &mut bridge, 0.0).unwrap();
        coupling.step(&mut train_track, &mut bridge, 0.0, 1.0).unwrap().work.received
    };
    // d goes from 50 to 100 as the force from 100 to 200: 150 · 50 as end values, 200 · 50 if 200 is the mean.
    assert!((run(false) - 7500.0).abs() < 1e-6, "{}", run(false));
    assert!((run(true) - 1e4).abs() < 1e-6, "{}", run(true));
}
