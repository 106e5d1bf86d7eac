//! `--preload`: libraries that FMUs expect in the program that loads them.

use std::ffi::OsString;
use std::path::PathBuf;

use ttb_fmi::library::preload;

use crate::error::Error;

/// Loads them for the rest of the program.
pub fn load(libraries: &[PathBuf]) -> Result<(), Error> {
    libraries.iter().try_for_each(|library| preload(library).map_err(|e| Error::Input(format!("--preload: {e}"))))
}

/// The option again, for a process that is started elsewhere.
pub fn passed_on(libraries: &[PathBuf]) -> Vec<OsString> {
    // A name without a folder is for the loader to find.
    let full = |library: &PathBuf| library.canonicalize().unwrap_or_else(|_| library.clone()).into_os_string();
    libraries.iter().flat_map(|library| [OsString::from("--preload"), full(library)]).collect()
}
