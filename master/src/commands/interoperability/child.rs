//! A command of this program in a process of its own, which is ended when it takes too long.

use std::ffi::OsStr;
use std::fs::File;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::error::Error;

/// Time between two looks.
const LOOK: Duration = Duration::from_millis(20);

/// How a command ended.
pub struct Ended {
    /// Its exit code; none if it was ended.
    pub code: Option<i32>,
    /// Its standard output.
    pub printed: String,
    /// Its standard error.
    pub complained: String,
}

/// Runs it; what it prints goes through files in `place`, so that nobody waits for a full pipe.
pub fn run(arguments: &[&OsStr], place: &Path, limit: Duration) -> Result<Ended, Error> {
    let program = std::env::current_exe().map_err(Error::io(Path::new("the path of this program")))?;
    let paths = ["stdout", "stderr"].map(|name| place.join(name));
    let create = |path: &Path| File::create(path).map_err(Error::io(path));
    let mut command = Command::new(program);
    command.args(arguments).stdin(Stdio::null()).stdout(create(&paths[0])?).stderr(create(&paths[1])?);
    let failed = || Error::io(Path::new("a process of this program"));
    let mut child = command.spawn().map_err(failed())?;
    let begin = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().map_err(failed())? {
            break Some(status);
        }
        if begin.elapsed() > limit {
            // It has taken too long; whether it ends by itself at this moment does not matter.
            let _ = child.kill();
            child.wait().map_err(failed())?;
            break None;
        }
        std::thread::sleep(LOOK);
    };
    let [printed, complained] = paths
        .map(|path| std::fs::read(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).unwrap_or_default());
    // A process that a signal has ended has no code, and counts as a failure.
    Ok(Ended { code: status.map(|status| status.code().unwrap_or(-1)), printed, complained })
}
