//! Files that are being written under a name of their own, so that an end of the program at once can remove them.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Ending of a file that is being written.
pub const PART: &str = ".part";

static PARTS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn parts() -> MutexGuard<'static, Vec<PathBuf>> {
    PARTS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The part of a file, known until it is dropped.
pub struct Part(PathBuf);

impl Part {
    /// Of a file with this path. Once the program has begun to end this does not come back.
    pub fn of(path: &Path) -> Self {
        let mut name = path.as_os_str().to_os_string();
        name.push(PART);
        let part = PathBuf::from(name);
        parts().push(part.clone());
        Self(part)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        parts().retain(|part| *part != self.0);
    }
}

/// Removes all parts, and lets none be begun as long as the result is held: for the end of the program.
#[must_use]
pub fn abandon() -> impl Sized {
    let parts = parts();
    for part in parts.iter() {
        let _ = fs::remove_file(part);
    }
    parts
}
