//! `ttb check`: is an FMU what it says, and does it keep what the standard promises?
//!
//! Archive and description are read here; whatever runs code of the FMU runs in a process of its own, one per check
//! (`worker.rs`), so that a crash or a hang is a finding and not the end. A worker reports through a file, since the FMU
//! may print.

mod context;
mod derivatives;
mod description;
mod drive;
mod finding;
mod instances;
mod life;
mod process;
mod run;
mod states;
mod steps;
mod worker;

use std::ffi::OsString;
use std::path::Path;
use std::time::Duration;

use ttb_fmi::archive::unpack;
use ttb_fmi::description::DescriptionError;
use ttb_fmi2::import::{library_path, read_description};

use crate::cli::Check;
use crate::connect::preload;
use crate::error::Error;
use finding::Finding;

/// The command; in a worker one of its checks.
pub fn check(arguments: &Check) -> Result<(), Error> {
    if let Some(check) = &arguments.worker {
        preload::load(&arguments.preload)?;
        return worker::work(check, &arguments.fmu, arguments.report.as_deref().unwrap_or(Path::new("report")));
    }
    std::fs::File::open(&arguments.fmu).map_err(|e| Error::Input(format!("{}: {e}", arguments.fmu.display())))?;
    let patience = Duration::try_from_secs_f64(arguments.timeout).ok().filter(|t| !t.is_zero());
    let patience =
        patience.ok_or_else(|| Error::Input(format!("--timeout is {}; must be positive", arguments.timeout)))?;
    let found = findings(&arguments.fmu, patience, &preload::passed_on(&arguments.preload))?;
    if arguments.json {
        let text = serde_json::to_string_pretty(&found).map_err(|e| Error::Pack(e.to_string()))?;
        say!("{text}");
    } else if found.is_empty() {
        say!("{}: no findings", arguments.fmu.display());
    } else {
        found.iter().for_each(|finding| say!("{finding}"));
    }
    // Remarks alone are no reason to fail.
    let count = found.iter().filter(|finding| finding.severity < finding::Severity::Remark).count();
    if count == 0 { Ok(()) } else { Err(Error::Findings { fmu: arguments.fmu.clone(), count }) }
}

/// All findings on a file.
fn findings(fmu: &Path, patience: Duration, preload: &[OsString]) -> Result<Vec<Finding>, Error> {
    let folder = match unpack(fmu) {
        Ok(folder) => folder,
        Err(error) => return Ok(vec![Finding::error("archive", error.to_string())]),
    };
    let xml = std::fs::read(folder.path().join("modelDescription.xml"));
    let description = match xml.as_ref().map_err(|e| e.to_string()).map(|xml| read_description(xml)) {
        Ok(Ok(description)) => description,
        Ok(Err(error)) => return Ok(vec![unreadable(&error)]),
        Err(error) => {
            return Ok(vec![
                Finding::error("no-description", "there is no modelDescription.xml at its root").seen(error),
            ]);
        }
    };
    let mut found = description::sanity(&description, &xml.unwrap_or_default());
    if let Err(error) = library_path(folder.path(), &description.co_simulation.model_identifier) {
        found.push(Finding::error("no-binary", error.to_string()));
        return Ok(found);
    }
    for check in worker::CHECKS {
        let outcome = process::run(check.name, folder.path(), patience, preload)?;
        let fresh = outcome.findings.iter().any(|finding| finding.severity == finding::Severity::Error);
        for finding in outcome.findings {
            if !found.iter().any(|other| other.same(&finding)) {
                found.push(finding);
            }
        }
        // What does not live cannot be tested further.
        if check.vital && (fresh || !outcome.finished) {
            break;
        }
    }
    found.sort_by_key(|finding| finding.severity);
    Ok(found)
}

/// A description that cannot be used.
fn unreadable(error: &DescriptionError) -> Finding {
    let name = match error {
        DescriptionError::WrongVersion { .. } => "fmi-version",
        DescriptionError::NoCoSimulation => "no-co-simulation",
        _ => "description",
    };
    Finding::error(name, format!("modelDescription.xml {error}"))
}
