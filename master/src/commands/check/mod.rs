//! `ttb check`: is an FMU what it says, and does it keep what the standard promises?
//!
//! Archive and description are read here; whatever runs code of the FMU runs in a process of its own, one per check
//! (`worker.rs`), so that a crash or a hang is a finding and not the end. A worker reports through a file, since the FMU
//! may print.

mod compare;
mod context;
mod derivatives;
mod description;
mod drive;
mod finding;
mod instances;
mod life;
mod plan;
mod process;
mod rules;
mod run;
mod states;
mod steps;
mod worker;

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
    if arguments.rules {
        rules::RULES.iter().for_each(|rule| say!("{:<20} {:<6} {}", rule.name, rule.clause, rule.asks));
        return Ok(());
    }
    let fmu = arguments.fmu.as_deref().unwrap_or(Path::new(""));
    if let Some(check) = &arguments.worker {
        preload::load(&arguments.preload)?;
        return worker::work(check, fmu, arguments.report.as_deref().unwrap_or(Path::new("report")));
    }
    let known = || std::iter::once(DESCRIPTION).chain(worker::CHECKS.iter().map(|check| check.name));
    if let Some(odd) = arguments.only.iter().find(|name| !known().any(|known| known == name.as_str())) {
        let known = known().collect::<Vec<_>>().join(", ");
        return Err(Error::Input(format!("--only {odd}: there is no such check; there are: {known}")));
    }
    std::fs::File::open(fmu).map_err(|e| Error::Input(format!("{}: {e}", fmu.display())))?;
    let patience = Duration::try_from_secs_f64(arguments.timeout).ok().filter(|t| !t.is_zero());
    let patience =
        patience.ok_or_else(|| Error::Input(format!("--timeout is {}; must be positive", arguments.timeout)))?;
    let found = findings(arguments, fmu, patience)?;
    if arguments.json {
        let text = serde_json::to_string_pretty(&found).map_err(|e| Error::Pack(e.to_string()))?;
        say!("{text}");
    } else if found.is_empty() {
        say!("{}: no findings", fmu.display());
    } else {
        found.iter().for_each(|finding| say!("{finding}"));
    }
    // Remarks alone are no reason to fail.
    let count = found.iter().filter(|finding| finding.severity < finding::Severity::Remark).count();
    if count == 0 { Ok(()) } else { Err(Error::Findings { fmu: fmu.to_path_buf(), count }) }
}

/// Name of what is looked at without running anything.
const DESCRIPTION: &str = "description";

/// The command that makes a check alone.
fn repeat(arguments: &Check, check: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+@".contains(c);
    let quoted = |path: &Path| {
        let text = path.display().to_string();
        if text.chars().all(plain) { text } else { format!("'{}'", text.replace('\'', "'\\''")) }
    };
    let preload = arguments.preload.iter().map(|library| format!(" --preload {}", quoted(library)));
    let fmu = arguments.fmu.as_deref().map(quoted).unwrap_or_default();
    format!("ttb check {fmu} --only {check}{}", preload.collect::<String>())
}

/// All findings on a file.
fn findings(arguments: &Check, fmu: &Path, patience: Duration) -> Result<Vec<Finding>, Error> {
    let wanted = |name: &str| arguments.only.is_empty() || arguments.only.iter().any(|only| only == name);
    let alone = |finding: Finding| Ok(vec![finding.complete(&repeat(arguments, DESCRIPTION))]);
    let folder = match unpack(fmu) {
        Ok(folder) => folder,
        Err(error) => return alone(Finding::error("archive", error.to_string())),
    };
    let xml = std::fs::read(folder.path().join("modelDescription.xml"));
    let description = match xml.as_ref().map_err(|e| e.to_string()).map(|xml| read_description(xml)) {
        Ok(Ok(description)) => description,
        Ok(Err(error)) => return alone(unreadable(&error)),
        Err(error) => {
            return alone(Finding::error("no-description", "there is no modelDescription.xml at its root").seen(error));
        }
    };
    let mut found = Vec::new();
    if wanted(DESCRIPTION) {
        found = description::sanity(&description, &xml.unwrap_or_default());
    }
    let binary = library_path(folder.path(), &description.co_simulation.model_identifier);
    found.extend(binary.as_ref().err().map(|error| Finding::error("no-binary", error.to_string())));
    let mut found: Vec<Finding> = found.into_iter().map(|f| f.complete(&repeat(arguments, DESCRIPTION))).collect();
    let preload = preload::passed_on(&arguments.preload);
    for check in worker::CHECKS.iter().filter(|check| binary.is_ok() && wanted(check.name)) {
        let outcome = process::run(check.name, folder.path(), patience, &preload)?;
        let fresh = outcome.findings.iter().any(|finding| finding.severity == finding::Severity::Error);
        for finding in outcome.findings {
            if !found.iter().any(|other| other.same(&finding)) {
                found.push(finding.complete(&repeat(arguments, check.name)));
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
