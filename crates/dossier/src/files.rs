//! A folder of results by the names of its files.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::PathBuf;

use ttb_scenario::{Checked, Problems};

use crate::error::Error;

/// A folder of results, wherever it is.
pub trait Files {
    /// How messages and the report call the folder.
    fn name(&self) -> String;

    /// The content of a file; `None` if it is not there.
    ///
    /// # Errors
    /// It is there and cannot be read.
    fn open(&self, file: &str) -> Result<Option<Box<dyn Read + '_>>, Error>;

    /// Whether a file is there.
    fn has(&self, file: &str) -> bool;

    /// A scenario, by its path from the folder.
    ///
    /// # Errors
    /// All its problems.
    fn scenario(&self, file: &str) -> Result<Checked, Problems>;

    /// How messages call a file.
    fn shown(&self, file: &str) -> String {
        format!("{}/{file}", self.name())
    }

    /// The text of a file; `None` if it is not there.
    ///
    /// # Errors
    /// It is there and cannot be read.
    fn text(&self, file: &str) -> Result<Option<String>, Error> {
        let Some(mut reader) = self.open(file)? else { return Ok(None) };
        let mut text = String::new();
        let read = reader.read_to_string(&mut text);
        read.map_err(|source| Error::Io { path: self.shown(file), source })?;
        Ok(Some(text))
    }
}

/// On disk.
impl Files for PathBuf {
    fn name(&self) -> String {
        self.display().to_string()
    }

    fn open(&self, file: &str) -> Result<Option<Box<dyn Read + '_>>, Error> {
        match std::fs::File::open(self.join(file)) {
            Ok(file) => Ok(Some(Box::new(file))),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(source) => Err(Error::Io { path: self.shown(file), source }),
        }
    }

    fn has(&self, file: &str) -> bool {
        self.join(file).is_file()
    }

    fn scenario(&self, file: &str) -> Result<Checked, Problems> {
        ttb_scenario::load_using(&self.join(file), &[], &ttb_trains::axles_of)
    }

    fn shown(&self, file: &str) -> String {
        self.join(file).display().to_string()
    }
}

/// In memory.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    /// How the folder is called.
    pub name: String,
    /// Folder from which its scenario names files.
    pub beside: PathBuf,
    /// Name and content of every file.
    pub files: BTreeMap<String, Vec<u8>>,
}

impl Files for Memory {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn open(&self, file: &str) -> Result<Option<Box<dyn Read + '_>>, Error> {
        Ok(self.files.get(file).map(|bytes| Box::new(bytes.as_slice()) as Box<dyn Read>))
    }

    fn has(&self, file: &str) -> bool {
        self.files.contains_key(file)
    }

    fn scenario(&self, file: &str) -> Result<Checked, Problems> {
        let text = self.files.get(file).map(|bytes| String::from_utf8_lossy(bytes)).unwrap_or_default();
        ttb_scenario::from_str_using(&text, &self.beside, &self.shown(file), &[], &ttb_trains::axles_of)
    }
}
