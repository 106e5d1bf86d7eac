//! The other side of a check's process: makes it, reports into a file.

use std::path::Path;

use ttb_fmi::guard;
use ttb_fmi::platform::process::end_with_starter;
use ttb_fmi2::import::read_description;

use super::context::Context;
use super::finding::Finding;
use super::{derivatives, instances, life, process, run, states, steps};
use crate::error::Error;

/// A check.
pub struct Check {
    /// Its name.
    pub name: &'static str,
    /// Whether the others make no sense if it finds an error.
    pub vital: bool,
    work: fn(&Context) -> Result<(), Finding>,
}

const fn check(name: &'static str, vital: bool, work: fn(&Context) -> Result<(), Finding>) -> Check {
    Check { name, vital, work }
}

/// All of them, in their order.
pub const CHECKS: &[Check] = &[
    check("symbols", true, life::symbols),
    check("life", true, life::life),
    check("guid", false, life::guid),
    check("resources", false, life::resources),
    check("free", false, life::free),
    check("run", false, run::run),
    check("steps", false, steps::steps),
    check("elsewhere", false, steps::elsewhere),
    check("roll-back", false, states::roll_back),
    check("memory", false, states::memory),
    check("serialize", false, states::serialize),
    check("derivatives", false, derivatives::derivatives),
    check("instances", false, instances::instances),
    check("reset", false, instances::reset),
];

/// A check, in its process.
pub fn work(name: &str, folder: &Path, report: &Path) -> Result<(), Error> {
    end_with_starter().map_err(Error::io(Path::new("a thread")))?;
    let check = CHECKS.iter().find(|check| check.name == name);
    let check = check.ok_or_else(|| Error::Input(format!("there is no check {name}")))?;
    let xml_path = folder.join("modelDescription.xml");
    let xml = std::fs::read(&xml_path).map_err(Error::io(&xml_path))?;
    let description = read_description(&xml).map_err(|e| Error::Fmu(e.to_string()))?;
    let context = Context {
        folder: folder.to_path_buf(),
        description,
        report: report.to_path_buf(),
        stage: report.with_extension("stage"),
    };
    guard::keep();
    if let Err(finding) = (check.work)(&context) {
        context.find(finding);
    }
    let changed = guard::put_back();
    if !changed.is_empty() {
        let what = "it changes what belongs to the whole process";
        context.find(Finding::warning("process-state", what).seen(changed.join(", ")));
    }
    context.write(process::DONE).map_err(Error::io(report))
}
