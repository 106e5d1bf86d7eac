//! Steps of a bridge that cannot roll back, against the monolithic solution.

mod spatial;

use spatial::{N, monolithic, ports, sides};
use ttb_contract::{Failure, Subsystem};
use ttb_coupling::report::STABLE;
use ttb_coupling::{Coupling, IterationError, Method, OnFailure, Outcome, Predictor, Settings};

const END: f64 = 0.4;

/// A deck that is stepped once.
struct Once {
    deck: spatial::Side,
    /// Whether there may be others for trial steps.
    several: bool,
    /// What it derives, if it does.
    derives: Option<Derives>,
    steps: usize,
}

/// Derivatives that are not those of a step.
#[derive(Clone, Copy, Debug)]
enum Derives {
    /// Those of the instant: displacements and velocities are states, forces do not change them at once.
    Instant,
    /// A hundred times too large.
    TooLarge,
    /// Promised and refused; who asks a bridge for them cannot go on with it.
    Refused,
}

impl Subsystem for Once {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        self.deck.set_inputs(values, rates)
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        self.deck.get_outputs(outputs)
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.deck.exit_initialization()
    }
    fn step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), Failure> {
        assert!(!may_restore);
        self.steps += 1;
        self.deck.step(t, h, may_restore)
    }
    fn save(&mut self) -> Result<(), Failure> {
        panic!("it cannot be saved")
    }
    fn restore(&mut self) -> Result<(), Failure> {
        panic!("it cannot be restored")
    }
    fn can_interpolate(&self) -> bool {
        true
    }
    fn can_roll_back(&self) -> bool {
        false
    }
    fn trial_instance(&mut self, inputs: &[f64]) -> Result<Option<Box<dyn Subsystem>>, Failure> {
        if !self.several {
            return Ok(None);
        }
        let [_, mut deck] = sides(1.0);
        deck.set_inputs(inputs, None)?;
        deck.exit_initialization()?;
        Ok(Some(Box::new(Once { deck, several: false, derives: self.derives, steps: 0 })))
    }
    fn can_derive(&self) -> bool {
        self.derives.is_some()
    }
    fn derivative(&mut self, seed: &[f64], change: &mut [f64]) -> Result<(), Failure> {
        match self.derives {
            Some(Derives::Instant) => change.fill(0.0),
            Some(Derives::TooLarge) => change.iter_mut().zip(seed.iter().cycle()).for_each(|(c, s)| *c = 1e-4 * s),
            _ => {
                assert!(!self.several, "the bridge itself was asked");
                return Err(Failure::new("once", "no derivatives"));
            }
        }
        Ok(())
    }
    fn name(&self) -> &str {
        "once"
    }
}

fn settings() -> Settings {
    Settings {
        method: Method::Auto,
        reuse: 2,
        predictor: Predictor::Linear,
        tolerance: 1e-12,
        max_iterations: 60,
        hold_forces: false,
        mean_forces: false,
        on_failure: OnFailure::Stop,
    }
}

/// Greatest error of displacements at the end, relative; ρ at the start; the error estimate.
fn run(h: f64, several: bool) -> Result<(f64, Option<f64>, f64), IterationError> {
    run_deriving(h, several, None)
}

fn run_deriving(h: f64, several: bool, derives: Option<Derives>) -> Result<(f64, Option<f64>, f64), IterationError> {
    let [mut track, deck] = sides(1.0);
    let mut deck = Once { deck, several, derives, steps: 0 };
    let mut coupling = Coupling::new(ports(1.0), settings());
    coupling.initialise(&mut track, &mut deck, 0.0)?;
    let steps = (END / h).round() as usize;
    for n in 0..steps {
        let info = coupling.step(&mut track, &mut deck, n as f64 * h, h)?;
        assert_eq!((info.outcome, info.method, info.train_track_trials), (Outcome::Explicit, Method::Explicit, 2));
    }
    assert_eq!(deck.steps, steps);
    let [exact, _] = monolithic(steps, h);
    let [found, _] = deck.deck.motion();
    let largest = |x: &[f64]| x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let off: Vec<f64> = (0..N).map(|i| found[i] - exact[i]).collect();
    let report = coupling.report();
    Ok((largest(&off) / largest(&exact), report.contraction, report.explicit.expect("an estimate")))
}

#[test]
fn what_is_not_iterated_tends_to_the_iterated_solution_and_its_estimate_falls_with_the_error() {
    let errors = [2e-3, 1e-3, 5e-4].map(|h| run(h, true).expect("stable"));
    for (pair, h) in errors.windows(2).zip([2e-3, 1e-3]) {
        let order = (pair[0].0 / pair[1].0).log2();
        let estimates = (pair[0].2 / pair[1].2).log2();
        println!("from {h} s: error {:.2e}, order {order:.2}, of the estimate {estimates:.2}", pair[0].0);
        assert!(order > 1.8 && estimates > 1.8, "from {h} s: order {order}, of the estimate {estimates}");
    }
    for (error, rho, estimate) in errors {
        // Nothing is damped, so that errors of all steps add up: of 200 to 800 here.
        assert!(error < 10.0 * estimate && error < 3e-3, "error {error}, estimate {estimate}");
        assert!(rho.is_some_and(|rho| rho < STABLE), "{rho:?}");
    }
}

#[test]
fn a_strong_coupling_is_refused_before_the_first_step_where_it_can_be_known() {
    let refused = run(2e-2, true);
    let Err(IterationError::Unstable { t: 0.0, rho: Some(rho), residual: 0.0, .. }) = refused else {
        panic!("{refused:?}")
    };
    assert!(rho > STABLE);
    // The vertical ports are the strongest: ρ = (k h²/4 + c h/2)/(m + K h²/4), K about that of the deck.
    for h in [2e-3, 1e-3] {
        let exact = (4e7 * h * h / 4.0 + 4e4 * h / 2.0) / (6e3 + 3e8 * h * h / 4.0);
        let rho = run(h, true).expect("stable").1.expect("measured");
        assert!((rho / exact - 1.0).abs() < 0.05, "{rho} for {exact}");
    }
    assert!(run(2e-3, false).expect("stable").1.is_none(), "nobody can be asked");
}

#[test]
fn derivatives_that_are_not_those_of_a_step_change_neither_the_refusal_nor_the_run() {
    let Err(IterationError::Unstable { rho: Some(wanted), .. }) = run(2e-2, true) else { panic!("it ran") };
    let plain = run(1e-3, true).expect("stable");
    for derives in [Derives::Instant, Derives::TooLarge, Derives::Refused] {
        let refused = run_deriving(2e-2, true, Some(derives));
        let Err(IterationError::Unstable { t: 0.0, rho: Some(rho), residual: 0.0, .. }) = refused else {
            panic!("{derives:?}: {refused:?}")
        };
        assert_eq!((rho, run_deriving(1e-3, true, Some(derives)).expect("stable")), (wanted, plain), "{derives:?}");
    }
    // Where nothing can be tried, what they say is no reason to trust the scheme.
    assert_eq!(run_deriving(1e-3, false, Some(Derives::Instant)).expect("stable").1, None);
}
