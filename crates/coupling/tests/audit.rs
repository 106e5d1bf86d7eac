//! A bridge that is not linear but returns to its states is never accused of not returning.

use ttb_contract::{Failure, Ports, Subsystem};
use ttb_coupling::{Coupling, IterationError, Method, OnFailure, Predictor, Settings};

/// Bridge: d = 2x (1 + b x), x the force in kN; train and track: 100 (1 + sin 9t) − d/4, in kN.
struct Side {
    bend: Option<f64>,
    time: f64,
    input: f64,
    output: f64,
    saved: (f64, f64),
    /// Restoring leaves this much of the output.
    keeps: f64,
}

fn side(bend: Option<f64>) -> Side {
    Side { bend, time: 0.0, input: 0.0, output: 0.0, saved: (0.0, 0.0), keeps: 0.0 }
}

impl Side {
    fn answer(&mut self, input: f64) {
        let new = match self.bend {
            Some(b) => 2.0 * input * (1.0 + b * input),
            None => 100.0 * (1.0 + (9.0 * self.time).sin()) - 0.25 * input,
        };
        self.output = new + self.keeps * self.output;
    }
}

impl Subsystem for Side {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        self.input = values[0] + rates.map_or(0.0, |rates| 1e-2 * rates[0]);
        if self.time == 0.0 {
            self.answer(values[0]);
        }
        Ok(())
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        outputs.fill(0.0);
        outputs[0] = self.output;
        Ok(())
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        Ok(())
    }
    fn step(&mut self, t: f64, h: f64, _may_restore: bool) -> Result<(), Failure> {
        self.time = t + h;
        self.answer(self.input);
        Ok(())
    }
    fn save(&mut self) -> Result<(), Failure> {
        self.saved = (self.time, self.output);
        Ok(())
    }
    fn restore(&mut self) -> Result<(), Failure> {
        self.time = self.saved.0;
        if self.keeps == 0.0 {
            self.output = self.saved.1;
        }
        Ok(())
    }
    fn can_interpolate(&self) -> bool {
        true
    }
    fn name(&self) -> &str {
        "side"
    }
}

fn run(method: Method, bend: f64, keeps: f64) -> Result<(), IterationError> {
    let settings = Settings {
        method,
        reuse: 2,
        predictor: Predictor::Linear,
        tolerance: 1e-6,
        max_iterations: 60,
        hold_forces: false,
        mean_forces: false,
        on_failure: OnFailure::Stop,
    };
    let (mut train_track, mut bridge) = (side(None), side(Some(bend)));
    let mut coupling = Coupling::new(Ports::vertical(1, 100.0), settings);
    coupling.initialise(&mut train_track, &mut bridge, 0.0)?;
    bridge.keeps = keeps;
    (0..64).try_for_each(|n| {
        coupling.step(&mut train_track, &mut bridge, f64::from(n) * 1e-2, 1e-2)?;
        Ok(())
    })
}

const METHODS: [Method; 5] = [Method::FixedPoint, Method::Aitken, Method::IqnIls, Method::Newton, Method::Auto];

#[test]
fn a_bridge_that_bends_a_little_passes_by_every_method() {
    for method in METHODS {
        for bend in [0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5] {
            run(method, bend, 0.0).unwrap_or_else(|e| panic!("{method:?}, b = {bend}: {e}"));
        }
    }
}

#[test]
fn one_that_keeps_something_of_the_trial_before_does_not() {
    for method in METHODS {
        let ended = run(method, 1e-7, 1e-4);
        assert!(matches!(ended, Err(IterationError::NoReturn { .. })), "{method:?}: {ended:?}");
    }
}
