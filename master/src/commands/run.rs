//! `ttb run`: build, connect, initialise, step, record, sum up.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use ttb_contract::Subsystem;
use ttb_coupling::probe::Probe;
use ttb_session::observe::{Iterations, IterationsCsv, Peaks, Progress, ResultsCsv, Timed};
use ttb_session::{Coupled, Ended, Plan, drive};

use super::progress::progress_bar;
use super::signals::stop_on_interrupt;
use crate::cli::Run;
use crate::connect::connected::{Connected, Given, connect};
use crate::connect::isolate::Isolated;
use crate::connect::map::Map;
use crate::connect::preload;
use crate::connect::probe::judge;
use crate::error::Error;
use crate::pictures::plot::Plot;
use crate::prepare::{auto, fmus};
use crate::results::coupled::CouplingReport;
use crate::results::job::Job;
use crate::results::summary::{Seconds, Summary};
use crate::system::Opened;

/// The command.
pub fn run(arguments: &Run) -> Result<(), Error> {
    let isolated = Isolated::new(arguments)?;
    preload::load(&arguments.preload)?;
    let done = match arguments.system() {
        Some(path) => run_system(path, arguments, &isolated),
        None => run_scenario(arguments, &isolated),
    };
    done.map_err(|error| isolated.advise(error, arguments))
}

fn run_scenario(arguments: &Run, isolated: &Isolated) -> Result<(), Error> {
    let mut checked = fmus::scenario(arguments.scenario.as_deref())?;
    for given in arguments.train_track.iter().chain(&arguments.bridge) {
        std::fs::File::open(given).map_err(|e| Error::Input(format!("{}: {e}", given.display())))?;
    }
    let maps = arguments.map.iter().map(|path| Map::load(path)).collect::<Result<Vec<_>, _>>()?;
    if maps.len() > 1 && maps.len() != arguments.bridge.len() {
        let (maps, bridges) = (maps.len(), arguments.bridge.len());
        return Err(Error::Input(format!(
            "{bridges} bridges and {maps} maps: give one for all, or one for each in the same order"
        )));
    }
    if arguments.train_track.is_some() && checked.scenario.time.step.given().is_none() {
        return Err(Error::Input("a step is chosen for our train and track: with --train-track give time.step".into()));
    }
    let map = |k: usize| if maps.len() > 1 { maps.get(k) } else { maps.first() };
    let given: Vec<Given> = arguments.bridge.iter().enumerate().map(|(k, path)| Given { path, map: map(k) }).collect();
    let choice = auto::choose(&mut checked, &given, isolated)?;
    let folder = &arguments.output;
    std::fs::create_dir_all(folder).map_err(Error::io(folder))?;
    let train_track = arguments.train_track.clone().map_or_else(|| fmus::train_track(&checked, folder), Ok)?;
    let mut bridges = arguments.bridge.clone();
    if bridges.is_empty() {
        let (path, remarks) = fmus::bridge(&checked, folder)?;
        warn(&remarks);
        checked.warnings.extend(remarks);
        bridges.push(path);
    }
    let bridges: Vec<Given> = bridges.iter().enumerate().map(|(k, path)| Given { path, map: map(k) }).collect();
    let (stop, begin) = (stop_on_interrupt(), Instant::now());
    let told = checked.warnings.len();
    let job = Job::new(&checked, choice);
    run_trusting(
        |trusted| connect(&train_track, &bridges, &checked, isolated, trusted),
        |connected| {
            warn(&connected.warnings[told..]);
            run_connected(&job, connected, arguments, &stop, begin)
        },
    )
}

/// Runs with bridges as they describe themselves; should it turn out that one does not roll back, once more with other
/// instances, as ones that say so.
fn run_trusting(
    open: impl Fn(bool) -> Result<Connected, Error>,
    run: impl Fn(&mut Connected) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut first = open(true)?;
    match run(&mut first) {
        Err(Error::NoReturn(text)) => {
            // Not unloaded before the others, if it may stay: NumPy, for one, cannot be loaded twice.
            let _stays = first.several.then_some(first);
            let mut second = open(false)?;
            second.warnings.push(text);
            run(&mut second)
        }
        done => done,
    }
}

fn warn(warnings: &[String]) {
    warnings.iter().for_each(|warning| eprintln!("ttb: warning: {warning}"));
}

fn run_system(path: &Path, arguments: &Run, isolated: &Isolated) -> Result<(), Error> {
    if arguments.train_track.is_some() || !arguments.bridge.is_empty() {
        return Err(Error::Input(
            "--train-track and --bridge belong to a scenario; an .ssp file names its FMUs itself".into(),
        ));
    }
    let (stop, begin) = (stop_on_interrupt(), Instant::now());
    let opened = Opened::open(path, isolated)?;
    run_trusting(
        |trusted| opened.connect(isolated, trusted),
        |connected| {
            warn(&connected.warnings);
            std::fs::create_dir_all(&arguments.output).map_err(Error::io(&arguments.output))?;
            run_connected(&opened.job, connected, arguments, &stop, begin)
        },
    )
}

/// From initialization to the summary.
fn run_connected(
    job: &Job,
    connected: &mut Connected,
    arguments: &Run,
    stop: &AtomicBool,
    begin: Instant,
) -> Result<(), Error> {
    let (folder, axis) = (&arguments.output, job.case.axis());
    let [results, iterations] = ["results.csv", "iterations.csv"].map(|name| folder.join(name));
    let mut results = ResultsCsv::new(create(&results)?, &results.display().to_string(), job.case.every);
    let mut iterations = IterationsCsv::new(create(&iterations)?, &iterations.display().to_string());
    let mut log = Log::new(job);
    let bar = progress_bar(axis.steps(), arguments.quiet);
    let mut tell = |n| bar.set_position(n);
    let mut progress = Progress::new(&mut tell, stop);
    let clock = || begin.elapsed().as_secs_f64();
    let plan = Plan { axis, wanted: &|column| job.case.keeps(column), clock: &clock };
    let Connected { train_track, bridge, coupling, parts, probe, .. } = &mut *connected;
    let (name, groups) = (train_track.name().to_string(), bridge.ranges());
    let mut look = |found: &Probe| {
        probe.clone_from(found);
        judge(found, &name, parts)
    };
    let mut coupled = Coupled::new(train_track, bridge, coupling);
    if !arguments.no_probe {
        coupled = coupled.probed(groups, &mut look);
    }
    let ended = drive(
        &mut coupled,
        &plan,
        &mut [
            &mut log.counted,
            &mut iterations,
            &mut results,
            &mut log.peaks,
            &mut log.plot,
            &mut log.timed,
            &mut progress,
        ],
    );
    log.ended = clock();
    log.reached = progress.reached;
    bar.finish_and_clear();
    let outcome = match ended {
        Ok(Ended::Complete) => Ok(()),
        Ok(Ended::Stopped) => Err(Error::Interrupted),
        Err(error) => Err(error.into()),
    };
    if matches!(outcome, Err(Error::NoReturn(_))) {
        return outcome;
    }
    finish(job, &log, outcome, connected, folder, arguments.quiet)
}

fn create(path: &Path) -> Result<BufWriter<File>, Error> {
    File::create(path).map(BufWriter::new).map_err(Error::io(path))
}

/// What was seen of a run.
struct Log {
    counted: Iterations,
    peaks: Peaks,
    plot: Plot,
    timed: Timed,
    reached: f64,
    /// Seconds from the begin of the command to the end of the run.
    ended: f64,
}

impl Log {
    fn new(job: &Job) -> Self {
        let (counted, peaks, timed) = (Iterations::default(), Peaks::default(), Timed::default());
        Self { counted, peaks, plot: Plot::new(job.scene.clone()), timed, reached: 0.0, ended: 0.0 }
    }

    fn seconds(&self) -> Seconds {
        let begun = self.timed.begun.unwrap_or(self.ended);
        let steps = self.timed.steps;
        let [train_track, bridge] = steps.inside;
        let stepping = self.ended - begun;
        Seconds {
            initialization: begun,
            train_track,
            bridge,
            master: steps.wall - train_track - bridge,
            recording: stepping - steps.wall,
            stepping,
        }
    }
}

/// Summary and picture, also of a run that failed; its error is passed on.
fn finish(
    job: &Job,
    log: &Log,
    outcome: Result<(), Error>,
    connected: &Connected,
    folder: &Path,
    quiet: bool,
) -> Result<(), Error> {
    let coupling = CouplingReport::new(&connected.coupling, &connected.probe);
    let (counted, warnings) = (&log.counted, &connected.warnings);
    let summary = Summary::new(job, &outcome, log.reached, counted, coupling, log.seconds(), warnings, &log.peaks);
    let written = summary.write(&folder.join("summary.json"));
    if !quiet {
        summary.print(folder);
    }
    let drawn = log.plot.draw(folder, &job.case.title);
    outcome.and(written).and(drawn)
}
