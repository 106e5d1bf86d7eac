//! `ttb run`: build, connect, initialise, step, record, sum up.

use std::path::Path;
use std::time::Instant;

use ttb_assessment::{Criteria, Facts};
use ttb_campaign::facts;
use ttb_contract::Subsystem;
use ttb_coupling::probe::Probe;
use ttb_fmi::temporary::Temporary;
use ttb_scenario::Checked;
use ttb_session::observe::{Iterations, IterationsCsv, Only, Peaks, Progress, ResultsCsv, Timed};
use ttb_session::{Column, Coupled, Ended, Plan, drive};

use super::output::{Opening, Output};
use super::progress::progress_bar;
use crate::assess::limits;
use crate::assess::run::{About, write as write_assessment};
use crate::assess::watch::Watch;
use crate::cli::Run;
use crate::connect::connected::{Connected, Given, connect};
use crate::connect::isolate::Isolated;
use crate::connect::map::{Map, maps_fit};
use crate::connect::preload;
use crate::connect::probe::{judge, judge_own};
use crate::connect::trusting::trusting;
use crate::error::Error;
use crate::pictures::plot::Plot;
use crate::prepare::{auto, fmus};
use crate::results::belief::unbelievable;
use crate::results::coupled::{CouplingReport, returned};
use crate::results::credible::Doubts;
use crate::results::folder::Folder;
use crate::results::job::Job;
use crate::results::peaks::not_finite;
use crate::results::provenance::{Provenance, resolved};
use crate::results::rows::Rows;
use crate::results::summary::{Seconds, Shown, Summary};
use crate::signals::Stop;
use crate::system::Opened;

/// The command.
pub fn run(arguments: &Run, stop: &Stop) -> Result<(), Error> {
    let isolated = Isolated::new(arguments)?;
    let criteria = limits::load(&arguments.limits)?;
    preload::load(&arguments.preload)?;
    let done = match arguments.system() {
        Some(path) => run_system(path, arguments, &isolated, &criteria, stop),
        None => run_scenario(arguments, &isolated, &criteria, stop),
    };
    done.map_err(|error| isolated.advise(error, arguments))
}

fn run_scenario(arguments: &Run, isolated: &Isolated, criteria: &Criteria, stop: &Stop) -> Result<(), Error> {
    let mut checked = fmus::scenario(arguments.scenario.as_deref(), &arguments.set)?;
    for given in arguments.train_track.iter().chain(&arguments.bridge) {
        std::fs::File::open(given).map_err(|e| Error::Input(format!("{}: {e}", given.display())))?;
    }
    let maps = arguments.map.iter().map(|path| Map::load(path)).collect::<Result<Vec<_>, _>>()?;
    maps_fit(&arguments.bridge, &arguments.map)?;
    if arguments.train_track.is_some() && checked.scenario.time.step.given().is_none() {
        return Err(Error::Input("a step is chosen for our train and track: with --train-track give time.step".into()));
    }
    let folder = Folder::claim(&arguments.output, stop)?;
    let map = |k: usize| if maps.len() > 1 { maps.get(k) } else { maps.first() };
    let given: Vec<Given> = arguments.bridge.iter().enumerate().map(|(k, path)| Given { path, map: map(k) }).collect();
    let (choice, ready) = auto::choose(&mut checked, &given, isolated)?;
    let provenance = Provenance::new(arguments, Some(&checked))?;
    let place = Temporary::new("ttb-run-").map_err(Error::io(Path::new("temporary folder")))?;
    let mut built = Vec::new();
    let train_track = match &arguments.train_track {
        Some(path) => path.clone(),
        None => fmus::train_track(&checked, place.path()).inspect(|path| built.push(path.clone()))?,
    };
    let mut bridges = arguments.bridge.clone();
    let mut known = facts::of_track(&checked);
    if bridges.is_empty() {
        let ready = ready.map_or_else(|| fmus::prepared_bridge(&checked), Ok)?;
        checked.warnings.extend(ready.remarks().iter().cloned());
        known = facts::of_prepared(&checked, &ready);
        bridges.push(fmus::bridge(&ready, &checked, place.path()).inspect(|path| built.push(path.clone()))?);
    }
    let bridges: Vec<Given> = bridges.iter().enumerate().map(|(k, path)| Given { path, map: map(k) }).collect();
    let (begin, told) = (Instant::now(), checked.warnings.len());
    let at = arguments.scenario.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
    let job = Job::new(&checked, choice, provenance);
    let output = Output::new(&job, folder, arguments, built).with(resolved(&checked, at), &maps);
    let judged = Judged { criteria, facts: known, checked: Some(&checked) };
    let done = trusting(
        |trusted| connect(&train_track, &bridges, &checked, isolated, trusted),
        |connected| {
            warn(&connected.warnings[told..]);
            run_connected(&job, connected, &output, &judged, arguments, stop, begin)
        },
    );
    output.close(done)
}

/// What a run is judged by.
struct Judged<'a> {
    criteria: &'a Criteria,
    facts: Facts,
    checked: Option<&'a Checked>,
}

fn warn(warnings: &[String]) {
    warnings.iter().for_each(|warning| note!("ttb: warning: {warning}"));
}

fn run_system(
    path: &Path,
    arguments: &Run,
    isolated: &Isolated,
    criteria: &Criteria,
    stop: &Stop,
) -> Result<(), Error> {
    if !arguments.set.set.is_empty() {
        return Err(Error::Input("--set changes a scenario; an .ssp file has its parameters in itself".into()));
    }
    if arguments.train_track.is_some() || !arguments.bridge.is_empty() {
        return Err(Error::Input(
            "--train-track and --bridge belong to a scenario; an .ssp file names its FMUs itself".into(),
        ));
    }
    let begin = Instant::now();
    let mut opened = Opened::open(path)?;
    opened.job.provenance = Provenance::new(arguments, None)?;
    for (role, path) in &opened.inputs {
        opened.job.provenance.add(role, path, Path::new(""))?;
    }
    let folder = Folder::claim(&arguments.output, stop)?;
    let place = Temporary::new("ttb-run-").map_err(Error::io(Path::new("temporary folder")))?;
    let copies = vec![opened.resolved.write(place.path())?];
    let output = Output::new(&opened.job, folder, arguments, copies);
    let judged = Judged { criteria, facts: Facts::default(), checked: None };
    let done = trusting(
        |trusted| opened.connect(isolated, trusted),
        |connected| {
            warn(&connected.warnings);
            run_connected(&opened.job, connected, &output, &judged, arguments, stop, begin)
        },
    );
    output.close(done)
}

/// From initialization to the summary.
fn run_connected(
    job: &Job,
    connected: &mut Connected,
    output: &Output,
    judged: &Judged,
    arguments: &Run,
    stop: &Stop,
    begin: Instant,
) -> Result<(), Error> {
    stop.gently();
    let axis = job.case.axis();
    let [results, iterations] = ["results.csv", "iterations.csv"].map(|name| output.folder().join(name));
    let mut results = ResultsCsv::new(Rows::of(&results), &results.display().to_string(), job.case.every)
        .with(&job.case.columns, job.case.csv);
    let mut iterations =
        IterationsCsv::new(Rows::of(&iterations), &iterations.display().to_string()).with(job.case.csv);
    let ours = judged.checked.filter(|_| arguments.bridge.is_empty());
    let mut log = Log::new(job, Watch::of(ours));
    let bar = progress_bar(axis.steps(), arguments.quiet);
    let mut tell = |n| bar.set_position(n);
    let mut progress = Progress::new(&mut tell, stop.flag());
    let clock = || begin.elapsed().as_secs_f64();
    let deck = log.watch.supports();
    let kept = |column: &Column| job.case.keeps(column);
    let wanted = |column: &Column| kept(column) || deck.contains(column);
    let plan = Plan { axis, wanted: &wanted, clock: &clock };
    let Connected { train_track, bridge, coupling, parts, probe, rules, warnings, .. } = &mut *connected;
    let own = ours.map(|checked| &checked.bridge.structure);
    let repeats = job.case.settings.max_iterations > 1;
    let (name, groups) = (train_track.name().to_string(), bridge.ranges());
    let mut look = |found: &Probe| {
        probe.clone_from(found);
        let told = match own {
            Some(structure) => judge_own(found, &name, structure, parts, repeats)?,
            None => judge(found, &name, parts, *rules, repeats)?,
        };
        warn(&told);
        warnings.extend(told);
        Ok(())
    };
    let mut coupled = Coupled::new(train_track, bridge, coupling);
    if !arguments.no_probe {
        coupled = coupled.probed(groups, &mut look);
    }
    let ended = drive(
        &mut coupled,
        &plan,
        &mut [
            &mut Opening(output),
            &mut log.counted,
            &mut iterations,
            &mut Only::new(&mut results, &kept),
            &mut Only::new(&mut log.peaks, &kept),
            &mut log.plot,
            &mut log.watch,
            &mut log.timed,
            &mut progress,
        ],
    );
    // What is written from here on goes to the folder that was current at the beginning.
    ttb_fmi::guard::put_back();
    log.ended = clock();
    log.reached = progress.reached;
    bar.finish_and_clear();
    let outcome = match ended {
        Ok(Ended::Complete) => Ok(()),
        Ok(Ended::Stopped) => stop.asked().map_or(Ok(()), |signal| Err(Error::Interrupted(signal))),
        Err(error) => Err(error.into()),
    };
    if matches!(outcome, Err(Error::NoReturn(_))) || !output.is_begun() {
        return outcome;
    }
    finish(job, log, outcome, connected, output, judged, arguments.quiet)
}

/// What was seen of a run.
struct Log {
    counted: Iterations,
    peaks: Peaks,
    plot: Plot,
    watch: Watch,
    timed: Timed,
    reached: f64,
    /// Seconds from the begin of the command to the end of the run.
    ended: f64,
}

impl Log {
    fn new(job: &Job, watch: Watch) -> Self {
        let (counted, peaks, timed) = (Iterations::default(), Peaks::between(job.case.peaks), Timed::default());
        Self { counted, peaks, plot: Plot::new(job.scene.clone()), watch, timed, reached: 0.0, ended: 0.0 }
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
    mut log: Log,
    outcome: Result<(), Error>,
    connected: &Connected,
    output: &Output,
    judged: &Judged,
    quiet: bool,
) -> Result<(), Error> {
    let outcome = outcome.and(log.plot.draw(output.folder(), &job.case.title));
    let report = connected.coupling.report();
    let doubts = Doubts::of(job, &log.peaks, report);
    let outcome = outcome.and_then(|()| doubts.verdict());
    // Neither half a run nor one that blew up is judged.
    let outcome = outcome.and_then(|()| {
        let mut histories = std::mem::take(&mut log.watch).histories(judged.checked, &job.scene);
        connected.place(&mut histories);
        let about = About { hash: &job.hash(), title: &job.case.title, step: job.case.step, checked: judged.checked };
        write_assessment(output.folder(), &about, &histories, judged.criteria, &judged.facts)
    });
    let noticed = not_finite(&log.peaks).into_iter().chain(returned(report)).chain(doubts.warnings);
    let noticed = noticed.chain(unbelievable(&log.peaks, &job.scale));
    let noticed: Vec<String> = noticed.collect();
    warn(&noticed);
    let shown = Shown {
        reached: log.reached,
        seconds: log.seconds(),
        iterations: log.counted,
        coupling: Some(CouplingReport::new(&connected.coupling, &connected.probe)),
        warnings: connected.warnings.iter().cloned().chain(noticed).collect(),
        peaks: Some(&log.peaks),
    };
    let summary = Summary::new(job, Some(&outcome), &shown);
    let written = output.end(&summary);
    // Of a run without a step the error says all there is.
    if !quiet && shown.iterations.steps > 0 {
        summary.print(output.folder());
    }
    outcome.and(written)
}
