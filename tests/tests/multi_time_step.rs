//! Train and track in sub-steps of the bridge's step: R1 at 1 ms in ten sub-steps against 0.1 ms everywhere.

use std::process::Command;

use ttb_contract::{Failure, Signal, Subsystem};
use ttb_coupling::{OnFailure, Settings};
use ttb_scenario::Checked;
use ttb_scenario::step::Steps;
use ttb_scenario::types::{Method, RailPoint};
use ttb_session::{Case, Sides};
use ttb_tests::{Table, example, examples, library_run, r1_with, read_results, run, sides, ttb};

/// R1 with two monitored points of the rail.
fn r1(step: f64, substeps: usize) -> Checked {
    let mut checked = example("r1.json");
    checked.train_track.rail_points =
        [("mid", 55.25), ("quarter", 50.0)].map(|(name, x)| RailPoint { name: name.into(), x }).to_vec();
    checked.set_steps(Steps { step, substeps });
    checked
}

/// Largest difference at the rows of `coarse`, relative to the largest value; `fine` has `ratio` rows for each.
fn off(fine: &Table, coarse: &Table, name: &str, ratio: usize) -> f64 {
    let fine: Vec<f64> = fine.column(name).iter().copied().step_by(ratio).collect();
    let scale = fine.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
    let pairs = fine.iter().zip(coarse.column(name));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / scale
}

fn trials(table: &Table) -> f64 {
    table.steps.iter().map(|step| step.iterations as f64).sum::<f64>() / table.steps.len() as f64
}

#[test]
fn the_rail_accelerates_as_in_small_steps_though_the_bridge_takes_large_ones() {
    let (fine, multi, coarse) = (library_run(&r1(1e-4, 1)), library_run(&r1(1e-3, 10)), library_run(&r1(1e-3, 1)));
    for name in ["rail[mid].acceleration", "rail[quarter].acceleration"] {
        let errors = [off(&fine, &multi, name, 10), off(&fine, &coarse, name, 10)];
        println!("{name}: sub-steps {:.1e}, none {:.1e}", errors[0], errors[1]);
        assert!(errors[0] < 0.01 && errors[1] > 1.0, "{name}: {errors:?}");
        // The peak between the ends of macro steps is not missed.
        let peak = name.replace(".acc", ".peak_acc");
        let most = |table: &Table| table.column(&peak).iter().fold(0.0_f64, |most, a| most.max(a.abs()));
        assert!((most(&multi) / most(&fine) - 1.0).abs() < 0.01, "{peak}: {} {}", most(&multi), most(&fine));
    }
    for (name, most) in
        [("wheel[2].contact_force", 1e-3), ("car[1].acceleration", 1e-3), ("point[mid].displacement", 1e-3)]
    {
        assert!(off(&fine, &multi, name, 10) < most, "{name}");
    }
    // Sub-steps do not raise the number of steps of the bridge.
    assert!(trials(&multi) < trials(&coarse) + 0.1, "{} {}", trials(&multi), trials(&coarse));
}

#[test]
fn no_work_is_made_or_lost_at_the_interface() {
    for (mass, method) in [(29_720.0, Method::IqnIls), (29_720.0, Method::Newton), (1000.0, Method::Auto)] {
        let mut checked = r1_with(mass, 1e-3);
        checked.set_steps(Steps { step: 1e-3, substeps: 10 });
        checked.scenario.coupling.method = method;
        let work = library_run(&checked).work;
        println!("{mass} kg/m, {method:?}: {:.1e}, exchange {:.1e}", work.imbalance(), work.exchange_imbalance());
        // The imbalance that the iteration leaves is below its tolerance; the exchange itself makes none.
        assert!(work.exchange_imbalance() < 1e-12 && work.imbalance() < 1e-6, "{work:?}");
        assert!(work.received > 0.0, "{work:?}");
        checked.scenario.coupling.tolerance = 1e-12;
        let work = library_run(&checked).work;
        println!("{mass} kg/m, {method:?}, tolerance 1e-12: {:.1e}", work.imbalance());
        assert!(work.imbalance() < 1e-12, "{work:?}");
    }
}

/// A foreign bridge: an undamped mass on a spring under all supports, integrated exactly under held forces, the only inputs
/// that it supports.
struct Oscillator {
    mass: f64,
    omega: f64,
    force: f64,
    supports: usize,
    motion: [f64; 2],
    saved: [f64; 2],
    stepping: bool,
}

impl Oscillator {
    /// m (v² + ω² d²)/2, J.
    fn energy(&self, [d, v]: [f64; 2]) -> f64 {
        0.5 * self.mass * (v * v + self.omega * self.omega * d * d)
    }
}

impl Subsystem for Oscillator {
    fn name(&self) -> &str {
        "oscillator"
    }
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        assert!(rates.is_none());
        self.force = values.iter().sum();
        if !self.stepping {
            self.motion = [self.force / (self.mass * self.omega * self.omega), 0.0];
        }
        Ok(())
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        let (d, v) = outputs.split_at_mut(self.supports);
        d.fill(self.motion[0]);
        v.fill(self.motion[1]);
        Ok(())
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.stepping = true;
        Ok(())
    }
    fn step(&mut self, _t: f64, h: f64, _may_restore: bool) -> Result<(), Failure> {
        let (rest, w) = (self.force / (self.mass * self.omega * self.omega), self.omega);
        let (a, b) = (self.motion[0] - rest, self.motion[1] / w);
        let (sin, cos) = (w * h).sin_cos();
        self.motion = [rest + a * cos + b * sin, w * (b * cos - a * sin)];
        Ok(())
    }
    fn save(&mut self) -> Result<(), Failure> {
        self.saved = self.motion;
        Ok(())
    }
    fn restore(&mut self) -> Result<(), Failure> {
        self.motion = self.saved;
        Ok(())
    }
    fn can_interpolate(&self) -> bool {
        false
    }
    fn record(&mut self, wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        let signals = ["d", "v"].map(|name| Signal { name: name.into(), unit: String::new() });
        assert!(signals.iter().all(wanted));
        signals.to_vec()
    }
    fn read(&mut self, row: &mut [f64]) -> Result<(), Failure> {
        row.copy_from_slice(&self.motion);
        Ok(())
    }
}

#[test]
fn the_work_that_is_counted_is_the_energy_that_a_foreign_bridge_gains() {
    let checked = r1(1e-3, 10);
    let Sides { mut train_track, coupling, .. } = sides(&checked);
    let (mass, omega, ports) = (5e5, 30.0, coupling.ports());
    let (motion, saved) = ([0.0; 2], [0.0; 2]);
    let mut bridge = Oscillator { mass, omega, force: 0.0, supports: ports.forces(), motion, saved, stepping: false };
    let case = Case::of(&checked);
    let case = Case { settings: Settings { tolerance: 1e-12, ..case.settings }, end: 1.0, ..case };
    let mut table = ttb_session::Table::default();
    let (ended, report) = run(&case, ports.clone(), [&mut train_track, &mut bridge], &mut [&mut table]);
    ended.expect("run");
    let [d, v] = ["d", "v"].map(|name| table.history(name).expect("recorded"));
    let energy: Vec<f64> = d.iter().zip(v).map(|(d, v)| bridge.energy([*d, *v])).collect();
    let most = energy.iter().copied().fold(0.0, f64::max);
    let (gained, work) = (energy[energy.len() - 1] - energy[0], report.work);
    println!("gained {gained} J, counted {} J, on the way {most} J; {work:?}", work.received);
    assert!((gained - work.received).abs() < 1e-12 * work.turnover && most > 1.0, "{gained} {work:?}");
    assert!(work.imbalance() < 1e-12, "{work:?}");
}

#[test]
fn sub_steps_keep_second_order_in_the_macro_step() {
    let [coarse, middle, fine] = [2e-3, 1e-3, 5e-4].map(|h| {
        let mut checked = r1(h, 5);
        checked.scenario.coupling.tolerance = 1e-9;
        library_run(&checked)
    });
    for name in ["point[mid].displacement", "point[mid].velocity", "car[1].acceleration", "wheel[1].displacement"] {
        let order = (off(&middle, &coarse, name, 2) / off(&fine, &middle, name, 2)).log2();
        println!("{name}: order {order:.3}");
        assert!((1.8..2.2).contains(&order), "{name}: order {order}");
    }
}

#[test]
fn the_run_through_the_fmus_is_the_library_run_bit_for_bit() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let text = std::fs::read_to_string(examples().join("r1.json")).expect("R1");
    let text = text.replace("\"step\": 1e-3", "\"step\": 1e-3, \"substeps\": 7");
    let file = folder.path().join("scenario.json");
    std::fs::write(&file, text).expect("written");
    let ran = |arguments: &[&std::ffi::OsStr]| {
        let status = Command::new(ttb()).args(arguments).arg("--quiet").stderr(std::process::Stdio::null()).status();
        assert!(status.expect("ttb runs").success());
        read_results(folder.path())
    };
    let out = [file.as_os_str(), "--output".as_ref(), folder.path().as_os_str()];
    let through_fmus = ran(&["run".as_ref(), out[0], out[1], out[2]]);
    let system = folder.path().join("s.ssp");
    let export = Command::new(ttb()).args(["export-ssp".as_ref(), out[0], "-o".as_ref(), system.as_os_str()]).output();
    assert!(export.expect("ttb runs").status.success());
    let through_system = ran(&["run".as_ref(), system.as_os_str(), out[1], out[2]]);
    let table = library_run(&ttb_scenario::load(&file).expect("no problems"));
    assert!(table.columns.iter().any(|(name, _)| name == "support[3].mean_force"));
    for results in [through_fmus, through_system] {
        assert!(results.len() > 20);
        for (name, values) in results.iter().filter(|(name, _)| name != "time") {
            assert!(table.column(name).iter().map(|x| x.to_bits()).eq(values.iter().map(|x| x.to_bits())), "{name}");
        }
    }
}

#[test]
fn newton_halved_steps_and_reduced_bridges_work_with_sub_steps_too() {
    // Newton on a light bridge: two steps of the bridge a macro step.
    let mut light = r1_with(500.0, 2e-3);
    light.set_steps(Steps { step: 2e-3, substeps: 8 });
    let auto = library_run(&light);
    light.scenario.coupling.method = Method::Newton;
    let newton = library_run(&light);
    assert!(trials(&newton) <= 2.01 && trials(&newton) < trials(&auto), "{} {}", trials(&newton), trials(&auto));
    assert!(off(&auto, &newton, "point[mid].displacement", 1) < 1e-5);
    // Modes instead of degrees of freedom: many give the same.
    let (mut few, all) = (r1(1e-3, 10), library_run(&r1(1e-3, 10)));
    few.bridge.modes = Some(40);
    assert!(off(&all, &library_run(&few), "point[mid].displacement", 1) < 1e-3);
    // Two trials do not suffice: the step is halved, and sub-steps with it.
    let checked = r1_with(500.0, 5e-3);
    let mut checked = Checked { scenario: checked.scenario.clone(), ..checked };
    checked.set_steps(Steps { step: 5e-3, substeps: 10 });
    let Sides { mut train_track, mut bridge, coupling, .. } = sides(&checked);
    let case = Case::of(&checked);
    let few = Settings { max_iterations: 4, on_failure: OnFailure::Halve, ..case.settings };
    let (case, mut table) = (Case { settings: few, end: 0.4, ..case }, ttb_session::Table::default());
    let (ended, _) = run(&case, coupling.ports().clone(), [&mut train_track, &mut bridge], &mut [&mut table]);
    let halvings: usize = table.steps.iter().map(|step| step.halvings).sum();
    assert!(ended.is_ok() && halvings > 0, "{halvings}");
    assert!(coupling.report().work.exchange_imbalance() < 1e-12);
}
