//! The loop over the steps on something that counts them.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

use ttb_contract::{Failure, Ports, Signal, Subsystem};
use ttb_coupling::{Coupling, Method, OnFailure, Outcome, Predictor, Settings, StepInfo};
use ttb_scenario::types::{Csv, Decimal, Separator};
use ttb_session::abreast::Run;
use ttb_session::observe::{IterationsCsv, Moment, Observer, Progress, ResultsCsv, Timed};
use ttb_session::{Column, Coupled, Ended, Plan, RunError, Stepping, Table, TimeAxis, drive, drive_abreast};

/// Tells its time and its square; fails in a step if asked to.
#[derive(Default)]
struct Clockwork {
    t: f64,
    fails_from: Option<f64>,
    started: bool,
}

impl Stepping for Clockwork {
    fn columns(&mut self, wanted: &dyn Fn(&Column) -> bool) -> Vec<Column> {
        let all = ["car[1].position", "point[mid].displacement"].map(|name| Column::parse(name, "m"));
        assert!(all.iter().all(wanted));
        all.to_vec()
    }
    fn start(&mut self) -> Result<(), RunError> {
        self.started = true;
        Ok(())
    }
    fn step(&mut self, t: f64, h: f64) -> Result<StepInfo, RunError> {
        assert!(self.started && (t - self.t).abs() < 1e-12);
        if self.fails_from.is_some_and(|from| t >= from) {
            let failure = Failure::new("clockwork", "it stands still");
            return Err(RunError::Subsystem(failure));
        }
        self.t = t + h;
        Ok(StepInfo { outcome: Outcome::Converged, iterations: 2, ..StepInfo::default() })
    }
    fn read(&mut self, row: &mut [f64]) -> Result<(), RunError> {
        row.copy_from_slice(&[self.t, self.t * self.t]);
        Ok(())
    }
    fn inside(&self) -> [f64; 2] {
        [10.0 * self.t, 20.0 * self.t]
    }
}

const ALL: &dyn Fn(&Column) -> bool = &|_| true;

#[test]
fn every_row_has_its_time_and_the_last_step_is_shortened() {
    let mut table = Table::default();
    let plan = Plan { axis: TimeAxis::new(0.4, 1.0), wanted: ALL, clock: &|| 0.0 };
    let ended = drive(&mut Clockwork::default(), &plan, &mut [&mut table]).expect("a run");
    assert_eq!(ended, Ended::Complete);
    assert_eq!(table.time, [0.0, 0.4, 0.8, 1.0]);
    let told = table.history("car[1].position").expect("recorded");
    assert!(told.iter().zip(&table.time).all(|(told, t)| (told - t).abs() < 1e-15), "{told:?}");
    assert_eq!(table.steps.len(), 3);
}

#[test]
fn runs_abreast_are_the_runs_alone_and_one_that_fails_leaves_the_others() {
    let plan = |end| Plan { axis: TimeAxis::new(0.25, end), wanted: ALL, clock: &|| 0.0 };
    let plans = [plan(1.0), plan(2.0), plan(0.6)];
    let clocks = || [None, Some(0.75), None].map(|fails_from| Clockwork { fails_from, ..Clockwork::default() });
    let (mut systems, mut tables, mut seen) = (clocks(), [(); 3].map(|()| Table::default()), Vec::new());
    let runs = systems.iter_mut().zip(&plans).zip(&mut tables);
    let runs = runs.map(|((system, plan), table)| Run { system, plan, observers: vec![table] });
    let ended = drive_abreast(&mut runs.collect::<Vec<_>>(), &mut |going| {
        seen.push(going.iter().map(|one| one.t).collect::<Vec<_>>());
    });
    // Step by step, only those that have not come to their end.
    assert_eq!(seen, [vec![0.0; 3], vec![0.25; 3], vec![0.5; 3], vec![0.75, 0.75]]);
    assert!(matches!(ended[..], [Ok(Ended::Complete), Err(RunError::Subsystem(_)), Ok(Ended::Complete)]), "{ended:?}");
    for ((mut system, plan), table) in clocks().into_iter().zip(&plans).zip(&tables) {
        let mut alone = Table::default();
        let _ = drive(&mut system, plan, &mut [&mut alone]);
        assert_eq!((&table.time, &table.values), (&alone.time, &alone.values));
    }
}

#[test]
fn rows_are_written_every_so_often_and_at_the_end() {
    let (mut results, mut iterations) = (Vec::new(), Vec::new());
    let plan = Plan { axis: TimeAxis::new(0.25, 1.75), wanted: ALL, clock: &|| 0.0 };
    let mut observers =
        (ResultsCsv::new(&mut results, "results", 3), IterationsCsv::new(&mut iterations, "iterations"));
    drive(&mut Clockwork::default(), &plan, &mut [&mut observers.0, &mut observers.1]).expect("a run");
    drop(observers);
    let lines =
        |bytes: Vec<u8>| String::from_utf8(bytes).expect("text").lines().map(str::to_string).collect::<Vec<_>>();
    let (results, iterations) = (lines(results), lines(iterations));
    assert_eq!(results[0], "time,car[1].position,point[mid].displacement");
    let times: Vec<f64> = results[1..].iter().map(|row| row.split(',').next().unwrap().parse().unwrap()).collect();
    assert_eq!(times, [0.0, 0.75, 1.5, 1.75]);
    assert_eq!(results[2].split(',').nth(2).unwrap().parse::<f64>().unwrap(), 0.75 * 0.75);
    assert_eq!((iterations.len(), iterations[1].starts_with("0.25")), (8, true));
    assert_eq!(iterations[1].split(',').count(), iterations[0].split(',').count());
}

#[test]
fn a_table_for_a_spreadsheet_has_its_separator_its_decimals_and_only_what_was_asked_for() {
    let (mut results, mut iterations) = (Vec::new(), Vec::new());
    let plan = Plan { axis: TimeAxis::new(0.003, 0.012), wanted: ALL, clock: &|| 0.0 };
    let csv = Csv { separator: Separator::Semicolon, decimal: Decimal::Comma, digits: 4 };
    let mut observers = (
        ResultsCsv::new(&mut results, "results", 1).with(&["point[*].*".into()], csv),
        IterationsCsv::new(&mut iterations, "iterations").with(csv),
    );
    drive(&mut Clockwork::default(), &plan, &mut [&mut observers.0, &mut observers.1]).expect("a run");
    drop(observers);
    let text = String::from_utf8(results).expect("text");
    // 3 · 0.003 is 0.009000000000000001 in binary numbers.
    assert_eq!(text.lines().next(), Some("time;point[mid].displacement"));
    assert_eq!(text.lines().nth(4), Some("0,009;0,000081"));
    let iterations = String::from_utf8(iterations).expect("text");
    assert!(!iterations.contains('.'), "{iterations}");
    assert_eq!(iterations.lines().nth(1).expect("a step").split(';').count(), 13);
}

#[test]
fn what_a_step_took_is_told_apart_from_what_observing_took() {
    let ticks = Cell::new(0.0);
    // Every look at the clock takes a second.
    let clock = || {
        ticks.set(ticks.get() + 1.0);
        ticks.get()
    };
    let mut timed = Timed::default();
    let plan = Plan { axis: TimeAxis::new(0.5, 2.0), wanted: ALL, clock: &clock };
    drive(&mut Clockwork::default(), &plan, &mut [&mut timed]).expect("a run");
    // Start: 1 and 2; steps: 3–4, 5–6, 7–8, 9–10.
    assert_eq!((timed.begun, timed.steps.at, timed.steps.wall), (Some(3.0), 10.0, 4.0));
    assert_eq!(timed.steps.inside, [20.0, 40.0]);
}

/// Says what it saw.
#[derive(Default)]
struct Witness {
    seen: Vec<u64>,
    ended: bool,
    stop_at: Option<u64>,
}

impl Observer for Witness {
    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        assert_eq!(moment.info.is_some(), moment.n > 0);
        self.seen.push(moment.n);
        let stop = self.stop_at.is_some_and(|at| moment.n >= at);
        Ok(if stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
    fn end(&mut self) -> Result<(), RunError> {
        self.ended = true;
        Ok(())
    }
}

#[test]
fn all_observers_see_the_step_that_one_of_them_ends_the_run_with() {
    let (mut first, mut last) = (Witness { stop_at: Some(2), ..Witness::default() }, Witness::default());
    let plan = Plan { axis: TimeAxis::new(0.5, 5.0), wanted: ALL, clock: &|| 0.0 };
    let ended = drive(&mut Clockwork::default(), &plan, &mut [&mut first, &mut last]).expect("a run");
    assert_eq!((ended, &first.seen, &last.seen), (Ended::Stopped, &vec![0, 1, 2], &vec![0, 1, 2]));
    assert!(first.ended && last.ended);
    let (stop, mut told) = (AtomicBool::new(true), Vec::new());
    let mut tell = |n| told.push(n);
    let mut progress = Progress::new(&mut tell, &stop);
    assert_eq!(drive(&mut Clockwork::default(), &plan, &mut [&mut progress]).expect("a run"), Ended::Stopped);
    assert_eq!((progress.reached, told), (0.0, vec![0]));
}

#[test]
fn a_step_that_fails_leaves_all_steps_before_it_and_the_end_to_the_observers() {
    let mut witness = Witness::default();
    let mut failing = Clockwork { fails_from: Some(1.0), ..Clockwork::default() };
    let plan = Plan { axis: TimeAxis::new(0.5, 5.0), wanted: ALL, clock: &|| 0.0 };
    let failed = drive(&mut failing, &plan, &mut [&mut witness]);
    assert!(matches!(failed, Err(RunError::Subsystem(_))), "{failed:?}");
    assert_eq!((witness.seen, witness.ended), (vec![0, 1, 2], true));
}

/// A disk with room for so many bytes.
struct Small(usize);

impl std::io::Write for Small {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or_else(|| std::io::Error::other("no room"))?;
        Ok(bytes.len())
    }
    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_disk_that_fills_ends_the_run_with_its_name() {
    let plan = Plan { axis: TimeAxis::new(0.5, 5.0), wanted: ALL, clock: &|| 0.0 };
    let failed = drive(&mut Clockwork::default(), &plan, &mut [&mut ResultsCsv::new(Small(200), "results.csv", 1)]);
    assert_eq!(failed.expect_err("no room").to_string(), "results.csv: no room");
}

/// One side of a pair that both record `x`.
struct Side(&'static str, f64);

impl Subsystem for Side {
    fn set_inputs(&mut self, _values: &[f64], _rates: Option<&[f64]>) -> Result<(), Failure> {
        Ok(())
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        outputs.fill(0.0);
        Ok(())
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        Ok(())
    }
    fn step(&mut self, t: f64, h: f64, _may_restore: bool) -> Result<(), Failure> {
        assert!(t + h < 0.25);
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
    fn record(&mut self, wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        let own = if self.0 == "Train" { vec!["x", "speed"] } else { vec!["x"] };
        let signals = own.into_iter().map(|name| Signal { name: name.into(), unit: "m".into() });
        signals.filter(|signal| wanted(signal)).collect()
    }
    fn read(&mut self, row: &mut [f64]) -> Result<(), Failure> {
        row.fill(self.1);
        Ok(())
    }
    fn name(&self) -> &str {
        self.0
    }
}

#[test]
fn columns_of_both_sides_stand_side_by_side_and_equal_names_are_told_apart() {
    let settings = Settings {
        method: Method::FixedPoint,
        reuse: 2,
        predictor: Predictor::Constant,
        tolerance: 1e-6,
        max_iterations: 5,
        hold_forces: false,
        mean_forces: false,
        on_failure: OnFailure::Stop,
    };
    let (mut train, mut bridge) = (Side("Train", 1.0), Side("Bridge", 2.0));
    let (mut coupling, mut table) = (Coupling::new(Ports::vertical(1, 1.0), settings), Table::default());
    let plan = Plan { axis: TimeAxis::new(0.1, 0.2), wanted: ALL, clock: &|| 0.0 };
    let mut coupled = Coupled::new(&mut train, &mut bridge, &mut coupling);
    drive(&mut coupled, &plan, &mut [&mut table]).expect("a run");
    assert_eq!(coupled.of_train_track(), 2);
    let names: Vec<String> = table.columns.iter().map(ToString::to_string).collect();
    assert_eq!(names, ["x", "speed", "Bridge.x"]);
    assert_eq!(table.values, [[1.0; 3], [1.0; 3], [2.0; 3]]);
}
