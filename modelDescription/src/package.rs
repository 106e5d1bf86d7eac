//! The FMU archive. The same contents give the same bytes.

use crate::about::About;
use crate::date::Date;
use crate::documentation::documentation;
use crate::xml::{XmlError, xml};
use std::fs::{self, File};
use std::io::{self, BufWriter, Cursor, Write};
use std::path::{Path, PathBuf};
use ttb_contract::Interface;
use zip::result::ZipResult;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, System, ZipArchive, ZipWriter};

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

/// The shared libraries of an FMU, which lie in it as `binaries/<platform>/<modelIdentifier>.<extension>`.
#[derive(Clone, Copy, Debug)]
pub enum Libraries<'a> {
    /// The one for this machine, a file of any name.
    File(&'a Path),
    /// The one for this machine, in memory.
    Bytes(&'a [u8]),
    /// Those for any number of platforms: an archive where each has the name that it gets in the FMU. They are copied as they
    /// are compressed; those of other model identifiers are passed over.
    Archive(&'a [u8]),
}

/// What goes into an FMU.
pub struct Contents<'a> {
    /// The variables of the FMU.
    pub interface: &'a Interface,
    /// Name, purpose and default experiment of the FMU.
    pub about: &'a About<'a>,
    /// The shared libraries.
    pub libraries: Libraries<'a>,
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
    /// The archive of libraries has none of this FMU.
    #[error("no shared library of {identifier} is at hand")]
    NoLibrary {
        /// The FMU's model identifier.
        identifier: String,
    },
    /// A file cannot be read.
    #[error("{} cannot be read: {source}", path.display())]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The FMU cannot be written.
    #[error(transparent)]
    Write(#[from] io::Error),
}

/// Writes the FMU.
///
/// # Errors
/// An interface that FMI cannot express, a file that cannot be read, an archive that cannot be written.
pub fn pack(contents: &Contents, to: impl Write + io::Seek) -> Result<(), PackError> {
    let zip = ZipWriter::new(BufWriter::new(to)).set_auto_large_file();
    let mut archive = Archive { zip, date: contents.about.date };
    if let Err(error) = archive.entries(contents) {
        // Dropped half-way it would try to finish the archive, and print that it cannot.
        std::mem::forget(archive.zip);
        return Err(error);
    }
    Ok(archive.zip.finish().map_err(io::Error::from)?.flush()?)
}

struct Archive<W: Write + io::Seek> {
    zip: ZipWriter<W>,
    date: Option<Date>,
}

impl<W: Write + io::Seek> Archive<W> {
    /// Writes the entries in the order that importers expect: the description first.
    fn entries(&mut self, contents: &Contents) -> Result<(), PackError> {
        let identifier = contents.about.model_identifier;
        self.text("modelDescription.xml", &xml(contents.interface, contents.about)?)?;
        self.libraries(identifier, contents.libraries)?;
        self.text("documentation/index.html", &documentation(contents.interface, contents.about))?;
        for (name, text) in contents.licenses {
            self.text(&format!("documentation/licenses/{name}"), text)?;
        }
        contents.resources.map_or(Ok(()), |resources| self.folder("resources", resources))
    }

    fn libraries(&mut self, identifier: &str, libraries: Libraries) -> Result<(), PackError> {
        let name = format!("binaries/{PLATFORM}/{identifier}.{LIBRARY_EXTENSION}");
        match libraries {
            Libraries::File(path) => self.file(&name, path),
            Libraries::Bytes(bytes) => self.bytes(&name, bytes),
            Libraries::Archive(archive) => self
                .copy(identifier, archive)
                .map_err(io::Error::from)?
                .then_some(())
                .ok_or_else(|| PackError::NoLibrary { identifier: identifier.into() }),
        }
    }

    /// Copies what an archive has for a model identifier; whether it has anything.
    fn copy(&mut self, identifier: &str, archive: &[u8]) -> ZipResult<bool> {
        let mut archive = ZipArchive::new(Cursor::new(archive))?;
        let mut any = false;
        for i in 0..archive.len() {
            let entry = archive.by_index_raw(i)?;
            if Path::new(entry.name()?.as_ref()).file_stem().is_some_and(|stem| stem == identifier) {
                self.zip.raw_copy_file_touch(entry, self.time(), Some(0o644))?;
                any = true;
            }
        }
        Ok(any)
    }

    /// Date of the entries. Without one they get the first that archives know, 1980, so that the same contents are the same bytes.
    fn time(&self) -> DateTime {
        self.date.map_or_else(DateTime::default, Date::of_entry)
    }

    /// Opens an entry.
    fn entry(&mut self, name: &str) -> Result<(), PackError> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(3)) // a run packs its FMUs anew: speed before the last per cent
            .last_modified_time(self.time())
            .system(System::Unix) // on every system, so that the same contents are the same bytes
            .unix_permissions(0o644);
        Ok(self.zip.start_file(name, options).map_err(io::Error::from)?)
    }

    fn text(&mut self, name: &str, text: &str) -> Result<(), PackError> {
        self.bytes(name, text.as_bytes())
    }

    fn bytes(&mut self, name: &str, bytes: &[u8]) -> Result<(), PackError> {
        self.entry(name)?;
        Ok(self.zip.write_all(bytes)?)
    }

    fn file(&mut self, name: &str, from: &Path) -> Result<(), PackError> {
        let unreadable = |source| PackError::Read { path: from.to_path_buf(), source };
        let mut file = File::open(from).map_err(unreadable)?;
        self.entry(name)?;
        io::copy(&mut file, &mut self.zip)?;
        Ok(())
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
