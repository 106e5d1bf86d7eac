//! Trial steps before the run, and audits in its course, on free masses with known answers.

use ttb_contract::{Failure, Ports, Subsystem};
use ttb_coupling::probe::response::Mismatch;
use ttb_coupling::probe::returns;
use ttb_coupling::report::Side;
use ttb_coupling::{Coupling, IterationError, Method, OnFailure, Predictor, Settings};

const N: usize = 4;
const MASS: f64 = 6e3;

/// N free masses by the trapezoidal rule; or, as the train–track side, springs from N wheels to the deck.
#[derive(Clone)]
struct Masses {
    deck: bool,
    /// What displacements and velocities are multiplied with.
    factors: [f64; 2],
    /// Restoring forgets the velocities from this time on, s.
    forgets_from: f64,
    rolls_back: bool,
    /// Every restored state makes the velocities it tells larger by this part.
    swells: f64,
    time: f64,
    input: Vec<f64>,
    rate: Vec<f64>,
    d: Vec<f64>,
    v: Vec<f64>,
    saved: Option<(f64, Vec<f64>, Vec<f64>)>,
}

fn masses(deck: bool) -> Masses {
    let inputs = if deck { N } else { 2 * N };
    Masses {
        deck,
        factors: [1.0; 2],
        forgets_from: f64::INFINITY,
        rolls_back: true,
        swells: 0.0,
        time: 0.0,
        input: vec![0.0; inputs],
        rate: vec![0.0; inputs],
        d: vec![0.0; N],
        v: vec![0.0; N],
        saved: None,
    }
}

impl Subsystem for Masses {
    fn name(&self) -> &str {
        "masses"
    }
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        self.input.copy_from_slice(values);
        self.rate.fill(0.0);
        if let Some(rates) = rates {
            self.rate.copy_from_slice(rates);
        }
        Ok(())
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        if self.deck {
            for i in 0..N {
                (outputs[i], outputs[N + i]) = (self.factors[0] * self.d[i], self.factors[1] * self.v[i]);
            }
        } else {
            outputs.copy_from_slice(&self.d);
        }
        Ok(())
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        Ok(())
    }
    fn step(&mut self, t: f64, h: f64, _may_restore: bool) -> Result<(), Failure> {
        self.time = t + h;
        for i in 0..N {
            if self.deck {
                let v = self.v[i] + h * (self.input[i] + 0.5 * h * self.rate[i]) / MASS;
                self.d[i] += 0.5 * h * (self.v[i] + v);
                self.v[i] = v;
            } else {
                let load = 1e4 * (30.0 * self.time + i as f64).sin();
                self.d[i] = load - 1e6 * (self.input[i] + h * self.rate[i]);
            }
        }
        Ok(())
    }
    fn save(&mut self) -> Result<(), Failure> {
        self.saved = Some((self.time, self.d.clone(), self.v.clone()));
        Ok(())
    }
    fn restore(&mut self) -> Result<(), Failure> {
        self.factors[1] *= 1.0 + self.swells;
        let Some((time, d, v)) = self.saved.clone() else { panic!("nothing saved") };
        if time < self.forgets_from {
            self.v = v;
        }
        (self.time, self.d) = (time, d);
        Ok(())
    }
    fn can_interpolate(&self) -> bool {
        true
    }
    fn can_roll_back(&self) -> bool {
        self.rolls_back
    }
    fn trial_instance(&mut self, inputs: &[f64]) -> Result<Option<Box<dyn Subsystem>>, Failure> {
        let mut another = masses(true);
        (another.factors, another.rolls_back) = (self.factors, false);
        another.set_inputs(inputs, None)?;
        Ok(Some(Box::new(another)))
    }
}

fn coupling() -> Coupling {
    let settings = Settings {
        method: Method::Auto,
        reuse: 2,
        predictor: Predictor::Linear,
        tolerance: 1e-9,
        max_iterations: 30,
        hold_forces: false,
        mean_forces: false,
        on_failure: OnFailure::Stop,
    };
    Coupling::new(Ports::vertical(N, 1e5), settings)
}

/// All of them on one deck.
const ONE: &[std::ops::Range<usize>] = std::slice::from_ref(&(0..N));

/// Begin and size of the first step, s, and steps to be tried.
const FIRST: [f64; 2] = [0.0, 1e-3];
const STEPS: usize = 100;

#[test]
fn the_mass_is_found_with_and_without_roll_back_and_nothing_is_moved() {
    for rolls_back in [true, false] {
        let (mut train_track, mut bridge, mut coupling) = (masses(false), masses(true), coupling());
        bridge.rolls_back = rolls_back;
        coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
        let before = (bridge.d.clone(), bridge.v.clone());
        let probe = coupling.probe(&mut train_track, &mut bridge, &[0..2, 2..4], FIRST, STEPS).expect("a probe");
        assert_eq!((probe.train_track, probe.bridge), (Some(0.0), if rolls_back { vec![0.0; 2] } else { Vec::new() }));
        assert_eq!(probe.responses.len(), 2);
        for response in &probe.responses {
            assert!(response.mass.iter().all(|m| (m / MASS - 1.0).abs() < 1e-9), "{response:?}");
            assert_eq!(response.mismatch(), None);
        }
        assert_eq!(before, (bridge.d, bridge.v));
    }
}

#[test]
fn every_deck_is_judged_by_itself() {
    let (mut train_track, mut bridge, mut coupling) = (masses(false), masses(true), coupling());
    bridge.factors = [-1.0, 1.0];
    coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
    let probe = coupling.probe(&mut train_track, &mut bridge, &[0..2, 2..4], FIRST, STEPS).expect("a probe");
    assert!(probe.responses.iter().all(|response| response.mismatch() == Some(Mismatch::Alone(0, -1.0))));
}

#[test]
fn a_run_of_a_single_step_is_probed_by_a_single_step() {
    let (mut train_track, mut bridge, mut coupling) = (masses(false), masses(true), coupling());
    coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
    let probe = coupling.probe(&mut train_track, &mut bridge, ONE, FIRST, 1).expect("a probe");
    assert!((probe.responses[0].mass[0] / MASS - 1.0).abs() < 1e-9);
}

#[test]
fn a_state_that_is_not_restored_is_found_before_the_run_or_in_its_course() {
    let go = |forgets_from: f64| {
        let (mut train_track, mut bridge, mut coupling) = (masses(false), masses(true), coupling());
        bridge.forgets_from = forgets_from;
        coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
        let probe = coupling.probe(&mut train_track, &mut bridge, ONE, FIRST, STEPS).expect("a probe");
        let mut step = |n: usize| coupling.step(&mut train_track, &mut bridge, n as f64 * FIRST[1], FIRST[1]);
        (probe, (0..STEPS).try_for_each(|n| step(n).map(|_| ())))
    };
    let (probe, ended) = go(f64::INFINITY);
    assert!(returns(probe.bridge[0]) && ended.is_ok());
    assert!(!returns(go(0.0).0.bridge[0]));
    let (probe, ended) = go(0.02);
    assert!(returns(probe.bridge[0]));
    let Err(IterationError::NoReturn { t, side, .. }) = ended else { panic!("{ended:?}") };
    assert_eq!((t, side), (0.02, Side::Bridge));
}

#[test]
fn velocities_alone_that_do_not_come_back_are_found_too() {
    let (mut train_track, mut bridge, mut coupling) = (masses(false), masses(true), coupling());
    bridge.swells = 1e-6;
    coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
    let probe = coupling.probe(&mut train_track, &mut bridge, &[0..2, 2..4], FIRST, STEPS).expect("a probe");
    assert!(probe.bridge.iter().all(|off| !returns(*off)), "{probe:?}");
}
