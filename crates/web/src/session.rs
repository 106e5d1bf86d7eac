//! A request that was resolved, with what was prepared for it.

use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use ttb_campaign::coupled::{Master, Source};
use ttb_campaign::expand::{self, Expanded};
use ttb_campaign::limits::Limits;
use ttb_campaign::runner::Kept;
use ttb_campaign::{Compute, Computed, Record, Run, Runner, compute};
use ttb_scenario::spec::Profile;

use crate::fault::Fault;
use crate::request::{Asked, SCENARIO};
use crate::room::Room;

/// Version that decides results.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A master over the FMUs of a plan.
pub type Over = Box<dyn Master + Send>;
/// Makes one, as the program can: problems with FMUs and maps are told at once, a line each.
pub type Masters = Box<dyn Fn(&Expanded) -> Result<Over, String> + Send + Sync>;

/// What a thread leaves that ended by a panic.
type Died = Box<dyn std::any::Any + Send>;

/// A request that was resolved.
pub struct Session {
    /// What it was made of.
    pub asked: Asked,
    /// Plan, scenario, facts.
    pub expanded: Expanded,
    master: Option<Over>,
    kept: Kept,
}

impl Session {
    /// Of a request; `folder` is where its scenario looks for files, `masters` runs FMUs, if anybody can.
    ///
    /// # Errors
    /// All problems of scenario, request and FMU; what has no room.
    pub fn new(asked: Asked, folder: &Path, room: &Room, masters: Option<&Masters>) -> Result<Self, Fault> {
        if asked.bridge.is_some() && masters.is_none() {
            return Err(Fault::new(
                "a browser cannot run the machine code that an FMU holds; the page of `ttb ui` can",
            ));
        }
        let source =
            Source { text: asked.scenario.clone(), folder: folder.into(), name: SCENARIO.into(), settings: Vec::new() };
        room.scenario(&source.checked().map_err(|problems| Fault::of(&problems))?)?;
        let limits = Limits { texts: asked.limits.texts()? };
        limits.criteria()?;
        let expanded = expand::of_source(&asked.request(), source, SCENARIO.into(), asked.bridges()?, VERSION, limits)?;
        room.plan(&expanded)?;
        let masters = masters.filter(|_| !expanded.plan.bridges.is_empty());
        let master = masters.map(|make| make(&expanded)).transpose().map_err(Fault::new)?;
        Ok(Self { asked, expanded, master, kept: Kept::default() })
    }

    /// What computes its runs.
    ///
    /// # Errors
    /// The criteria that come with the program cannot be read.
    pub fn runner(&self) -> Result<Runner<'_>, Fault> {
        let runner = Runner::with(&self.expanded, self.kept.clone())?;
        Ok(match &self.master {
            Some(master) => runner.over(&**master),
            None => runner,
        })
    }

    /// Whether its FMUs are still those that it was made with.
    fn is_current(&self) -> bool {
        self.expanded.plan.bridges.iter().all(|bridge| bridge.file(Path::new("")).is_ok())
    }

    /// Whether the scenario's own rail is smooth.
    pub fn own_is_smooth(&self) -> bool {
        matches!(self.expanded.checked.train_track.irregularity, Profile::None)
    }

    /// Computes runs with a number of threads: a record each, in their order; of a run that was stopped none.
    ///
    /// # Errors
    /// As [`Self::runner`].
    pub fn compute(&self, runs: &[Run], threads: usize, stop: &AtomicBool) -> Result<Vec<Record>, Fault> {
        let runner = self.runner()?;
        let parts = compute::parts(&runner, runs, runner.batch(runs.len(), threads.max(1)));
        let next = AtomicUsize::new(0);
        let work = || {
            let mut mine = Vec::new();
            while let at = next.fetch_add(1, Ordering::Relaxed)
                && let Some(part) = parts.get(at)
            {
                mine.push((at, runner.compute(part, stop)));
            }
            mine
        };
        let mut computed = std::thread::scope(|scope| {
            let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
            let own = work();
            others.into_iter().try_fold(own, |mut all, other| {
                all.extend(other.join()?);
                Ok(all)
            })
        })
        .map_err(|_: Died| Fault::new("a run ended the thread that computed it: this is an error of the program"))?;
        computed.sort_by_key(|(at, _)| *at);
        let done = |computed| match computed {
            Computed::Done(record) => Some(Record::finite(record)),
            Computed::Stopped => None,
        };
        Ok(computed.into_iter().flat_map(|(_, part)| part).filter_map(done).collect())
    }
}

/// Sessions that are kept, the last used first.
#[derive(Default)]
pub struct Sessions(Mutex<Vec<Arc<Session>>>);

/// So many are kept.
const KEPT: usize = 3;

impl Sessions {
    /// The session of a request, made if it is not there.
    ///
    /// # Errors
    /// As [`Session::new`].
    pub fn of(
        &self,
        asked: Asked,
        folder: &Path,
        room: &Room,
        masters: Option<&Masters>,
    ) -> Result<Arc<Session>, Fault> {
        if let Some(known) = self.known(&asked) {
            return Ok(known);
        }
        // Made without the lock, so that other requests go on; what two make at the same time is the same.
        let new = Arc::new(Session::new(asked, folder, room, masters)?);
        if let Some(known) = self.known(&new.asked) {
            return Ok(known);
        }
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.truncate(KEPT - 1);
        kept.insert(0, Arc::clone(&new));
        Ok(new)
    }

    fn known(&self, asked: &Asked) -> Option<Arc<Session>> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let at = {
            kept.retain(|session| session.asked != *asked || session.is_current());
            kept.iter().position(|session| session.asked == *asked)?
        };
        kept[..=at].rotate_right(1);
        kept.first().cloned()
    }
}
