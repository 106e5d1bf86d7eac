//! Paths from one folder to another, which need not be there yet.

use std::path::{Path, PathBuf};

/// A path from a folder that need not be there yet.
pub fn relative(path: &Path, from: &Path) -> String {
    let (Some(path_), Some(from)) = (real(path), real(from)) else { return path.display().to_string() };
    let shared = path_.components().zip(from.components()).take_while(|(a, b)| a == b).count();
    let up = from.components().skip(shared).map(|_| std::path::Component::ParentDir);
    let relative: PathBuf = up.chain(path_.components().skip(shared)).collect();
    relative.display().to_string()
}

/// What [`relative`] was made of.
pub fn joined(folder: &Path, relative: &str) -> PathBuf {
    let mut path = real(folder).unwrap_or_else(|| folder.into());
    for part in Path::new(relative).components() {
        match part {
            // Without links the folder above is the one before, whether the folder is there yet or not.
            std::path::Component::ParentDir => drop(path.pop()),
            part => path.push(part),
        }
    }
    path
}

/// The path without links, as far as it is there.
pub fn real(path: &Path) -> Option<PathBuf> {
    let path = std::path::absolute(path).ok()?;
    path.canonicalize().ok().or_else(|| Some(real(path.parent()?)?.join(path.file_name()?)))
}
