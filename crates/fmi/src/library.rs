//! Shared libraries of FMUs: found and loaded, and never unloaded.
//!
//! Nobody can know what a foreign library has left behind when its last instance is freed: a thread, a timer, a handler for
//! the end of the program. Unloading it would take away the code under them, and the process with it, when all results are
//! there: FMUs that left a thread, an interval timer or an exit handler each ended a finished run with a signal. So a library
//! stays until the process ends.

use crate::{guard, platform};
use std::path::{Path, PathBuf};

pub use crate::platform::Library;

/// Why a shared library cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum LibraryError {
    /// No binary for this machine.
    #[error("has no {wanted}; it has binaries for: {found}")]
    NoBinary {
        /// Path of the library inside the FMU.
        wanted: String,
        /// Folders below `binaries/`.
        found: String,
    },
    /// The system's loader does not accept it.
    #[error("{} cannot be loaded: {message}{}", path.display(), hint(message))]
    Load {
        /// The library.
        path: PathBuf,
        /// What the loader says.
        message: String,
    },
    /// A function that co-simulation needs.
    #[error("the library has no function {symbol}, which FMI {version} co-simulation needs")]
    MissingSymbol {
        /// Name of the function.
        symbol: &'static str,
        /// Version of FMI.
        version: &'static str,
    },
    /// Another FMI version than the description's.
    #[error("the library implements FMI {found:?}, not {wanted}")]
    Version {
        /// What the library says.
        found: String,
        /// Version of FMI in the description.
        wanted: &'static str,
    },
    /// Any of these, in the process of an isolated FMU.
    #[error("{0}")]
    Isolated(String),
}

/// The library of an FMU built with PythonFMU takes its Python from the process.
fn hint(message: &str) -> &'static str {
    if message.contains("undefined symbol: _Py") || message.contains("undefined symbol: Py") {
        "; it wants Python's library in the program: --preload libpython3.11.so.1.0 (of the version it was built for)"
    } else {
        ""
    }
}

/// Loads a library for good. A symbol that is nowhere shows here, not in the middle of a run.
///
/// # Errors
/// The loader does not find or accept it.
pub fn open(path: &Path) -> Result<Library, LibraryError> {
    open_with(path).map(|(library, _)| library)
}

/// As [`open`]; also the libraries that it needs, that lie beside it, and that the loader does not look for there.
///
/// # Errors
/// As [`open`].
pub fn open_with(path: &Path) -> Result<(Library, Vec<String>), LibraryError> {
    let mut beside = Vec::new();
    let opened = open_beside(path, &mut beside);
    opened.map(|library| (library, beside)).map_err(|message| LibraryError::Load { path: path.to_path_buf(), message })
}

/// Loads a library; where it needs another one that is found nowhere and lies beside it, that one first. The loader knows
/// those that are loaded by their SONAME.
fn open_beside(path: &Path, beside: &mut Vec<String>) -> Result<Library, String> {
    loop {
        let message = match open_whole(path) {
            Ok(library) => return Ok(library),
            Err(message) => message,
        };
        let missing = message.split_once(": cannot open shared object file").map(|(name, _)| name.to_string());
        let Some(name) = missing.filter(|name| !name.contains('/') && path.with_file_name(name).is_file()) else {
            return Err(message);
        };
        if beside.contains(&name) {
            return Err(format!(
                "{message}; {name} lies beside it, where the loader does not look, and has no SONAME by which the loader \
                 would know it: link it with -Wl,-soname,{name}, or the library that needs it with -Wl,-rpath,'$ORIGIN'"
            ));
        }
        beside.push(name.clone());
        // Dropping it would unload it.
        std::mem::forget(open_beside(&path.with_file_name(&name), beside)?);
    }
}

/// Loads a library whose file is whole. Its constructors run: they are foreign code.
fn open_whole(path: &Path) -> Result<Library, String> {
    if let Some(damage) = platform::image::damage(path) {
        return Err(damage);
    }
    let mut opened = None;
    let back = guard::call(|| opened = Some(platform::open_library(path, false)));
    guard::put_back();
    match (back, opened) {
        (Some(()), Some(opened)) => opened,
        _ => Err(guard::ended().unwrap_or_else(|| "it does not come back".into())),
    }
}

/// Loads a library so that others find its symbols, for FMUs that expect them in the program.
///
/// # Errors
/// The loader does not find or accept it.
pub fn preload(name: &Path) -> Result<(), LibraryError> {
    let opened = match platform::image::damage(name) {
        Some(damage) => Err(damage),
        None => platform::open_library(name, true),
    };
    // Dropping it would unload it.
    opened.map(std::mem::forget).map_err(|message| LibraryError::Load { path: name.to_path_buf(), message })
}

/// Where a library lies in an unpacked FMU; `wanted` is its path inside.
///
/// # Errors
/// It has none.
pub fn find(folder: &Path, wanted: String) -> Result<PathBuf, LibraryError> {
    let path = folder.join(&wanted);
    if path.is_file() {
        return Ok(path);
    }
    let names = |folder: &Path| {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        let mut names: Vec<String> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names.join(", ")
    };
    // The folder may be there, and the library in it have another name than the description says.
    let there = path.parent().map(names).filter(|names| !names.is_empty());
    let there = there.map(|names| format!("; for this one: {names}")).unwrap_or_default();
    Err(LibraryError::NoBinary { wanted, found: platforms(folder) + &there })
}

/// Platforms an unpacked FMU has binaries for.
pub fn platforms(folder: &Path) -> String {
    let entries = std::fs::read_dir(folder.join("binaries")).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries.map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    if names.is_empty() { "no platform at all".into() } else { names.join(", ") }
}
