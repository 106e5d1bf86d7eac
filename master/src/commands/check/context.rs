//! What a check works with: the FMU, and where it reports. An FMU may close files that are not its own, and open others in
//! their place: a file is opened anew for every finding, and looked at before a call is noted in it.

use std::cell::RefCell;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use ttb_fmi::description::ModelDescription;
use ttb_fmi::platform::{identity, write_at_begin};

use super::finding::Finding;

/// What a check works with.
pub struct Context {
    /// The unpacked FMU.
    pub folder: PathBuf,
    /// Its description.
    pub description: ModelDescription,
    /// Where findings go, a line each.
    pub report: PathBuf,
    /// Where the call at hand is noted.
    pub stage: PathBuf,
}

impl Context {
    /// Notes a finding at once: the process may not live to the end.
    pub fn find(&self, finding: Finding) {
        if let Ok(line) = serde_json::to_string(&finding) {
            let _ = self.write(&line);
        }
    }

    /// Adds a line to the report.
    pub fn write(&self, line: &str) -> std::io::Result<()> {
        OpenOptions::new().append(true).create(true).open(&self.report)?.write_all(format!("{line}\n").as_bytes())
    }

    /// A listener that notes which call is about to be made.
    pub fn announce(&self) -> impl Fn(&str) + 'static {
        let path = self.stage.clone();
        let kept = RefCell::new(Kept::open(&path));
        move |stage| {
            let mut kept = kept.borrow_mut();
            if !kept.as_ref().is_some_and(Kept::is_there) {
                // What has become of the descriptor is not ours to close.
                std::mem::forget(kept.take());
                *kept = Kept::open(&path);
            }
            // A fixed width overwrites what was longer; a lost note is no reason to stop.
            if let Some(Kept { file, .. }) = &*kept {
                let _ = write_at_begin(file, format!("{stage:<200}").as_bytes());
            }
        }
    }
}

/// An open file, and which it is.
struct Kept {
    file: File,
    identity: (u64, u64),
}

impl Kept {
    fn open(path: &Path) -> Option<Self> {
        let file = OpenOptions::new().write(true).create(true).truncate(false).open(path).ok()?;
        let identity = identity(&file).ok()?;
        Some(Self { file, identity })
    }

    /// Whether it is still that one.
    fn is_there(&self) -> bool {
        identity(&self.file).is_ok_and(|now| now == self.identity)
    }
}
