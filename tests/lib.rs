//! Shared by the tests of the whole: a scenario run without FMUs, and the table it gives.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use ttb_bridge::Bridge;
use ttb_contract::{InProcess, Model};
use ttb_coupling::iteration::IterationError;
use ttb_coupling::run::{TimeAxis, run};
use ttb_coupling::{Coupling, StepInfo, Work};
use ttb_scenario::Checked;
use ttb_scenario::spec::StructureSpec;
use ttb_train_track::TrainTrack;

/// Results by name, one vector over time each, row 0 at t = 0.
pub struct Table {
    /// t, s.
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

/// The program that `cargo build` left beside this test or benchmark.
///
/// # Panics
/// It is not there.
pub fn ttb() -> PathBuf {
    let test = std::env::current_exe().expect("path of the test");
    let program = test.ancestors().nth(2).expect("target folder").join("ttb");
    assert!(program.is_file(), "{} is missing: run tests/run, or cargo build in this profile first", program.display());
    program
}

/// An example scenario.
///
/// # Panics
/// It has problems.
pub fn example(name: &str) -> Checked {
    ttb_scenario::load(&examples().join(name)).unwrap_or_else(|problems| panic!("{problems}"))
}

/// R1 with a bridge of `mass` kg/m, bending stiffness scaled alike (so are its frequencies kept), and steps of `h` s.
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

/// Both subsystems in initialization mode, wired by equal names, and the value references of their outputs.
pub struct Pair {
    /// The train–track subsystem.
    pub train_track: InProcess<TrainTrack>,
    /// The bridge subsystem.
    pub bridge: InProcess<Bridge>,
    /// Where they touch.
    pub ports: ttb_contract::Ports,
    outputs: [(Vec<String>, Vec<u32>); 2],
}

/// Makes the pair of a scenario.
///
/// # Panics
/// A subsystem refuses its data.
pub fn pair(checked: &Checked) -> Pair {
    let train_track = TrainTrack::new(checked.train_track.clone()).expect("train and track");
    let bridge = Bridge::new(checked.bridge.clone()).expect("bridge");
    let outputs = [train_track.interface(), bridge.interface()].map(|interface| {
        let names = interface.outputs().map(|r| interface.variables()[r].name.clone());
        (names.collect(), interface.outputs().map(|r| r as u32).collect())
    });
    let ttb_contract::Pair { train_track, bridge, ports } =
        ttb_contract::Pair::new(train_track, bridge, checked.settings().force_scale, |force| checked.sent_force(force))
            .expect("initialization");
    Pair { train_track, bridge, ports, outputs }
}

/// The hybrid algorithm on the plain libraries; every output of both subsystems is kept.
///
/// # Panics
/// The run fails.
pub fn library_run(checked: &Checked) -> Table {
    let Pair { mut train_track, mut bridge, ports, outputs } = pair(checked);
    let mut coupling = Coupling::new(ports.forces(), ports.motions(), checked.settings());
    coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("static equilibrium");
    let names = outputs.iter().enumerate().flat_map(|(i, (names, _))| {
        // Motions of the supports stand on both sides; the bridge's are outputs, the other side's inputs.
        names.iter().map(move |n| (i, n.clone()))
    });
    let mut table = Table {
        time: Vec::new(),
        columns: names.map(|(_, n)| (n, Vec::new())).collect(),
        steps: Vec::new(),
        work: Work::default(),
    };
    let mut row = vec![0.0; table.columns.len()];
    let mut record =
        |train_track: &mut InProcess<TrainTrack>, bridge: &mut InProcess<Bridge>, t: f64, table: &mut Table| {
            let (first, second) = row.split_at_mut(outputs[0].1.len());
            train_track.instance().get(&outputs[0].1, first).expect("outputs");
            bridge.instance().get(&outputs[1].1, second).expect("outputs");
            table.time.push(t);
            table.columns.iter_mut().zip(&row).for_each(|((_, column), x)| column.push(*x));
        };
    record(&mut train_track, &mut bridge, 0.0, &mut table);
    let axis = TimeAxis::new(checked.steps().step, checked.train_track.end);
    let ended = run(&mut coupling, &mut train_track, &mut bridge, axis, |train_track, bridge, _, t, info| {
        record(train_track, bridge, t, &mut table);
        table.steps.push(*info);
        Ok::<_, IterationError>(ControlFlow::Continue(()))
    });
    assert!(ended.expect("run").is_continue());
    table.work = coupling.report().work;
    table
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
