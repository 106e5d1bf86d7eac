//! A request that was resolved, with what was prepared for it.

use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

use ttb_campaign::coupled::Source;
use ttb_campaign::expand::{self, Expanded};
use ttb_campaign::limits::Limits;
use ttb_campaign::runner::Kept;
use ttb_campaign::{Compute, Computed, Record, Run, Runner};
use ttb_scenario::spec::Profile;

use crate::fault::Fault;
use crate::request::{Asked, SCENARIO};
use crate::room::Room;

/// Version that decides results.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A request that was resolved.
pub struct Session {
    /// What it was made of.
    pub asked: Asked,
    /// Plan, scenario, facts.
    pub expanded: Expanded,
    kept: Kept,
}

impl Session {
    /// Of a request; `folder` is where its scenario looks for files.
    ///
    /// # Errors
    /// All problems of scenario and request; what has no room.
    pub fn new(asked: Asked, folder: &Path, room: &Room) -> Result<Self, Fault> {
        let source =
            Source { text: asked.scenario.clone(), folder: folder.into(), name: SCENARIO.into(), settings: Vec::new() };
        room.scenario(&source.checked().map_err(|problems| Fault::of(&problems))?)?;
        let limits = Limits { texts: asked.limits.texts()? };
        limits.criteria()?;
        let expanded = expand::of_source(&asked.request(), source, SCENARIO.into(), VERSION, limits)?;
        room.plan(&expanded)?;
        Ok(Self { asked, expanded, kept: Kept::default() })
    }

    /// What computes its runs.
    ///
    /// # Errors
    /// The criteria that come with the program cannot be read.
    pub fn runner(&self) -> Result<Runner<'_>, Fault> {
        Ok(Runner::with(&self.expanded, self.kept.clone())?)
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
        let part = runs.len().div_ceil(threads.max(1)).max(1);
        let of_part = |runs: &[Run]| runner.compute(runs, stop);
        let computed: Vec<Computed> = if threads > 1 {
            std::thread::scope(|scope| {
                let parts: Vec<_> = runs.chunks(part).map(|runs| scope.spawn(move || of_part(runs))).collect();
                parts.into_iter().map(|part| part.join()).collect::<Result<Vec<_>, _>>()
            })
            .map_err(|_| Fault::new("a run ended the thread that computed it: this is an error of the program"))?
            .concat()
        } else {
            of_part(runs)
        };
        let done = |computed| match computed {
            Computed::Done(record) => Some(Record::finite(record)),
            Computed::Stopped => None,
        };
        Ok(computed.into_iter().filter_map(done).collect())
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
    pub fn of(&self, asked: Asked, folder: &Path, room: &Room) -> Result<Arc<Session>, Fault> {
        if let Some(known) = self.known(&asked) {
            return Ok(known);
        }
        // Made without the lock, so that other requests go on; what two make at the same time is the same.
        let new = Arc::new(Session::new(asked, folder, room)?);
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
        let at = kept.iter().position(|session| session.asked == *asked)?;
        kept[..=at].rotate_right(1);
        kept.first().cloned()
    }
}
