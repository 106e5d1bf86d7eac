//! Bridge FMUs of other programs for the page: what runs them, and files that were dropped on it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use ttb_fmi::temporary::Temporary;
use ttb_web::Fault;
use ttb_web::session::{Masters, Over};

use crate::commands::sweep::over_fmu::Bridges;
use crate::error::Error;

/// Runs the FMUs of plans, each in a process of its own. They are coupled once with the first run, so that what does not fit is
/// told with the plan.
pub fn masters() -> Masters {
    Box::new(|expanded| {
        let open = || {
            let bridges = Bridges::open(&expanded.plan, Path::new(""), None, &[])?;
            let bridges = bridges.ok_or_else(|| Error::Input("the plan has no FMU".into()))?;
            if let Some(first) = expanded.plan.runs().first() {
                bridges.fit(&expanded.source.of_run(&expanded.plan, first).map_err(Error::Scenario)?)?;
            }
            Ok::<Over, Error>(Box::new(bridges))
        };
        open().map_err(|error| error.to_string())
    })
}

/// FMUs that were dropped on the page, by their paths, until others replace them or the program ends.
#[derive(Default)]
pub struct Dropped(Mutex<BTreeMap<PathBuf, Temporary>>);

impl Dropped {
    /// Keeps a file, of which `body` has a line with its name, a line with the path of the one that it replaces, which may be
    /// empty, and the bytes: JSON with its path.
    pub fn keep(&self, body: &[u8]) -> Vec<u8> {
        let mut parts = body.splitn(3, |byte| *byte == b'\n');
        let mut part = || parts.next().unwrap_or_default();
        let [name, replaced] = [part(), part()].map(String::from_utf8_lossy);
        let kept = self.kept(&name, Path::new(&*replaced), part());
        kept.map_or_else(
            |fault| serde_json::to_vec(&fault),
            |path| serde_json::to_vec(&serde_json::json!({ "path": path })),
        )
        .unwrap_or_default()
    }

    fn kept(&self, name: &str, replaced: &Path, bytes: &[u8]) -> Result<PathBuf, Fault> {
        let file = Path::new(name).file_name().filter(|file| Path::new(file).extension().is_some());
        let file = file.ok_or_else(|| Fault::new("the FMU must have a name, such as deck.fmu"))?;
        let failed = |error: std::io::Error| Fault::new(format!("the temporary folder: {error}"));
        let folder = Temporary::new("ttb-ui-").map_err(failed)?;
        let path = folder.path().join(file);
        fs::write(&path, bytes).map_err(failed)?;
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // Only what was dropped here is removed.
        all.remove(replaced);
        all.insert(path.clone(), folder);
        Ok(path)
    }
}
