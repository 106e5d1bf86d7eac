//! What a check works with: the FMU, and where it reports.

use std::cell::RefCell;
use std::fs::File;
use std::io::Write;
use std::os::unix::fs::FileExt;
use std::path::PathBuf;

use ttb_fmi::description::ModelDescription;

use super::finding::Finding;

/// What a check works with.
pub struct Context {
    /// The unpacked FMU.
    pub folder: PathBuf,
    /// Its description.
    pub description: ModelDescription,
    /// Where findings go, a line each.
    pub report: RefCell<File>,
    /// Where the call at hand is noted.
    pub stage: PathBuf,
}

impl Context {
    /// Notes a finding at once: the process may not live to the end.
    pub fn find(&self, finding: Finding) {
        if let Ok(line) = serde_json::to_string(&finding) {
            let _ = writeln!(self.report.borrow_mut(), "{line}");
        }
    }

    /// A listener that notes which call is about to be made.
    pub fn announce(&self) -> impl Fn(&str) + 'static {
        let file = File::create(&self.stage);
        move |stage| {
            // A fixed width overwrites what was longer; a lost note is no reason to stop.
            if let Ok(file) = &file {
                let _ = file.write_at(format!("{stage:<200}").as_bytes(), 0);
            }
        }
    }
}
