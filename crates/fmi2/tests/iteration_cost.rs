//! What the iteration costs beside its subsystems at 1,000 couplings each way: no allocation in a step, by any method.

mod counting;

use counting::allocations;
use std::time::Instant;
use ttb_contract::{Failure, Ports, Subsystem};
use ttb_coupling::{Adapted, Coupling, Joined, Lacks, Method, OnFailure, Predictor, Settings, Shape, Stations};

/// Answers `constant + gain · (input at the end of the step)`, each output to the input of its number.
struct Line {
    gain: f64,
    load: f64,
    input: Vec<f64>,
    rate: Vec<f64>,
    time: f64,
    rolls_back: bool,
}

impl Line {
    fn new(inputs: usize, gain: f64, load: f64) -> Self {
        Self { gain, load, input: vec![0.0; inputs], rate: vec![0.0; inputs], time: 0.0, rolls_back: true }
    }
}

impl Subsystem for Line {
    fn name(&self) -> &str {
        "line"
    }
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        self.input.copy_from_slice(values);
        match rates {
            Some(rates) => self.rate.copy_from_slice(rates),
            None => self.rate.fill(0.0),
        }
        Ok(())
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        let n = self.input.len();
        for (i, out) in outputs.iter_mut().enumerate() {
            let end = self.input[i % n] + 1e-3 * self.rate[i % n];
            let load = self.load * (1.0 + (30.0 * self.time + i as f64).sin());
            *out = if i < n { load + self.gain * (1.0 + 0.3 * (i as f64).sin()) * end } else { 0.0 };
        }
        Ok(())
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        Ok(())
    }
    fn step(&mut self, t: f64, h: f64, _may_restore: bool) -> Result<(), Failure> {
        self.time = t + h;
        Ok(())
    }
    fn save(&mut self) -> Result<(), Failure> {
        Ok(())
    }
    fn restore(&mut self) -> Result<(), Failure> {
        Ok(())
    }
    fn can_interpolate(&self) -> bool {
        true
    }
    fn can_roll_back(&self) -> bool {
        self.rolls_back
    }
}

fn settings(method: Method) -> Settings {
    Settings {
        method,
        reuse: 2,
        predictor: Predictor::Linear,
        tolerance: 1e-6,
        max_iterations: 30,
        hold_forces: false,
        mean_forces: false,
        on_failure: OnFailure::Stop,
    }
}

/// 200 steps after the first ten, which measure ρ, identify, and make room for what is remembered: no allocation.
fn run(method: Method, n: usize, bridge: &mut dyn Subsystem, what: &str) {
    let mut train_track = Line::new(2 * n, -1.0, 100.0);
    let mut coupling = Coupling::new(Ports::vertical(n, 100.0), settings(method));
    coupling.initialise(&mut train_track, bridge, 0.0).expect("equilibrium");
    let mut trials = 0;
    let mut run = |from: u32, steps: u32| {
        for i in from..from + steps {
            let info = coupling.step(&mut train_track, bridge, f64::from(i) * 1e-3, 1e-3);
            trials += info.expect("a step").iterations;
        }
    };
    run(0, 10);
    let before = allocations();
    let begin = Instant::now();
    run(10, 200);
    let micro = 1e6 * begin.elapsed().as_secs_f64() / 200.0;
    assert_eq!(allocations() - before, 0, "{}, {what}", method.name());
    println!(
        "{}, {n} forces, {what}: {:.1} trials, {micro:.1} µs a step",
        method.name(),
        f64::from(trials as u32) / 210.0
    );
}

/// One test: allocations are counted for the whole program.
#[test]
fn no_method_and_no_adapter_allocates_in_a_step() {
    for (method, n) in [
        (Method::FixedPoint, 1000),
        (Method::Aitken, 1000),
        (Method::IqnIls, 1000),
        (Method::Newton, 200),
        (Method::Auto, 1000),
        (Method::Explicit, 1000),
    ] {
        let mut bridge = Line::new(n, 0.03, 0.0);
        bridge.rolls_back = method != Method::Explicit;
        run(method, n, &mut bridge, "one bridge");
    }
    let even = |count: usize| -> Vec<f64> { (0..count).map(|i| i as f64 / (count - 1) as f64).collect() };
    for rolls_back in [true, false] {
        let part = || {
            let stations = Stations::new(&even(400), &[], &even(500), Shape::Cubic).expect("stations");
            let mut line = Line::new(400, 0.01, 0.0);
            line.rolls_back = rolls_back;
            // These masses have no velocity to speak of: steps that are not iterated would follow its noise.
            let lacks = Lacks { points: 400, components: 1, stations: Some(stations), velocities: rolls_back };
            (Adapted::new(line, lacks, 1e-3), Ports::vertical(500, 100.0))
        };
        let method = if rolls_back { Method::IqnIls } else { Method::Explicit };
        run(
            method,
            1000,
            &mut Joined::new(vec![part(), part()]).expect("complete ports"),
            "two bridges of 400 stations without velocities",
        );
    }
}
