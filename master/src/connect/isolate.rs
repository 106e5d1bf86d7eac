//! `--isolate`: which FMUs get a process of their own, and what is said to users of those that have none.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use ttb_fmi::isolate::{AVAILABLE, Isolation};
use ttb_fmi::{Fmu, FmuError};

use super::preload;
use crate::cli::{Isolate, Run};
use crate::error::Error;

/// How long a call may take if nothing else is said, s.
pub const TIMEOUT: f64 = 60.0;

/// EBADF.
const BAD_DESCRIPTOR: i32 = 9;

/// Decides where an FMU runs.
#[derive(Default)]
pub struct Isolated {
    /// The train–track FMU's process.
    pub train_track: Option<Isolation>,
    /// The bridge FMU's process.
    pub bridge: Option<Isolation>,
}

impl Isolated {
    /// As the arguments say.
    pub fn new(arguments: &Run) -> Result<Self, Error> {
        let given = arguments.given();
        let [train_track, bridge] = match arguments.isolate {
            None => return Ok(Self::default()),
            Some(Isolate::Given) if given == [false; 2] => {
                let text = "--isolate without value means the FMUs given by --bridge and --train-track, and there is none; \
                            for those that are built here say --isolate=bridge, train-track or both";
                return Err(Error::Input(text.into()));
            }
            Some(Isolate::Given) => given,
            Some(Isolate::TrainTrack) => [true, false],
            Some(Isolate::Bridge) => [false, true],
            Some(Isolate::Both) => [true; 2],
        };
        let Run { timeout, preload, .. } = arguments;
        Self::of([train_track, bridge], *timeout, preload)
    }

    /// The train–track FMU and the bridge FMUs, each in a process of its own or not, with the longest time of a call, s, and
    /// libraries that are loaded first.
    ///
    /// # Errors
    /// There are no such processes on this system; the time is none.
    pub fn of([train_track, bridge]: [bool; 2], timeout: Option<f64>, preload: &[PathBuf]) -> Result<Self, Error> {
        if !AVAILABLE {
            return Err(Error::Input("an FMU can be isolated on Linux and Windows only".into()));
        }
        let seconds = timeout.unwrap_or(TIMEOUT);
        let timeout = Duration::try_from_secs_f64(seconds).ok().filter(|timeout| !timeout.is_zero());
        let timeout = timeout.ok_or_else(|| Error::Input(format!("--timeout must be more than 0 s, not {seconds}")))?;
        let program = std::env::current_exe().map_err(Error::io(Path::new("the path of this program")))?;
        let listener = Arc::new(|name: &str, line: &str| note!("{name}: {line}"));
        let mut host = vec!["host".into()];
        host.extend(preload::passed_on(preload));
        let isolation = Isolation { program, arguments: host, timeout, listener };
        let wanted = |is: bool| is.then(|| isolation.clone());
        Ok(Self { train_track: wanted(train_track), bridge: wanted(bridge) })
    }

    /// Adds to a failure of a given FMU that runs in this process what would have kept it apart.
    pub fn advise(&self, error: Error, arguments: &Run) -> Error {
        let [train_track, bridge] = arguments.given();
        let exposed = train_track && self.train_track.is_none() || bridge && self.bridge.is_none();
        // Nobody but foreign code in this process closes files that are written.
        let error = match error {
            Error::Io { path, source } if exposed && source.raw_os_error() == Some(BAD_DESCRIPTOR) => {
                Error::Fmu(format!("{}: {source}: an FMU has closed a file that was not its own", path.display()))
            }
            other => other,
        };
        match error {
            Error::Fmu(text) if AVAILABLE && exposed => Error::Fmu(format!(
                "{text}\nA given FMU runs in this process and can end it: --isolate runs it in one of its own."
            )),
            other => other,
        }
    }
}

/// Opens an FMU for this process or one of its own.
pub fn open(path: &Path, isolation: Option<&Isolation>) -> Result<Fmu, FmuError> {
    match isolation {
        Some(isolation) => ttb_fmi2::import::open_isolated(path, isolation),
        None => ttb_fmi2::import::open(path),
    }
}
