//! Light bridges: R1 on 1 t/m and on 0.5 t/m, its bending stiffness scaled alike, and bridges that cannot roll back.

use ttb_contract::{Failure, Signal, Subsystem};
use ttb_coupling::report::Source;
use ttb_coupling::{IterationError, Method, Report, Settings};
use ttb_scenario::Checked;
use ttb_session::{Case, RunError, Sides, Table};
use ttb_tests::{library_run, r1_with, run, sides};

/// A bridge as some FMUs are: without roll-back, without directional derivatives, without interpolation of inputs.
struct Limited<B> {
    bridge: B,
    checked: Checked,
    rolls_back: bool,
    derives: bool,
    interpolates: bool,
}

impl<B: Subsystem> Subsystem for Limited<B> {
    fn name(&self) -> &str {
        self.bridge.name()
    }
    fn record(&mut self, wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        self.bridge.record(wanted)
    }
    fn read(&mut self, row: &mut [f64]) -> Result<(), Failure> {
        self.bridge.read(row)
    }
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        assert!(rates.is_none() || self.interpolates);
        self.bridge.set_inputs(values, rates)
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        self.bridge.get_outputs(outputs)
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.bridge.exit_initialization()
    }
    fn step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), Failure> {
        assert!(!may_restore || self.rolls_back);
        self.bridge.step(t, h, may_restore)
    }
    fn save(&mut self) -> Result<(), Failure> {
        assert!(self.rolls_back, "nobody may try");
        self.bridge.save()
    }
    fn restore(&mut self) -> Result<(), Failure> {
        assert!(self.rolls_back, "nobody may try");
        self.bridge.restore()
    }
    fn can_interpolate(&self) -> bool {
        self.interpolates
    }
    fn can_roll_back(&self) -> bool {
        self.rolls_back
    }
    fn can_derive(&self) -> bool {
        self.derives
    }
    /// Derivatives are believed once a trial instance has given the same.
    fn trial_instance(&mut self, inputs: &[f64]) -> Result<Option<Box<dyn Subsystem>>, Failure> {
        if !self.derives {
            return Ok(None);
        }
        let mut another = sides(&self.checked).bridge;
        another.set_inputs(inputs, None)?;
        another.exit_initialization()?;
        Ok(Some(Box::new(another)))
    }
    fn derivative(&mut self, seed: &[f64], change: &mut [f64]) -> Result<(), Failure> {
        assert!(self.derives);
        self.bridge.derivative(seed, change)
    }
}

/// The report of a run, and the mid-span displacement over time.
struct Ran {
    mean: f64,
    most: usize,
    rescues: usize,
    report: Report,
    mid: Vec<f64>,
    /// Acceleration of the monitored point.
    acceleration: Vec<f64>,
}

/// Which of roll-back, derivatives, interpolation the bridge has.
type Abilities = [bool; 3];
const ALL: Abilities = [true; 3];

fn settings(checked: &Checked, method: Method) -> Settings {
    Settings { method, ..Case::of(checked).settings }
}

fn try_run(checked: &Checked, settings: Settings, abilities: Abilities) -> Result<Ran, RunError> {
    let [rolls_back, derives, interpolates] = abilities;
    let Sides { mut train_track, bridge, coupling, .. } = sides(checked);
    let mut bridge = Limited { bridge, checked: checked.clone(), rolls_back, derives, interpolates };
    let (case, mut table) = (Case { settings, ..Case::of(checked) }, Table::default());
    let (ended, report) = run(&case, coupling.ports().clone(), [&mut train_track, &mut bridge], &mut [&mut table]);
    ended?;
    let mean = table.steps.iter().map(|step| step.iterations).sum::<usize>() as f64 / table.steps.len() as f64;
    let most = table.steps.iter().map(|step| step.iterations).max().unwrap_or(0);
    let rescues = table.steps.iter().map(|step| step.rescues).sum();
    let middle = format!("support[{}].displacement", coupling.ports().forces() / 2 + 1);
    let mid = table.history(&middle).expect("a support").to_vec();
    let point = format!("point[{}].acceleration", checked.bridge.points[0].name);
    let acceleration = table.history(&point).expect("a point").to_vec();
    Ok(Ran { mean, most, rescues, report, mid, acceleration })
}

fn runs(checked: &Checked, method: Method, abilities: Abilities) -> Ran {
    try_run(checked, settings(checked, method), abilities).unwrap_or_else(|e| panic!("{e}"))
}

fn light_cases() -> impl Iterator<Item = (f64, f64)> {
    [1000.0, 500.0].into_iter().flat_map(|mass| [1e-3, 2e-3, 5e-3].map(|h| (mass, h)))
}

/// Largest difference relative to the largest value.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let scale = a.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / scale
}

#[test]
fn newton_lets_the_bridge_step_twice_whatever_its_mass_and_the_step() {
    for (mass, h) in light_cases() {
        let ran = runs(&r1_with(mass, h), Method::Newton, ALL);
        assert!(ran.mean <= 2.01 && ran.most <= 3, "{mass} kg/m, {h} s: {:.2}, at most {}", ran.mean, ran.most);
        assert_eq!((ran.report.model, ran.rescues), (Some(Source::Derivatives), 0));
    }
}

#[test]
fn newton_is_as_quick_without_derivatives_and_with_held_means() {
    for (mass, h) in [(1000.0, 5e-3), (500.0, 2e-3)] {
        for abilities in [[true, false, true], [true, true, false], [true, false, false]] {
            let ran = runs(&r1_with(mass, h), Method::Newton, abilities);
            assert!(ran.mean <= 2.01, "{mass} kg/m, {h} s, {abilities:?}: {:.2}", ran.mean);
            let source = if abilities[1] { Source::Derivatives } else { Source::Trials };
            assert_eq!(ran.report.model, Some(source), "{abilities:?}");
        }
    }
}

#[test]
fn auto_converges_on_every_light_bridge_in_less_than_three_trials_a_step() {
    for (mass, h) in light_cases() {
        for abilities in [ALL, [true, false, false]] {
            let ran = runs(&r1_with(mass, h), Method::Auto, abilities);
            assert!(ran.mean <= 3.0, "{mass} kg/m, {h} s, {abilities:?}: {:.2}", ran.mean);
            assert_eq!(ran.rescues, 0);
        }
    }
}

#[test]
fn quasi_newton_needs_fewer_trials_than_aitken_and_aitken_fewer_than_the_fixed_point() {
    // 0.5 t/m, 5 ms: 5.1, 6.1, 12.6.
    let checked = r1_with(500.0, 5e-3);
    let [quasi, aitken, fixed] =
        [Method::IqnIls, Method::Aitken, Method::FixedPoint].map(|method| runs(&checked, method, ALL).mean);
    assert!(quasi < 5.6 && quasi < 0.9 * aitken && aitken < 0.6 * fixed, "{quasi:.2} {aitken:.2} {fixed:.2}");
}

#[test]
fn auto_is_never_worse_than_aitken_on_r1() {
    for h in [1e-3, 2e-3, 5e-3] {
        let checked = r1_with(29_720.0, h);
        let (auto, aitken) = (runs(&checked, Method::Auto, ALL).mean, runs(&checked, Method::Aitken, ALL).mean);
        assert!(auto <= aitken, "{h} s: {auto:.2} {aitken:.2}");
    }
}

#[test]
fn the_answer_on_a_light_bridge_is_the_monolithic_one() {
    for (mass, h) in [(1000.0, 1e-3), (500.0, 2e-3), (500.0, 5e-3)] {
        let mut checked = r1_with(mass, h);
        checked.scenario.coupling.tolerance = 1e-10;
        let monolithic = ttb_reference::run(&checked.train_track, &checked.bridge).expect("monolithic run");
        for method in [ttb_scenario::types::Method::Newton, ttb_scenario::types::Method::Auto] {
            checked.scenario.coupling.method = method;
            let table = library_run(&checked);
            let point = table.column(&format!("point[{}].displacement", checked.bridge.points[0].name));
            let wheel = table.column("wheel[3].contact_force");
            let off = [difference(point, &monolithic.points[0]), difference(wheel, &monolithic.wheels[2])];
            assert!(off.iter().all(|d| *d < 1e-7), "{mass} kg/m, {h} s, {method:?}: {off:?}");
        }
    }
}

#[test]
fn without_roll_back_the_estimate_bounds_the_error() {
    for (mass, h) in [(29_720.0, 1e-3), (29_720.0, 5e-3), (5000.0, 1e-3), (5000.0, 5e-3), (1500.0, 1e-3)] {
        let checked = r1_with(mass, h);
        let truth = runs(&checked, Method::Auto, ALL);
        for abilities in [[false, true, true], [false, false, true], [false, false, false]] {
            let ran = runs(&checked, Method::Auto, abilities);
            let Some(residual) = ran.report.explicit else { panic!("no estimate") };
            let (work, off) = (ran.report.work.imbalance(), difference(&truth.mid, &ran.mid));
            println!("{mass} kg/m, {h} s, {abilities:?}: off {off:.1e}, estimate {residual:.1e}, work {work:.1e}");
            assert!(off <= residual, "{mass} kg/m, {h} s, {abilities:?}: {off:.1e}, estimate {residual:.1e}");
        }
    }
}

#[test]
fn without_roll_back_accelerations_have_an_estimate_of_their_own() {
    const FINER: usize = 4;
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, |most, x| most.max(x.abs()));
    for (mass, h) in [(29_720.0, 1e-3), (29_720.0, 5e-3), (5000.0, 1e-3), (5000.0, 2e-3), (1500.0, 1e-3)] {
        let checked = r1_with(mass, h);
        let fine = runs(&r1_with(mass, h / FINER as f64), Method::Auto, ALL);
        let (truth, ran) = (runs(&checked, Method::Auto, ALL), runs(&checked, Method::Auto, [false, true, true]));
        let estimate = ran.report.explicit_acceleration.expect("derivatives tell how far forces accelerate the deck");
        let pairs = |a: &Ran, b: &Ran, every: usize| {
            let of_b: Vec<f64> = b.acceleration.iter().step_by(every).copied().collect();
            largest(&mut a.acceleration.iter().zip(&of_b).map(|(a, b)| a - b))
        };
        let [of_coupling, of_step, both] =
            [(&ran, &truth, 1), (&truth, &fine, FINER), (&ran, &fine, FINER)].map(|(a, b, n)| pairs(a, b, n));
        let peak = largest(&mut fine.acceleration.iter().copied());
        let relative = ran.report.explicit.unwrap_or_default();
        println!(
            "{mass} kg/m, {h} s: peak {peak:.1e} m/s²; off by the coupling {of_coupling:.1e}, the step {of_step:.1e}, both \
             {both:.1e}; estimate {estimate:.1e}; of displacements {relative:.1e}, which would be {:.1e}",
            relative * peak
        );
        // In these cases 1.8 to 4 times the error.
        assert!(of_coupling <= estimate && estimate <= 10.0 * of_coupling, "{mass} kg/m, {h} s");
        assert!(both <= estimate + of_step, "{mass} kg/m, {h} s");
    }
}

#[test]
fn without_roll_back_the_limit_of_the_contraction_leaves_a_margin() {
    // ρ = 0.105, 0.164, 0.108 at the start; with derivatives these are refused.
    for (mass, h) in [(500.0, 1e-3), (500.0, 2e-3), (1000.0, 5e-3)] {
        let checked = r1_with(mass, h);
        let truth = runs(&checked, Method::Auto, ALL);
        assert!(truth.report.contraction.is_some_and(|rho| rho > ttb_coupling::report::STABLE));
        let ran = runs(&checked, Method::Auto, [false, false, true]);
        let (off, estimate) = (difference(&truth.mid, &ran.mid), ran.report.explicit.unwrap_or_default());
        println!("{mass} kg/m, {h} s: off {off:.1e}, estimate {estimate:.1e}");
        assert!(off <= estimate, "{mass} kg/m, {h} s: {off:.1e}, {estimate:.1e}");
    }
}

#[test]
fn without_roll_back_a_bridge_that_would_blow_up_is_refused() {
    let checked = r1_with(300.0, 5e-3);
    let auto = settings(&checked, Method::Auto);
    let Err(error) = try_run(&checked, auto, [false, true, true]) else { panic!("it ran") };
    assert!(matches!(error, RunError::Iteration(IterationError::Unstable { t: 0.0, residual: 0.0, .. })), "{error}");
    let very_light = r1_with(30.0, 5e-3);
    let Err(error) = try_run(&very_light, auto, [false, false, true]) else { panic!("it ran") };
    assert!(matches!(error, RunError::Iteration(IterationError::Unstable { rho: None, .. })), "{error}");
    println!("{error}");
}
