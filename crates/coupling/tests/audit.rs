//! A bridge that is not linear but returns to its states is never accused of not returning; one that comes back to another
//! state is found, also late in a run.

mod spatial;

use ttb_contract::{Failure, Ports, Subsystem};
use ttb_coupling::report::{Returned, Side as Which};
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

/// A side whose states come back wrong from some time on.
struct Late {
    side: spatial::Side,
    from: f64,
    now: f64,
    /// Added to its rates, or for the track to its forces, by `restore`, and by `save`.
    nudges: [f64; 2],
}

impl Late {
    fn nudge(&mut self, which: usize) {
        if self.now > self.from {
            self.side.nudge(self.nudges[which]);
        }
    }
}

impl Subsystem for Late {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        self.side.set_inputs(values, rates)
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        self.side.get_outputs(outputs)
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.side.exit_initialization()
    }
    fn step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), Failure> {
        self.now = t + h;
        self.side.step(t, h, may_restore)
    }
    fn save(&mut self) -> Result<(), Failure> {
        self.side.save()?;
        self.nudge(1);
        Ok(())
    }
    fn restore(&mut self) -> Result<(), Failure> {
        self.side.restore()?;
        self.nudge(0);
        Ok(())
    }
    fn can_interpolate(&self) -> bool {
        true
    }
    fn name(&self) -> &str {
        self.side.name()
    }
}

/// 300 steps of 1 ms with a deck that is nudged from 0.2 s on.
fn late(nudges: [f64; 2]) -> Result<Option<Returned>, IterationError> {
    let settings = Settings {
        method: Method::IqnIls,
        reuse: 2,
        predictor: Predictor::Linear,
        tolerance: 1e-9,
        max_iterations: 60,
        hold_forces: false,
        mean_forces: false,
        on_failure: OnFailure::Stop,
    };
    let [mut track, deck] = spatial::sides(1.0);
    let mut deck = Late { side: deck, from: 0.2, now: 0.0, nudges };
    let mut coupling = Coupling::new(spatial::ports(1.0), settings);
    coupling.initialise(&mut track, &mut deck, 0.0)?;
    for n in 0..300 {
        coupling.step(&mut track, &mut deck, f64::from(n) * 1e-3, 1e-3)?;
    }
    Ok(coupling.report().returned)
}

#[test]
fn a_state_that_comes_back_wrong_late_in_the_run_is_told_or_refused() {
    assert_eq!(late([0.0; 2]), Ok(None));
    // A tenth of an axle load changes rates by about 1e4 N · 1e-3 s / (2 · 6e3 kg) = 8e-4 m/s in a step.
    for (nudge, least) in [(1e-8, 1e-6), (1e-6, 1e-4)] {
        let found = late([nudge, 0.0]).expect("it goes on").unwrap_or_else(|| panic!("{nudge} was not seen"));
        assert!(found.side == Which::Bridge && found.t > 0.2 && found.t < 0.264, "{found:?}");
        assert!(found.difference > least && found.difference < 1e-2, "{found:?}");
    }
    let refused = late([1e-4, 0.0]);
    assert!(matches!(refused, Err(IterationError::NoReturn { t, side: Which::Bridge, .. }) if t > 0.2), "{refused:?}");
}

#[test]
fn a_side_that_is_disturbed_by_being_saved_but_comes_back_right_goes_on() {
    // Nobody steps from the disturbed state: every trial begins at a restored one. A large disturbance is told, because the
    // outputs cannot show which of the two is right.
    assert_eq!(late([0.0, 1e-8]), Ok(None));
    let told = late([0.0, 1e-4]).expect("it goes on").expect("told");
    assert!(told.difference > 1e-3, "{told:?}");
}
