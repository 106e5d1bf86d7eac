//! The FMU archive. The same contents give the same bytes, and no other program ever sees an incomplete file.

use crate::about::About;
use crate::date::Date;
use crate::documentation::documentation;
use crate::xml::{XmlError, xml};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use ttb_contract::Interface;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// Folder of this machine's shared library below `binaries/` (FMI 2.0, section 2.3).
pub const PLATFORM: &str = if cfg!(target_os = "macos") {
    "darwin64"
} else if cfg!(windows) {
    "win64"
} else {
    "linux64"
};
/// Extension of a shared library on this machine.
pub const LIBRARY_EXTENSION: &str = if cfg!(target_os = "macos") {
    "dylib"
} else if cfg!(windows) {
    "dll"
} else {
    "so"
};

/// What goes into an FMU.
pub struct Contents<'a> {
    /// The variables of the FMU.
    pub interface: &'a Interface,
    /// Name, purpose and default experiment of the FMU.
    pub about: &'a About<'a>,
    /// The shared library, whatever it is called; inside it becomes `binaries/<platform>/<modelIdentifier>.so`.
    pub binary: &'a Path,
    /// A folder whose files become `resources/…`.
    pub resources: Option<&'a Path>,
    /// File name and text of each licence, below `documentation/licenses/`.
    pub licenses: &'a [(&'a str, &'a str)],
}

/// Why an FMU was not written.
#[derive(Debug, thiserror::Error)]
pub enum PackError {
    /// The interface cannot be described.
    #[error(transparent)]
    Xml(#[from] XmlError),
    /// A file cannot be read.
    #[error("{} cannot be read: {source}", path.display())]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The FMU cannot be written.
    #[error("{} cannot be written: {source}", path.display())]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
}

/// Writes the FMU to `path`. A file of that name is replaced by one renaming.
///
/// # Errors
/// An interface that FMI cannot express, a file that cannot be read, an archive that cannot be written.
pub fn pack(contents: &Contents, path: &Path) -> Result<(), PackError> {
    let failed = |source| PackError::Write { path: path.to_path_buf(), source };
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
    let temporary = builder.prefix(".").suffix(".fmu.part").tempfile_in(folder).map_err(failed)?;

    fill(contents, temporary.as_file(), path)?;
    temporary.persist(path).map_err(|e| failed(e.error))?;
    Ok(())
}

/// Writes the entries in the order that importers expect: the description first.
fn fill(contents: &Contents, file: &File, path: &Path) -> Result<(), PackError> {
    let mut archive =
        Archive { zip: ZipWriter::new(BufWriter::new(file)).set_auto_large_file(), date: contents.about.date, path };
    if let Err(error) = archive.entries(contents) {
        // Dropped half-way it would try to finish the archive, and print that it cannot.
        std::mem::forget(archive.zip);
        return Err(error);
    }
    let failed = |source| PackError::Write { path: path.to_path_buf(), source };
    let mut buffered = archive.zip.finish().map_err(|e| failed(e.into()))?;
    buffered.flush().map_err(failed)
}

struct Archive<'a, W: Write + io::Seek> {
    zip: ZipWriter<W>,
    date: Option<Date>,
    path: &'a Path,
}

impl<W: Write + io::Seek> Archive<'_, W> {
    fn failed(&self, source: io::Error) -> PackError {
        PackError::Write { path: self.path.to_path_buf(), source }
    }

    fn entries(&mut self, contents: &Contents) -> Result<(), PackError> {
        let identifier = contents.about.model_identifier;
        self.text("modelDescription.xml", &xml(contents.interface, contents.about)?)?;
        self.file(&format!("binaries/{PLATFORM}/{identifier}.{LIBRARY_EXTENSION}"), contents.binary)?;
        self.text("documentation/index.html", &documentation(contents.interface, contents.about))?;
        for (name, text) in contents.licenses {
            self.text(&format!("documentation/licenses/{name}"), text)?;
        }
        contents.resources.map_or(Ok(()), |resources| self.folder("resources", resources))
    }

    /// Opens an entry. Without a date it gets the first that archives know, 1980, so that the same contents are the same bytes.
    fn entry(&mut self, name: &str) -> Result<(), PackError> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(3)) // a run packs its FMUs anew: speed before the last per cent
            .last_modified_time(self.date.map_or_else(DateTime::default, Date::of_entry))
            .unix_permissions(0o644);
        self.zip.start_file(name, options).map_err(|e| self.failed(e.into()))
    }

    fn text(&mut self, name: &str, text: &str) -> Result<(), PackError> {
        self.entry(name)?;
        self.zip.write_all(text.as_bytes()).map_err(|e| self.failed(e))
    }

    fn file(&mut self, name: &str, from: &Path) -> Result<(), PackError> {
        let unreadable = |source| PackError::Read { path: from.to_path_buf(), source };
        let mut file = File::open(from).map_err(unreadable)?;
        self.entry(name)?;
        io::copy(&mut file, &mut self.zip).map_err(|e| self.failed(e)).map(drop)
    }

    fn folder(&mut self, name: &str, from: &Path) -> Result<(), PackError> {
        let unreadable = |source| PackError::Read { path: from.to_path_buf(), source };
        let listed: io::Result<Vec<_>> =
            fs::read_dir(from).map_err(unreadable)?.map(|entry| entry.map(|e| e.path())).collect();
        let mut paths = listed.map_err(unreadable)?;
        paths.sort(); // directory order differs from machine to machine
        for path in paths {
            let file_name = path.file_name().unwrap_or_default().to_string_lossy();
            let inner = format!("{name}/{file_name}");
            if path.is_dir() { self.folder(&inner, &path)? } else { self.file(&inner, &path)? }
        }
        Ok(())
    }
}
