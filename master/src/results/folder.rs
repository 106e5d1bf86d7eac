//! The folder that a command writes into: its own until it ends, and never a mixture of two commands.
//!
//! ```text
//! claim    a lock, held by one process at a time (.ttb-lock, with its number); what is there stays as it is
//! begin    what an earlier command left under the names of this one's results is removed
//! drop     the lock goes; a folder that was made for a command that was refused goes, too
//! ```
//!
//! A command claims its folder first, reads and builds everything, and begins when nothing can be refused any more: a refused
//! run leaves the results of an earlier one as they were.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

use ttb_fmi::platform::identity;

use crate::error::Error;
use crate::parts::PART;
use crate::signals::Stop;

/// Name of the lock.
const LOCK: &str = ".ttb-lock";

/// A claimed folder.
pub struct Folder {
    path: PathBuf,
    /// Held as long as the file is open.
    _lock: File,
    made: bool,
}

impl Folder {
    /// Makes the folder if need be and locks it.
    ///
    /// # Errors
    /// Another process has it ([`Error::Input`], with its number); it cannot be made or written into.
    pub fn claim(path: &Path, stop: &Stop) -> Result<Self, Error> {
        stop.removes(|| {
            let made = !path.exists();
            fs::create_dir_all(path).map_err(Error::io(path))?;
            let place = path.join(LOCK);
            let lock = lock(&place).map_err(|error| match error {
                Refused::Taken(process) => Error::Input(format!(
                    "{}: {process} is writing its results here: wait for its end, or choose another folder with --output",
                    path.display()
                )),
                Refused::Io(error) => Error::Io { path: place.clone(), source: error },
            })?;
            let removed = [place].into_iter().chain(made.then(|| path.to_path_buf())).collect();
            Ok((Self { path: path.to_path_buf(), _lock: lock, made }, removed))
        })
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Removes what an earlier command left: files of these names, and parts of them; but none of `inputs`, which this
    /// command reads.
    ///
    /// # Errors
    /// A file cannot be removed.
    pub fn begin<'a>(&self, names: impl Fn(&str) -> bool, inputs: impl Iterator<Item = &'a Path>) -> Result<(), Error> {
        let inputs: Vec<PathBuf> = inputs.filter_map(|path| path.canonicalize().ok()).collect();
        for entry in fs::read_dir(&self.path).map_err(Error::io(&self.path))? {
            let path = entry.map_err(Error::io(&self.path))?.path();
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            let old = names(name.strip_suffix(PART).unwrap_or(name)) && path.is_file();
            let read = || path.canonicalize().is_ok_and(|path| inputs.contains(&path));
            if old && !read() {
                fs::remove_file(&path).map_err(Error::io(&path))?;
            }
        }
        Ok(())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // Still locked: whoever waits for this very file finds afterwards that it is gone, and makes its own.
        let _ = fs::remove_file(self.path.join(LOCK));
        if self.made {
            // Only if nothing is in it.
            let _ = fs::remove_dir(&self.path);
        }
    }
}

enum Refused {
    /// By whom, for a message.
    Taken(String),
    Io(io::Error),
}

impl From<io::Error> for Refused {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

/// Opens and locks a file that its owner removes at the end.
fn lock(place: &Path) -> Result<File, Refused> {
    loop {
        let mut file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(place)?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => {
                let mut text = String::new();
                let process = file.read_to_string(&mut text).ok().and_then(|_| text.trim().parse::<u32>().ok());
                let process = process.map_or_else(|| "another process".into(), |number| format!("process {number}"));
                return Err(Refused::Taken(process));
            }
            Err(TryLockError::Error(error)) => return Err(error.into()),
            Ok(()) => {}
        }
        // Removed between opening and locking: it locks nothing.
        let there = File::open(place).and_then(|there| identity(&there));
        if there.is_ok_and(|there| identity(&file).is_ok_and(|held| held == there)) {
            file.set_len(0)?;
            file.rewind()?;
            writeln!(file, "{}", std::process::id())?;
            return Ok(file);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_has_one_owner_and_is_left_as_it_was_found() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("a/out");
        let stop = Stop::default();
        let folder = Folder::claim(&path, &stop).unwrap();
        let refused = Folder::claim(&path, &stop).err().unwrap();
        assert!(refused.to_string().contains(&format!("process {} is writing", std::process::id())), "{refused}");
        assert_eq!(refused.code(), 2);
        drop(folder);
        assert!(!path.exists());
        let folder = Folder::claim(&path, &stop).unwrap();
        fs::write(folder.file("mine.txt"), "kept").unwrap();
        for name in ["results.csv", "summary.json.part", "Bridge.fmu"] {
            fs::write(folder.file(name), "old").unwrap();
        }
        let known = |name: &str| ["results.csv", "summary.json", "Bridge.fmu"].contains(&name);
        // The FMU that an earlier run left may be what this one is given.
        folder.begin(known, [path.join("../out/Bridge.fmu")].iter().map(PathBuf::as_path)).unwrap();
        drop(folder);
        let mut left: Vec<_> = fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        left.sort();
        assert_eq!(left, ["Bridge.fmu", "mine.txt"]);
    }
}
