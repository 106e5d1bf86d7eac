//! The archive: deterministic, and never seen half-written.

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
#[error("{} cannot be {what}: {source}", path.display())]
pub struct PackError {
    /// Which file.
    pub path: PathBuf,
    /// Read or written.
    pub what: &'static str,
    /// What the system says.
    pub source: io::Error,
}

/// The date of an archive: as XML has it and as entries have it.
#[derive(Clone, Debug)]
pub struct Stamp {
    /// `2026-01-31T12:00:00Z`.
    pub text: String,
    /// Of every entry.
    pub entry: DateTime,
}

/// Writes the archive of a structure to `path`, replacing what was there in one stroke; `entries` are the other files by
/// their paths inside, in this order. Without a date it carries none, so that the same contents are the same bytes.
///
/// # Errors
/// A file that cannot be read or written.
pub fn pack(
    structure: &Structure,
    entries: &[(&str, Content)],
    date: Option<&Stamp>,
    path: &Path,
) -> Result<(), PackError> {
    let failed = |source| PackError { path: path.to_path_buf(), what: "written", source };
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
    let temporary = builder.prefix(".").suffix(".ssp.part").tempfile_in(folder).map_err(failed)?;
    let mut zip = ZipWriter::new(BufWriter::new(temporary.as_file())).set_auto_large_file();
    let text = write(structure, date.map(|date| date.text.as_str())).map_err(failed)?;
    let mut entry = |name: &str, content: Content| -> Result<(), PackError> {
        let method =
            if matches!(content, Content::File(_)) { CompressionMethod::Stored } else { CompressionMethod::Deflated };
        // 1980 is the first date that archives know.
        let options = SimpleFileOptions::default()
            .compression_method(method)
            .last_modified_time(date.map_or_else(DateTime::default, |date| date.entry))
            .system(System::Unix)
            .unix_permissions(0o644);
        zip.start_file(name, options).map_err(|e| failed(e.into()))?;
        match content {
            Content::Text(text) => zip.write_all(text.as_bytes()).map_err(failed),
            Content::File(from) => {
                let unreadable = |source| PackError { path: from.to_path_buf(), what: "read", source };
                let mut file = File::open(from).map_err(unreadable)?;
                io::copy(&mut file, &mut zip).map_err(failed).map(drop)
            }
        }
    };
    let written = entry(STRUCTURE, Content::Text(&text))
        .and_then(|()| entries.iter().try_for_each(|(name, content)| entry(name, *content)));
    if let Err(error) = written {
        // Dropped half-way it would try to finish the archive, and print that it cannot.
        std::mem::forget(zip);
        return Err(error);
    }
    zip.finish().map_err(|e| failed(e.into()))?.flush().map_err(failed)?;
    temporary.persist(path).map_err(|e| failed(e.error))?;
    Ok(())
}
