//! One small file a run, written whole, then renamed: nothing else is the truth.
//!
//! A file that lost its end, because the machine lost its power, is no file: its run is computed again.

use std::collections::HashSet;
use std::fs::{self, File};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::record::{FORMAT, Record, Records};

/// Name of the folder.
const FOLDER: &str = "journal";
const ENDING: &str = ".json";
/// What every whole file ends with.
const LAST: &[u8] = b"}\n";

/// The folder of the runs' files.
#[derive(Clone, Debug)]
pub struct Journal {
    folder: PathBuf,
}

impl Journal {
    /// In the folder of a campaign; made if it is not there.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn open(campaign: &Path) -> Result<Self, Error> {
        let folder = campaign.join(FOLDER);
        fs::create_dir_all(&folder).map_err(Error::io(&folder))?;
        Ok(Self { folder })
    }

    /// Ids of the runs that are there, whole.
    ///
    /// # Errors
    /// The folder cannot be read.
    pub fn ids(&self) -> Result<HashSet<String>, Error> {
        let mut ids = HashSet::new();
        for entry in fs::read_dir(&self.folder).map_err(Error::io(&self.folder))? {
            let name = entry.map_err(Error::io(&self.folder))?.file_name();
            let id = name.to_str().and_then(|name| name.strip_suffix(ENDING)).filter(|id| !id.starts_with('.'));
            if let Some(id) = id
                && is_whole(&self.path(id))
            {
                ids.insert(id.to_string());
            }
        }
        Ok(ids)
    }

    /// A run's file; `None` if it is not there or not whole.
    ///
    /// # Errors
    /// It is there and cannot be read.
    pub fn read(&self, id: &str) -> Result<Option<Record>, Error> {
        let path = self.path(id);
        let bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(Error::io(&path)(error)),
        };
        let record: Option<Record> = serde_json::from_slice(&bytes).ok();
        Ok(record.filter(|record| record.format == FORMAT && record.run_id == id && bytes.ends_with(LAST)))
    }

    /// Writes a run's file beside its place and renames it. Who is killed in between leaves a file that nobody reads.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&self, record: &Record) -> Result<u64, Error> {
        let path = self.path(&record.run_id);
        let thread = format!("{:?}", std::thread::current().id());
        let number: String = thread.chars().filter(char::is_ascii_digit).collect();
        let part = self.folder.join(format!(".{}.{}-{number}", record.run_id, std::process::id()));
        let bytes = serde_json::to_vec(record).map_err(std::io::Error::other).map_err(Error::io(&path))?;
        let write = || {
            let mut file = File::create(&part)?;
            file.write_all(&bytes)?;
            file.write_all(b"\n")?;
            fs::rename(&part, &path)
        };
        write().map_err(|error| {
            // A disk that is full gets its room back.
            let _ = fs::remove_file(&part);
            Error::io(&path)(error)
        })?;
        Ok(bytes.len() as u64 + 1)
    }

    /// Removes a run's file, so that it is computed again.
    ///
    /// # Errors
    /// It cannot be removed.
    pub fn remove(&self, id: &str) -> Result<(), Error> {
        let path = self.path(id);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(Error::io(&path)(error)),
            _ => Ok(()),
        }
    }

    /// Removes the parts that ends by force have left. Only who has the folder alone may call it.
    pub fn clear_parts(&self) {
        let Ok(entries) = fs::read_dir(&self.folder) else { return };
        for entry in entries.flatten() {
            if entry.file_name().to_str().is_some_and(|name| name.starts_with('.')) {
                // One that stays disturbs nobody.
                let _ = fs::remove_file(entry.path());
            }
        }
    }

    fn path(&self, id: &str) -> PathBuf {
        self.folder.join(format!("{id}{ENDING}"))
    }
}

impl Records for Journal {
    fn of(&self, id: &str) -> Result<Option<Record>, Error> {
        self.read(id)
    }
}

fn is_whole(path: &Path) -> bool {
    let mut last = [0; LAST.len()];
    let read = File::open(path).and_then(|mut file| {
        file.seek(SeekFrom::End(-(LAST.len() as i64)))?;
        file.read_exact(&mut last)
    });
    read.is_ok() && last == *LAST
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_without_its_end_is_not_there() {
        let folder = tempfile::tempdir().unwrap();
        let journal = Journal::open(folder.path()).unwrap();
        let record = Record::failed("0123456789abcdef", "for the test", 0.5);
        journal.write(&record).unwrap();
        assert_eq!(journal.read(&record.run_id).unwrap().as_ref(), Some(&record));
        assert_eq!(journal.ids().unwrap().len(), 1);
        let path = journal.path(&record.run_id);
        let whole = fs::read(&path).unwrap();
        for length in [0, 1, whole.len() / 2, whole.len() - 1] {
            fs::write(&path, &whole[..length]).unwrap();
            assert_eq!(journal.read(&record.run_id).unwrap(), None, "{length} bytes");
            assert!(journal.ids().unwrap().is_empty(), "{length} bytes");
        }
        journal.remove(&record.run_id).unwrap();
        fs::write(folder.path().join("journal/.x.1-2"), "part").unwrap();
        journal.clear_parts();
        assert_eq!(fs::read_dir(folder.path().join("journal")).unwrap().count(), 0);
    }
}
