//! Shared by the tests of the whole: a scenario run without FMUs, and the table it gives.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use ttb_bridge::Bridge;
use ttb_contract::{Ports, Subsystem};
use ttb_coupling::{Coupling, Report, StepInfo, Work};
use ttb_scenario::Checked;
use ttb_scenario::spec::StructureSpec;
use ttb_session::{Case, Column, Coupled, Ended, Observer, Plan, RunError, Sides, drive};
use ttb_train_track::TrainTrack;

/// Results by name, one vector over time each, row 0 at t = 0.
pub struct Table {
    /// Time of each row, s.
    pub time: Vec<f64>,
    /// Names and values of all outputs.
    pub columns: Vec<(String, Vec<f64>)>,
    /// How every step went.
    pub steps: Vec<StepInfo>,
    /// Work at the interface.
    pub work: Work,
}

impl Table {
    /// A column by name.
    ///
    /// # Panics
    /// There is no such column.
    pub fn column(&self, name: &str) -> &[f64] {
        &self.columns.iter().find(|(n, _)| n == name).unwrap_or_else(|| panic!("no column {name}")).1
    }
    /// Least and greatest value of a column.
    pub fn range(&self, name: &str) -> (f64, f64) {
        let fold = |f: fn(f64, f64) -> f64, start| self.column(name).iter().copied().fold(start, f);
        (fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY))
    }
}

/// The examples folder.
pub fn examples() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../examples")
}

/// The program, built by cargo in the profile of this test or benchmark when it is first asked for; `$TTB` names another.
///
/// # Panics
/// It cannot be built.
pub fn ttb() -> PathBuf {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| std::env::var_os("TTB").map_or_else(built, PathBuf::from)).clone()
}

/// As `cargo build` does it, so that nothing is compiled twice: the default members, with their features.
fn built() -> PathBuf {
    let test = std::env::current_exe().expect("path of the test");
    let folder = test.ancestors().nth(2).expect("folder of the profile");
    let profile = folder.file_name().and_then(|name| name.to_str()).expect("name of the profile");
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["build", "--quiet", "--profile", if profile == "debug" { "dev" } else { profile }]);
    // What cargo tells a test it would tell the build, too: sources would seem to have changed.
    let told = std::env::vars_os().map(|(name, _)| name);
    let told = told.filter(|name| {
        name.to_string_lossy().starts_with("CARGO_") && name != "CARGO_HOME" && name != "CARGO_TARGET_DIR"
    });
    for name in told {
        command.env_remove(name);
    }
    let status = command.current_dir(env!("CARGO_MANIFEST_DIR").to_string() + "/..").status().expect("cargo");
    assert!(status.success(), "cargo build failed");
    folder.join("ttb")
}

/// An example scenario.
///
/// # Panics
/// It has problems.
pub fn example(name: &str) -> Checked {
    ttb_scenario::load(&examples().join(name)).unwrap_or_else(|problems| panic!("{problems}"))
}

/// R1 with a bridge of `mass` kg/m and steps of `h` s; the bending stiffness is scaled with the mass, which keeps the
/// frequencies.
///
/// # Panics
/// R1 is not what it was.
pub fn r1_with(mass: f64, h: f64) -> Checked {
    let mut checked = example("r1.json");
    (checked.train_track.step, checked.bridge.step) = (h, h);
    let StructureSpec::Beams { spans, .. } = &mut checked.bridge.structure else { panic!("R1 has a beam") };
    spans[0].bending_stiffness *= mass / spans[0].mass;
    spans[0].mass = mass;
    checked
}

/// Both subsystems of a scenario in initialization mode, and their coupling.
///
/// # Panics
/// A subsystem refuses its data.
pub fn sides(checked: &Checked) -> Sides<TrainTrack, Bridge> {
    let train_track = TrainTrack::new(checked.train_track.clone()).expect("train and track");
    let bridge = Bridge::new(checked.bridge.clone()).expect("bridge");
    Sides::new(train_track, bridge, &Case::of(checked)).expect("initialization")
}

/// Takes all steps of a case with any two subsystems, and returns the report of the coupling, too.
///
/// # Errors
/// The run fails.
pub fn run(
    case: &Case,
    ports: Ports,
    [train_track, bridge]: [&mut dyn Subsystem; 2],
    observers: &mut [&mut dyn Observer],
) -> (Result<Ended, RunError>, Report) {
    let mut coupling = Coupling::new(ports, case.settings);
    let mut coupled = Coupled::new(train_track, bridge, &mut coupling);
    let plan = Plan { axis: case.axis(), wanted: &|_: &Column| true, clock: &|| 0.0 };
    let ended = drive(&mut coupled, &plan, observers);
    (ended, coupling.report().clone())
}

/// The hybrid algorithm on the plain libraries; every output of both subsystems is kept.
///
/// # Panics
/// The run fails.
pub fn library_run(checked: &Checked) -> Table {
    let (case, mut sides, mut table) = (Case::of(checked), sides(checked), ttb_session::Table::default());
    let plan = Plan { axis: case.axis(), wanted: &|_: &Column| true, clock: &|| 0.0 };
    let ended = sides.run(&plan, &mut [&mut table]).expect("run");
    assert_eq!(ended, Ended::Complete);
    let names = table.columns.iter().map(ToString::to_string);
    Table {
        columns: names.zip(table.values).collect(),
        time: table.time,
        steps: table.steps,
        work: sides.coupling.report().work,
    }
}

/// A results.csv: names and values of its columns.
///
/// # Panics
/// It cannot be read.
pub fn read_results(folder: &Path) -> Vec<(String, Vec<f64>)> {
    let text = std::fs::read_to_string(folder.join("results.csv")).expect("results.csv");
    let mut lines = text.lines();
    let names = lines.next().expect("header").split(',');
    let mut columns: Vec<(String, Vec<f64>)> = names.map(|name| (name.to_string(), Vec::new())).collect();
    for line in lines {
        for ((_, column), field) in columns.iter_mut().zip(line.split(',')) {
            column.push(field.parse().expect("number"));
        }
    }
    columns
}
