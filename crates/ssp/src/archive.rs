//! The archive. The same contents give the same bytes.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, System, ZipWriter};

use crate::types::{STRUCTURE, Structure};
use crate::write::write;

/// Content of an entry of the archive.
#[derive(Clone, Copy, Debug)]
pub enum Content<'a> {
    /// A file, stored as it is: FMUs are compressed already.
    File(&'a Path),
    /// A text.
    Text(&'a str),
}

/// Why an archive was not written.
#[derive(Debug, thiserror::Error)]
pub enum PackError {
    /// A file cannot be read.
    #[error("{} cannot be read: {source}", path.display())]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The archive cannot be written.
    #[error(transparent)]
    Write(#[from] io::Error),
}

/// The date of an archive: as XML has it and as entries have it.
#[derive(Clone, Debug)]
pub struct Stamp {
    /// `2026-01-31T12:00:00Z`.
    pub text: String,
    /// Of every entry.
    pub entry: DateTime,
}

/// Writes the archive of a structure; `entries` are the other files by their paths inside, in this order. Without a date it
/// carries none, so that the same contents are the same bytes.
///
/// # Errors
/// A file that cannot be read or written.
pub fn pack(
    structure: &Structure,
    entries: &[(&str, Content)],
    date: Option<&Stamp>,
    to: impl Write + io::Seek,
) -> Result<(), PackError> {
    let mut zip = ZipWriter::new(BufWriter::new(to)).set_auto_large_file();
    let text = write(structure, date.map(|date| date.text.as_str()))?;
    let mut entry = |name: &str, content: Content| -> Result<(), PackError> {
        let method =
            if matches!(content, Content::File(_)) { CompressionMethod::Stored } else { CompressionMethod::Deflated };
        // 1980 is the first date that archives know.
        let options = SimpleFileOptions::default()
            .compression_method(method)
            .last_modified_time(date.map_or_else(DateTime::default, |date| date.entry))
            .system(System::Unix)
            .unix_permissions(0o644);
        zip.start_file(name, options).map_err(io::Error::from)?;
        match content {
            Content::Text(text) => zip.write_all(text.as_bytes())?,
            Content::File(from) => {
                let unreadable = |source| PackError::Read { path: from.to_path_buf(), source };
                let mut file = File::open(from).map_err(unreadable)?;
                io::copy(&mut file, &mut zip)?;
            }
        }
        Ok(())
    };
    let written = entry(STRUCTURE, Content::Text(&text))
        .and_then(|()| entries.iter().try_for_each(|(name, content)| entry(name, *content)));
    if let Err(error) = written {
        // Dropped half-way it would try to finish the archive, and print that it cannot.
        std::mem::forget(zip);
        return Err(error);
    }
    Ok(zip.finish().map_err(io::Error::from)?.flush()?)
}
