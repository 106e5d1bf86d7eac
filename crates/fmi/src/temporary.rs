//! Folders in the temporary directory that are gone when the program is, however it ends.
//!
//! ```text
//!  dropped              the owner removes its folder
//!  leave()              all that are left are removed (Ctrl-C twice, or a signal whose handler calls it)
//!  killed, crashed      the keeper removes them
//! ```
//!
//! A foreign FMU in this process may crash it, end it by `_exit`, or replace any handler of ours; then nothing that runs here
//! can be relied upon. So a second process, the *keeper*, is told every folder before it is made, and removes what is left
//! once this process is gone: by its own end it learns, not by a message. It is this same program, started with the
//! arguments given to [`keeper`], in a session of its own and deaf to requests to end. Handlers for crashes were considered
//! and rejected: FMUs install their own, and they may run on a spoiled heap; so was removing at the next start: nobody may
//! ever start again. The keeper costs 0.6 ms at the first folder (`cargo test --release -p ttb-fmi -- --nocapture keeper`)
//! and sleeps until the end; a program that names none does without it.

use crate::platform;
use std::ffi::OsString;
use std::hash::{BuildHasher, RandomState};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{ChildStdin, Command, Stdio};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

/// A folder in the temporary directory. Dropping it removes it with all that is in it.
#[derive(Debug)]
pub struct Temporary {
    path: PathBuf,
}

/// What this process has in the temporary directory, and who looks after it.
struct Register {
    folders: Vec<PathBuf>,
    keeper: Keeper,
}

enum Keeper {
    /// The program has named none, or it cannot be started.
    None,
    /// To be started at the first folder.
    Named(PathBuf, Vec<OsString>),
    /// Reads from here.
    Started(ChildStdin),
}

/// Environment variable that tells the keeper the number of the process it keeps house for.
const PARENT: &str = "TTB_KEEPER_OF";

static REGISTER: Mutex<Register> = Mutex::new(Register { folders: Vec::new(), keeper: Keeper::None });

/// A list of paths is never left half-changed by a panic.
fn register() -> MutexGuard<'static, Register> {
    REGISTER.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Temporary {
    /// A new, empty folder that only this user may enter; its name begins with `prefix`.
    ///
    /// # Errors
    /// The temporary directory does not take it.
    pub fn new(prefix: &str) -> io::Result<Self> {
        // A name that nobody can foresee: RandomState has its keys from the system.
        let number = RandomState::new().hash_one(std::process::id());
        let path = directory()?.join(format!("{prefix}{number:016x}"));
        let mut register = register();
        register.announce(&path);
        platform::create_private_folder(&path)?;
        register.folders.push(path.clone());
        Ok(Self { path })
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// The temporary directory as it is called at the first folder: foreign code may change the environment.
fn directory() -> io::Result<&'static Path> {
    static DIRECTORY: OnceLock<PathBuf> = OnceLock::new();
    let first = std::path::absolute(std::env::temp_dir())?;
    Ok(DIRECTORY.get_or_init(|| first))
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // Removed first, forgotten then: should the process end meanwhile, somebody still knows it.
        let _ = std::fs::remove_dir_all(&self.path);
        register().folders.retain(|folder| *folder != self.path);
    }
}

impl Register {
    /// Tells the keeper, starting it if need be. Without one the folder goes with the others at the end.
    fn announce(&mut self, path: &Path) {
        if let Keeper::Named(program, arguments) = &self.keeper {
            let mut command = Command::new(program);
            command.env(PARENT, std::process::id().to_string());
            command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null());
            platform::in_own_group(&mut command);
            let input = command.spawn().ok().and_then(|mut child| child.stdin.take());
            self.keeper = input.map_or(Keeper::None, Keeper::Started);
        }
        if let Keeper::Started(input) = &mut self.keeper
            && input.write_all(&[platform::bytes(path), b"\0"].concat()).is_err()
        {
            self.keeper = Keeper::None;
        }
    }
}

/// Names the keeper: the program that calls [`keep`] when it is started with these arguments. It starts with the first
/// folder.
pub fn keeper(program: PathBuf, arguments: Vec<OsString>) {
    register().keeper = Keeper::Named(program, arguments);
}

/// Removes all folders of this process; for its end.
pub(crate) fn remove_all() {
    for folder in std::mem::take(&mut register().folders) {
        let _ = std::fs::remove_dir_all(folder);
    }
}

/// The keeper's whole life: reads folders from standard input until the parent process is gone, then removes what is left.
///
/// # Errors
/// This system cannot watch another process.
pub fn keep() -> io::Result<()> {
    platform::ignore_requests_to_end();
    // The directory this was started in may be removed meanwhile.
    let _ = std::env::set_current_dir("/");
    let parent = std::env::var(PARENT).ok().and_then(|number| number.parse().ok());
    let folders = platform::read_until_parent_is_gone(parent)?;
    // Whatever lost processes of foreign code have left behind.
    #[cfg(any(target_os = "linux", windows))]
    parent.into_iter().for_each(platform::process::end_started_by);
    // An isolated FMU's process, which ends at the same moment, may still write: once more then.
    for folder in folders.split(|byte| *byte == 0).filter(|folder| !folder.is_empty()) {
        let folder = platform::path(folder);
        let gone = |_: &u32| std::fs::remove_dir_all(&folder).is_ok() || !folder.exists();
        (0..3_u32).find(gone);
    }
    Ok(())
}
