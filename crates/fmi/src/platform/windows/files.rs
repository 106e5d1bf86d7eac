//! Libraries, folders and files.

use super::api;
use std::fs::File;
use std::io;
use std::os::windows::fs::FileExt;
use std::os::windows::io::AsRawHandle;
use std::path::Path;

/// A loaded library; dropping it unloads it.
pub type Library = libloading::os::windows::Library;

/// Variables that name the temporary folder.
pub const TEMPORARY_VARIABLES: &[&str] = &["TEMP", "TMP"];

/// Loads a library; others that it needs are looked for beside it first. The error is what the loader says. There is no scope
/// that all libraries share: `global` changes nothing.
pub(crate) fn open_library(path: &Path, _global: bool) -> Result<Library, String> {
    // The folder of the library counts only if it is known.
    let flags = if path.is_absolute() { libloading::os::windows::LOAD_WITH_ALTERED_SEARCH_PATH } else { 0 };
    // SAFETY: loading foreign code is what an importer is for: the user chose this library and trusts it to run.
    let opened = unsafe { Library::load_with_flags(path, flags) };
    opened.map_err(|e| {
        let message = std::error::Error::source(&e).map_or_else(|| e.to_string(), ToString::to_string);
        // Windows does not say which.
        if message.contains("126") {
            format!("{message} It, or another library that it needs, is missing")
        } else {
            message
        }
    })
}

/// A new folder; the temporary folder that it lies in is this user's own.
pub(crate) fn create_private_folder(path: &Path) -> io::Result<()> {
    std::fs::create_dir(path)
}

/// Which file it is: equal for two handles of the same one.
///
/// # Errors
/// The system does not tell.
pub fn identity(file: &File) -> io::Result<(u64, u64)> {
    let mut found = api::FileInformation::default();
    // SAFETY: an open file, and a place for the answer.
    if unsafe { api::GetFileInformationByHandle(file.as_raw_handle(), &raw mut found) } == 0 {
        return Err(io::Error::last_os_error());
    }
    Ok((u64::from(found.volume), u64::from(found.index[0]) << 32 | u64::from(found.index[1])))
}

/// Writes at the beginning of a file.
///
/// # Errors
/// The system does not take it.
pub fn write_at_begin(file: &File, bytes: &[u8]) -> io::Result<usize> {
    file.seek_write(bytes, 0)
}

/// A folder under another name; a copy where links are not allowed.
///
/// # Errors
/// It can be neither linked nor copied.
pub fn link_folder(folder: &Path, name: &Path) -> io::Result<()> {
    // Wine says of links that it cannot make that it has made them.
    if std::os::windows::fs::symlink_dir(folder, name).is_ok() && name.is_dir() {
        return Ok(());
    }
    copy_folder(folder, name)
}

fn copy_folder(from: &Path, to: &Path) -> io::Result<()> {
    std::fs::create_dir(to)?;
    for entry in std::fs::read_dir(from)? {
        let entry = entry?;
        let name = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            copy_folder(&entry.path(), &name)?
        } else {
            std::fs::copy(entry.path(), name).map(drop)?
        }
    }
    Ok(())
}
