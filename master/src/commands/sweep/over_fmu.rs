//! Runs of a sweep over bridge FMUs of other programs: those of `ttb run --bridge FMU --map FILE --isolate`, one a worker.
//!
//! ```text
//! plan (FMUs, maps) ── Bridges::open ──► checked once ── run of a scenario ──► histories that criteria judge, remarks
//!                                                           each FMU in a process of its own: what it does ends its run alone
//! ```

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use ttb_campaign::Plan as Campaign;
use ttb_campaign::coupled::{Master, Stepped, rows};
use ttb_contract::Subsystem;
use ttb_coupling::probe::Probe;
use ttb_fmi::temporary::Temporary;
use ttb_scenario::Checked;
use ttb_session::observe::{Only, Peaks, Progress, Table};
use ttb_session::{Column, Coupled, Ended, Plan, drive};

use crate::assess::watch::Watch;
use crate::connect::connected::{Connected, Given, connect};
use crate::connect::isolate::Isolated;
use crate::connect::map::Map;
use crate::connect::probe::judge;
use crate::connect::trusting::trusting;
use crate::error::Error;
use crate::prepare::{auto, fmus};
use crate::results::belief::unbelievable;
use crate::results::coupled::{not_iterated, returned};
use crate::results::credible::Doubts;
use crate::results::job::Job;
use crate::results::peaks::not_finite;
use crate::results::provenance::Provenance;

/// The bridge FMUs of a plan, whose bytes are those of the plan.
pub struct Bridges {
    given: Vec<(PathBuf, Option<Map>)>,
    isolated: Isolated,
}

impl Bridges {
    /// Of a plan in a folder, with the longest time of a call, s, and libraries that are loaded first; `None`: the bridge is the
    /// scenario's own.
    ///
    /// # Errors
    /// FMUs that cannot be read or have changed, maps that cannot be read, a line each; FMUs cannot be isolated here.
    pub fn open(
        plan: &Campaign,
        folder: &Path,
        timeout: Option<f64>,
        preload: &[PathBuf],
    ) -> Result<Option<Self>, Error> {
        if plan.bridges.is_empty() {
            return Ok(None);
        }
        let (mut given, mut problems) = (Vec::new(), Vec::new());
        for bridge in &plan.bridges {
            let map = bridge.map.as_ref().map(|[name, text]| Map::parse(text, Path::new(name))).transpose();
            match (bridge.file(folder), map) {
                (Ok(path), Ok(map)) => given.push((path, map)),
                (file, map) => {
                    problems.extend(file.err().into_iter().chain(map.err().map(|error| error.to_string())));
                }
            }
        }
        if !problems.is_empty() {
            return Err(Error::Input(problems.join("\n")));
        }
        Ok(Some(Self { given, isolated: Isolated::of([false, true], timeout, preload)? }))
    }

    /// Couples them with the train of a scenario and lets go again: what does not fit is told before the first run.
    ///
    /// # Errors
    /// As [`connect`].
    pub fn fit(&self, checked: &Checked) -> Result<(), Error> {
        self.with_track(checked, |track| connect(track, &self.given(), checked, &self.isolated, true)).map(drop)
    }

    fn given(&self) -> Vec<Given<'_>> {
        self.given.iter().map(|(path, map)| Given { path, map: map.as_ref() }).collect()
    }

    fn with_track<T>(&self, checked: &Checked, work: impl FnOnce(&Path) -> Result<T, Error>) -> Result<T, Error> {
        let place = Temporary::new("ttb-sweep-").map_err(Error::io(Path::new("temporary folder")))?;
        work(&fmus::train_track(checked, place.path())?)
    }

    fn stepped(&self, mut checked: Checked, stop: &AtomicBool) -> Result<Option<Stepped>, Error> {
        let given = self.given();
        let (choice, _) = auto::found(&mut checked, &given, &self.isolated)?;
        let (job, told) = (Job::new(&checked, choice, Provenance::default()), checked.warnings.len());
        self.with_track(&checked, |track| {
            trusting(
                |trusted| connect(track, &given, &checked, &self.isolated, trusted),
                |connected| {
                    let noticed = connected.warnings.split_off(told);
                    coupled(&job, &checked, connected, noticed, stop)
                },
            )
        })
    }
}

impl Master for Bridges {
    fn run(&self, checked: Checked, stop: &AtomicBool) -> Result<Option<Stepped>, String> {
        self.stepped(checked, stop).map_err(|error| error.to_string())
    }
}

/// All steps of a run; `None` if it was asked to stop. `remarks` are those of the connection.
fn coupled(
    job: &Job,
    checked: &Checked,
    connected: &mut Connected,
    mut remarks: Vec<String>,
    stop: &AtomicBool,
) -> Result<Option<Stepped>, Error> {
    let kept = |column: &Column| job.case.keeps(column);
    let plan = Plan { axis: job.case.axis(), wanted: &kept, clock: &|| 0.0 };
    let Connected { train_track, bridge, coupling, parts, rules, .. } = &mut *connected;
    let (name, groups) = (train_track.name().to_string(), bridge.ranges());
    let repeats = job.case.settings.max_iterations > 1;
    let mut look = |found: &Probe| {
        remarks.extend(judge(found, &name, parts, *rules, repeats)?);
        Ok(())
    };
    let mut system = Coupled::new(train_track, bridge, coupling).probed(groups, &mut look);
    let (mut table, mut peaks, mut watch) = (Table::default(), Peaks::between(job.case.peaks), Watch::of(None));
    let mut silent = |_| ();
    let ended = drive(
        &mut system,
        &plan,
        &mut [&mut Only::new(&mut table, &rows::wanted), &mut peaks, &mut watch, &mut Progress::new(&mut silent, stop)],
    );
    if ended? == Ended::Stopped {
        return Ok(None);
    }
    let report = connected.coupling.report();
    let doubts = Doubts::of(job, &peaks, report);
    doubts.verdict()?;
    remarks.extend(not_finite(&peaks).into_iter().chain(returned(report)).chain(not_iterated(report)));
    remarks.extend(doubts.warnings.into_iter().chain(unbelievable(&peaks, &job.scale)));
    let mut histories = watch.histories(Some(checked), &job.scene);
    connected.place(&mut histories);
    Ok(Some(Stepped { histories, history: rows::kept(table, checked), step: job.case.step, remarks }))
}
