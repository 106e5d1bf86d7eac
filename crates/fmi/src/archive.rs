//! Unpacking an FMU without trusting it.

use crate::temporary::Temporary;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use zip::ZipArchive;

/// Why an archive was not unpacked.
#[derive(Debug, thiserror::Error)]
pub enum UnpackError {
    /// The file cannot be read.
    #[error("cannot be opened: {0}")]
    Open(io::Error),
    /// It is no zip archive, or a damaged one.
    #[error("is no readable FMU (zip archive): {0}")]
    Archive(#[from] zip::result::ZipError),
    /// An entry that would land outside the folder, or is no plain file.
    #[error("refused: entry {entry:?} {why}")]
    Refused {
        /// Its name.
        entry: String,
        /// What is wrong with it.
        why: &'static str,
    },
    /// Too much: a zip bomb or a mistake.
    #[error("refused: unpacked it is larger than {limit} bytes, from {packed} bytes of archive")]
    TooLarge {
        /// What is allowed.
        limit: u64,
        /// Size of the archive.
        packed: u64,
    },
    /// Too many entries.
    #[error("refused: {0} entries")]
    TooMany(usize),
    /// The temporary folder.
    #[error("cannot be unpacked to {}: {source}", path.display())]
    Write {
        /// Where.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

/// What is still taken for an archive made in good faith.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Bytes of all files together.
    pub bytes: u64,
    /// Bytes that are allowed whatever the ratio.
    pub harmless_bytes: u64,
    /// Unpacked bytes per byte of the archive, beyond that.
    pub ratio: u64,
    /// Entries.
    pub entries: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self { bytes: 8 << 30, harmless_bytes: 256 << 20, ratio: 200, entries: 100_000 }
    }
}

/// Unpacks into a fresh temporary folder, which goes when the result is dropped.
///
/// # Errors
/// Not an archive, damaged, dangerous, or no room.
pub fn unpack(fmu: &Path) -> Result<Temporary, UnpackError> {
    unpack_within(fmu, Limits::default())
}

/// As [`unpack`], with other limits.
///
/// # Errors
/// As [`unpack`].
pub fn unpack_within(fmu: &Path, limits: Limits) -> Result<Temporary, UnpackError> {
    let file = File::open(fmu).map_err(UnpackError::Open)?;
    let packed = file.metadata().map_err(UnpackError::Open)?.len();
    let mut archive = ZipArchive::new(io::BufReader::new(file))?;
    if archive.len() > limits.entries {
        return Err(UnpackError::TooMany(archive.len()));
    }
    let limit = limits.bytes.min(limits.harmless_bytes.max(packed.saturating_mul(limits.ratio)));
    let unwritable = |path: &Path, source| UnpackError::Write { path: path.to_path_buf(), source };
    let folder = Temporary::new("ttb-fmu-").map_err(|e| unwritable(&std::env::temp_dir(), e))?;
    let mut room = limit;
    for i in 0..archive.len() {
        let mut entry = archive.by_index(i)?;
        let name = entry.name()?.into_owned();
        let refused = |why| UnpackError::Refused { entry: name.clone(), why };
        if entry.is_symlink() {
            return Err(refused("is a symbolic link"));
        }
        let to = folder.path().join(safe_path(&name).map_err(refused)?);
        if entry.is_dir() || name.ends_with('\\') {
            fs::create_dir_all(&to).map_err(|e| unwritable(&to, e))?;
            continue;
        }
        let parent = to.parent().unwrap_or(folder.path());
        fs::create_dir_all(parent).map_err(|e| unwritable(parent, e))?;
        let mut out = match File::create_new(&to) {
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => return Err(refused("appears twice")),
            created => created.map_err(|e| unwritable(&to, e))?,
        };
        // Counted while copying: the sizes in the archive's headers may be wrong.
        let written =
            io::copy(&mut (&mut entry).take(room.saturating_add(1)), &mut out).map_err(|e| unwritable(&to, e))?;
        room = room.checked_sub(written).ok_or(UnpackError::TooLarge { limit, packed })?;
    }
    Ok(folder)
}

/// A relative path without anything clever in it. Backslashes, which some tools write, are taken for slashes.
fn safe_path(name: &str) -> Result<PathBuf, &'static str> {
    let name = name.replace('\\', "/");
    if name.starts_with('/') || name.as_bytes().get(1) == Some(&b':') {
        return Err("has an absolute path");
    }
    if name.contains('\0') {
        return Err("has a zero byte in its name");
    }
    let mut path = PathBuf::new();
    for part in name.split('/').filter(|part| !part.is_empty() && *part != ".") {
        if part == ".." {
            return Err("leads out of the archive with \"..\"");
        }
        // Of a folder in the archive it makes another drive, or a stream beside a file.
        if cfg!(windows) && part.contains(':') {
            return Err("has a name with a colon, which no file of Windows may have");
        }
        path.push(part);
    }
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;
    use zip::write::{SimpleFileOptions, ZipWriter};

    fn archive(fill: impl FnOnce(&mut ZipWriter<File>)) -> tempfile::NamedTempFile {
        let file = tempfile::NamedTempFile::new().unwrap();
        let mut zip = ZipWriter::new(file.reopen().unwrap());
        fill(&mut zip);
        zip.finish().unwrap();
        file
    }
    fn with(name: &str, bytes: &[u8]) -> tempfile::NamedTempFile {
        archive(|zip| {
            zip.start_file(name, SimpleFileOptions::default()).unwrap();
            zip.write_all(bytes).unwrap();
        })
    }

    #[test]
    fn plain_entries_arrive_whatever_the_slash() {
        for name in ["resources/a.txt", "./resources//a.txt", "resources\\a.txt"] {
            let folder = unpack(with(name, b"hello").path()).unwrap();
            assert_eq!(fs::read(folder.path().join("resources/a.txt")).unwrap(), b"hello", "{name}");
        }
    }

    #[test]
    fn entries_that_leave_the_folder_are_refused() {
        for (name, why) in [
            ("../evil", "leads out"),
            ("a/../../evil", "leads out"),
            ("..\\evil", "leads out"),
            ("/etc/evil", "absolute"),
            ("\\evil", "absolute"),
            ("C:\\evil", "absolute"),
        ] {
            let error = unpack(with(name, b"x").path()).unwrap_err().to_string();
            assert!(error.contains(why), "{name}: {error}");
        }
    }

    #[test]
    fn a_symbolic_link_is_refused() {
        let file = archive(|zip| zip.add_symlink("resources", "/etc", SimpleFileOptions::default()).unwrap());
        assert!(unpack(file.path()).unwrap_err().to_string().contains("symbolic link"));
    }

    #[test]
    fn a_bomb_is_refused_by_its_ratio_and_by_its_size() {
        let file = with("resources/zeros", &vec![0; 1 << 20]);
        let by_ratio = Limits { harmless_bytes: 1 << 10, ..Limits::default() };
        assert!(matches!(unpack_within(file.path(), by_ratio), Err(UnpackError::TooLarge { .. })));
        let by_size = Limits { bytes: (1 << 20) - 1, ..Limits::default() };
        assert!(matches!(unpack_within(file.path(), by_size), Err(UnpackError::TooLarge { limit: 1048575, .. })));
        let just = Limits { bytes: 1 << 20, ..Limits::default() };
        assert!(unpack_within(file.path(), just).is_ok());
        assert!(matches!(unpack_within(file.path(), Limits { entries: 0, ..just }), Err(UnpackError::TooMany(1))));
    }

    #[test]
    fn what_is_no_archive_says_so() {
        let file = tempfile::NamedTempFile::new().unwrap();
        fs::write(file.path(), "not a zip").unwrap();
        assert!(unpack(file.path()).unwrap_err().to_string().contains("no readable FMU"));
        assert!(matches!(unpack(Path::new("/nowhere.fmu")), Err(UnpackError::Open(_))));
    }
}
