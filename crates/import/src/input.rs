//! Where a file's bytes come from.

use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file on disk or in memory. Matrices are read in two passes, so it is opened more than once.
#[derive(Clone, Debug)]
pub struct Input {
    name: String,
    source: Source,
    wants: Option<char>,
}

#[derive(Clone, Debug)]
enum Source {
    Path(PathBuf),
    Bytes(Arc<[u8]>),
}

impl Input {
    /// A file on disk.
    pub fn path(path: &Path) -> Self {
        Self { name: path.display().to_string(), source: Source::Path(path.to_owned()), wants: None }
    }

    /// Bytes in memory, named for messages; the name's extension counts as a file's does.
    pub fn bytes(name: &str, bytes: impl Into<Arc<[u8]>>) -> Self {
        Self { name: name.to_owned(), source: Source::Bytes(bytes.into()), wants: None }
    }

    /// Where a file holds several matrices: the one whose name begins with this letter.
    #[must_use]
    pub fn of(self, letter: char) -> Self {
        Self { wants: Some(letter), ..self }
    }

    pub(crate) fn wants(&self) -> Option<char> {
        self.wants
    }

    /// Name for messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Extension in lower case, or "".
    pub(crate) fn extension(&self) -> String {
        Path::new(&self.name).extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default()
    }

    pub(crate) fn open(&self) -> io::Result<Box<dyn Read>> {
        Ok(match &self.source {
            Source::Path(path) => Box::new(File::open(path)?),
            Source::Bytes(bytes) => Box::new(Cursor::new(bytes.clone())),
        })
    }

    /// Length in bytes; a folder, a pipe or a device is refused, as it cannot be read twice.
    pub(crate) fn length(&self) -> io::Result<u64> {
        match &self.source {
            Source::Path(path) => {
                let facts = std::fs::metadata(path)?;
                if facts.is_file() { Ok(facts.len()) } else { Err(io::Error::other("not a regular file")) }
            }
            Source::Bytes(bytes) => Ok(bytes.len() as u64),
        }
    }
}
