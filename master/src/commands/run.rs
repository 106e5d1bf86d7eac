//! `ttb run`: build, connect, initialise, step, record, sum up.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use indicatif::ProgressBar;
use ttb_coupling::run::{TimeAxis, run as run_steps};
use ttb_fmi::FmuSubsystem;

use super::progress::progress_bar;
use super::signals::stop_on_interrupt;
use crate::cli::Run;
use crate::connect::connected::{BridgeSide, Connected, Given, connect};
use crate::connect::isolate::Isolated;
use crate::connect::map::Map;
use crate::connect::preload;
use crate::connect::probe::judge;
use crate::error::Error;
use crate::pictures::plot::Plot;
use crate::prepare::{auto, fmus};
use crate::results::coupled::CouplingReport;
use crate::results::job::Job;
use crate::results::peaks::Peaks;
use crate::results::record::Recorder;
use crate::results::summary::{Iterations, Seconds, Summary};
use crate::system::Opened;

/// Steps between two looks at the progress bar.
const PROGRESS: u64 = 50;

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
        bridges.push(fmus::bridge(&checked, folder)?);
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
        Err(Error::Lies(text)) => {
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
    let folder = &arguments.output;
    let (axis, output) = (TimeAxis::new(job.step, job.end), job.output);
    let Connected { train_track, bridge, .. } = &mut *connected;
    let recorder = Recorder::new(folder, train_track, bridge, output.supports, output.every, axis.steps())?;
    let mut log = Log {
        peaks: Peaks::new(&recorder),
        plot: Plot::new(&recorder, &job.scene, job.end),
        recorder,
        iterations: Iterations::default(),
        recording: 0.0,
        reached: 0.0,
        mark: Instant::now(),
        bar: progress_bar(axis.steps(), arguments.quiet),
    };
    let mut seconds = Seconds::default();
    let begun = initialise(connected, axis, &mut log, !arguments.no_probe);
    let outcome = begun.and_then(|()| simulate(connected, axis, &mut log, stop, begin, &mut seconds));
    log.bar.finish_and_clear();
    if matches!(outcome, Err(Error::Lies(_))) {
        return outcome;
    }
    let outcome = outcome.and(log.recorder.flush());
    if let Some(choice) = &job.choice {
        log.peaks.estimate(choice);
    }
    finish(job, &log, outcome, seconds, connected, folder, arguments.quiet)
}

/// Results of a run as they come.
struct Log {
    recorder: Recorder,
    peaks: Peaks,
    plot: Plot,
    iterations: Iterations,
    recording: f64,
    reached: f64,
    mark: Instant,
    bar: ProgressBar,
}

impl Log {
    /// After step `n` (0: initialization), which ended at `t` and took `h`.
    fn step(
        &mut self,
        train_track: &mut FmuSubsystem,
        bridge: &mut BridgeSide,
        n: u64,
        t: f64,
        h: f64,
    ) -> Result<(), Error> {
        self.recorder.record(train_track, bridge, n, t)?;
        self.peaks.update(&self.recorder.row, t, h);
        self.plot.update(&self.recorder.row, t);
        self.reached = t;
        if n.is_multiple_of(PROGRESS) {
            self.bar.set_position(n);
        }
        Ok(())
    }
}

/// Static equilibrium; its row; what trial steps show.
fn initialise(connected: &mut Connected, axis: TimeAxis, log: &mut Log, probe: bool) -> Result<(), Error> {
    let Connected { train_track, bridge, coupling, .. } = connected;
    coupling.initialise(train_track, bridge, 0.0)?;
    log.step(train_track, bridge, 0, 0.0, 0.0)?;
    if probe {
        let groups = bridge.ranges();
        connected.probe = coupling.probe(train_track, bridge, &groups, axis)?;
        judge(&connected.probe, train_track.instance().name(), &connected.parts)?;
    }
    Ok(())
}

fn simulate(
    connected: &mut Connected,
    axis: TimeAxis,
    log: &mut Log,
    stop: &AtomicBool,
    begin: Instant,
    seconds: &mut Seconds,
) -> Result<(), Error> {
    let Connected { train_track, bridge, coupling, .. } = connected;
    let before = [inside(train_track), inside_all(bridge)];
    seconds.initialization = begin.elapsed().as_secs_f64();
    let begin = Instant::now();
    let mut reading = [0.0; 2];
    log.mark = begin;
    let ended = run_steps(coupling, train_track, bridge, axis, |train_track, bridge, n, t, info| {
        let stepped = Instant::now();
        let inside_before = [inside(train_track), inside_all(bridge)];
        log.iterations.count(info);
        log.recorder.iteration(t, info, (stepped - log.mark).as_secs_f64())?;
        log.step(train_track, bridge, n, t, axis.size(n - 1))?;
        reading[0] += inside(train_track) - inside_before[0];
        reading[1] += inside_all(bridge) - inside_before[1];
        log.mark = Instant::now();
        log.recording += (log.mark - stepped).as_secs_f64();
        Ok::<_, Error>(if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    });
    seconds.stepping = begin.elapsed().as_secs_f64();
    seconds.recording = log.recording;
    seconds.train_track = inside(train_track) - before[0] - reading[0];
    seconds.bridge = inside_all(bridge) - before[1] - reading[1];
    seconds.master = seconds.stepping - seconds.recording - seconds.train_track - seconds.bridge;
    if ended?.is_break() { Err(Error::Interrupted) } else { Ok(()) }
}

/// Seconds spent inside an FMU so far.
fn inside(fmu: &mut FmuSubsystem) -> f64 {
    fmu.instance().tally().time.as_secs_f64()
}

fn inside_all(bridge: &mut BridgeSide) -> f64 {
    bridge.parts().map(|part| inside(part.inner())).sum()
}

/// Summary and picture, also of a run that failed; its error is passed on.
fn finish(
    job: &Job,
    log: &Log,
    outcome: Result<(), Error>,
    seconds: Seconds,
    connected: &Connected,
    folder: &Path,
    quiet: bool,
) -> Result<(), Error> {
    let coupling = CouplingReport::new(&connected.coupling, &connected.probe);
    let (iterations, warnings) = (&log.iterations, &connected.warnings);
    let summary = Summary::new(job, &outcome, log.reached, iterations, coupling, seconds, warnings, &log.peaks);
    let written = summary.write(&folder.join("summary.json"));
    if !quiet {
        summary.print(folder);
    }
    let drawn = log.plot.draw(folder, &job.title);
    outcome.and(written).and(drawn)
}
