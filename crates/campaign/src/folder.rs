//! A campaign's folder: its plan, its journal, and what is made of them.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use crate::compute::Compute;
use crate::error::Error;
use crate::foreign::{Foreign, short};
use crate::journal::Journal;
use crate::plan::{self, Plan, Run};
use crate::pool::{self, Progress};
use crate::refine::{Key, Known, Refined, Refinement};
use crate::shard::Shard;
use crate::status::Status;
use crate::{foreign, hdf5, tables};

/// A folder with its plan.
#[derive(Clone, Debug)]
pub struct Folder {
    path: PathBuf,
    /// The plan.
    pub plan: Plan,
    /// The runs' files.
    pub journal: Journal,
}

impl Folder {
    /// Takes a folder for a plan. Runs that are there and belong to the plan stay; a folder with runs of another scenario, or of
    /// another version of the program, is refused.
    ///
    /// # Errors
    /// As said, with the two ways out; the folder cannot be written.
    pub fn open(path: &Path, plan: Plan) -> Result<Self, Error> {
        let file = path.join(plan::FILE);
        if let Ok(text) = fs::read_to_string(&file) {
            let known = Plan::parse(&text, &file.display().to_string())?;
            let differs = if known.scenario_sha256 != plan.scenario_sha256 {
                let (before, now) = (short(&known.scenario_sha256), short(&plan.scenario_sha256));
                Some(format!("another scenario, or this one before it was changed (SHA-256 {before}…, now {now}…)"))
            } else if !known.bridges.iter().map(Foreign::decides).eq(plan.bridges.iter().map(Foreign::decides)) {
                let told = |plan: &Plan| match plan.bridges.as_slice() {
                    [] => "the scenario's own".to_string(),
                    all => all.iter().map(Foreign::title).collect::<Vec<_>>().join(", "),
                };
                Some(format!("another bridge or map (bridge before: {}; now: {})", told(&known), told(&plan)))
            } else if known.version != plan.version {
                Some(format!("version {} of the program; this is {}", known.version, plan.version))
            } else {
                None
            };
            if let Some(what) = differs {
                return Err(Error::Input(format!(
                    "{}: it holds runs of {what}. Either give another folder with -o, or discard the runs there with --restart",
                    path.display()
                )));
            }
        }
        let journal = Journal::open(path)?;
        let part = path.join(format!(".{}.{}", plan::FILE, std::process::id()));
        fs::write(&part, plan.text()?).and_then(|()| fs::rename(&part, &file)).map_err(Error::io(&file))?;
        Ok(Self { path: path.into(), plan, journal })
    }

    /// Opens a folder as it is.
    ///
    /// # Errors
    /// It has no plan.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let file = path.join(plan::FILE);
        let text = fs::read_to_string(&file).map_err(|error| {
            let path = path.display();
            Error::Input(format!("{path}: it must be the folder of a sweep or campaign, with a plan.json: {error}"))
        })?;
        let plan = Plan::parse(&text, &file.display().to_string())?;
        Ok(Self { path: path.into(), plan, journal: Journal::open(path)? })
    }

    /// Removes plan, journal and everything made of them.
    ///
    /// # Errors
    /// Something cannot be removed.
    pub fn discard(path: &Path) -> Result<(), Error> {
        let gone = |path: PathBuf, done: std::io::Result<()>| match done {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(Error::io(&path)(error)),
            _ => Ok(()),
        };
        for name in ["journal", "history"] {
            let folder = path.join(name);
            let done = fs::remove_dir_all(&folder);
            gone(folder, done)?;
        }
        for name in [plan::FILE, hdf5::FILE, tables::TIMINGS, foreign::NOTICED].into_iter().chain(tables::TABLES) {
            let file = path.join(name);
            let done = fs::remove_file(&file);
            gone(file, done)?;
        }
        Ok(())
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Computes what is missing of a shard, then, of the whole, the refinement. `tell` hears how many runs are to be done and
    /// what has been done. Whether `stop` was set is for the caller to look at.
    ///
    /// # Errors
    /// The journal cannot be read or written.
    pub fn compute(
        &self,
        with: &dyn Compute,
        workers: usize,
        shard: Shard,
        refined: &Refined,
        stop: &AtomicBool,
        tell: &(dyn Fn(usize, Progress) + Sync),
    ) -> Result<Progress, Error> {
        let runs = self.plan.runs();
        let mut pending = Status::of(&runs, &self.journal)?.pending(&runs, shard);
        with.arrange(&mut pending);
        let count = pending.len();
        let mut done = pool::compute(with, &pending, workers, &self.journal, stop, &|p| tell(count, p))?;
        if !self.plan.refine || shard != Shard::WHOLE {
            return Ok(done);
        }
        let mut known = self.known(&runs, &refined.keys)?;
        let refinement = self.refinement(refined);
        while !stop.load(Ordering::Relaxed) {
            let mut pending = self.next(&refinement, &mut known)?;
            with.arrange(&mut pending);
            if pending.is_empty() {
                break;
            }
            let (so_far, count) = (done, done.done + pending.len());
            let add = |p: Progress| Progress {
                done: so_far.done + p.done,
                failed: so_far.failed + p.failed,
                bytes: so_far.bytes + p.bytes,
            };
            done = add(pool::compute(with, &pending, workers, &self.journal, stop, &|p| tell(count, add(p)))?);
        }
        Ok(done)
    }

    /// All runs in their order, refined ones at the end; and those of them that are not there.
    ///
    /// # Errors
    /// The journal cannot be read.
    pub fn runs(&self, refined: &Refined) -> Result<Vec<Run>, Error> {
        let mut runs = self.plan.runs();
        if self.plan.refine {
            let mut known = self.known(&runs, &refined.keys)?;
            let refinement = self.refinement(refined);
            self.next(&refinement, &mut known)?;
            runs.extend(refinement.runs(&known));
        }
        Ok(runs)
    }

    /// Makes all tables of what is there.
    ///
    /// # Errors
    /// The journal cannot be read, a table cannot be written.
    pub fn tables(&self, runs: &[Run], own_is_smooth: bool) -> Result<(), Error> {
        tables::write(&self.path, &self.plan, runs, &self.journal, own_is_smooth)?;
        hdf5::write(&self.path, &self.plan, runs, &self.journal, own_is_smooth)
    }

    fn refinement<'a>(&'a self, refined: &'a Refined) -> Refinement<'a> {
        Refinement { plan: &self.plan, keys: &refined.keys, resonances: &refined.resonances }
    }

    fn known(&self, runs: &[Run], keys: &[Key]) -> Result<Known, Error> {
        let mut known = Known::default();
        for run in runs {
            if let Some(record) = self.journal.read(&run.id)? {
                known.add(&record, keys);
            }
        }
        Ok(known)
    }

    /// Goes through the search with what the journal knows; the runs that it asks for next.
    fn next(&self, refinement: &Refinement, known: &mut Known) -> Result<Vec<Run>, Error> {
        loop {
            let asked = refinement.runs(known);
            let unknown: Vec<Run> = asked.into_iter().filter(|run| !known.has(&run.id)).collect();
            let mut missing = Vec::new();
            for run in &unknown {
                match self.journal.read(&run.id)? {
                    Some(record) => known.add(&record, refinement.keys),
                    None => missing.push(run.clone()),
                }
            }
            if missing.len() == unknown.len() {
                return Ok(missing);
            }
        }
    }
}
