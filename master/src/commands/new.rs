//! `ttb new`: the first files of a project.

use std::path::Path;

use ttb_generate::Refused;
use ttb_generate::start::{File, SCENARIO, Start, beams, fmu, matrices};

use crate::cli::{Begin, New};
use crate::error::Error;

/// Spans of a viaduct that names none, and of anything else, m.
const VIADUCT: [f64; 3] = [24.0; 3];
const SPAN: [f64; 1] = [24.0];

/// The command.
pub fn new(arguments: &New) -> Result<(), Error> {
    let files = files(arguments).map_err(|refused| Error::Input(refused.to_string()))?;
    let folder = &arguments.folder;
    if let Some((name, _)) = files.iter().find(|(name, _)| folder.join(name).exists()) {
        return Err(Error::Input(format!(
            "{}: it is there already; choose another folder",
            folder.join(name).display()
        )));
    }
    // What cannot run is not written: a train that does not exist, a mass that no bridge has.
    std::fs::create_dir_all(folder).map_err(Error::io(folder))?;
    for (name, text) in &files {
        let path = folder.join(name);
        std::fs::write(&path, text).map_err(Error::io(&path))?;
    }
    let scenario = folder.join(SCENARIO);
    if let Err(problems) = ttb_scenario::load(&scenario) {
        remove(folder, &files);
        return Err(Error::Scenario(problems));
    }
    say!("{}", files.iter().map(|(name, _)| folder.join(name).display().to_string()).collect::<Vec<_>>().join(" "));
    say!("next: ttb run {} -o {}", scenario.display(), folder.join("results").display());
    Ok(())
}

fn files(arguments: &New) -> Result<Vec<File>, Refused> {
    let New { what, spans, continuous, n0, mass, train, speed, .. } = arguments;
    let usual = if *what == Begin::Viaduct { VIADUCT.to_vec() } else { SPAN.to_vec() };
    let spans = if spans.is_empty() { usual } else { spans.clone() };
    let start = Start { spans, continuous: *continuous, n0: *n0, mass: *mass, train: train.clone(), speed: *speed };
    match what {
        Begin::SingleSpan | Begin::Viaduct => beams(&start),
        Begin::CableStayed => Ok(vec![(SCENARIO, ttb_scenario::default_scenario_text().to_string())]),
        Begin::Matrices => matrices(&start),
        Begin::Fmu => fmu(&start),
    }
}

/// Takes back what was written a moment ago.
fn remove(folder: &Path, files: &[File]) {
    for (name, _) in files {
        let _ = std::fs::remove_file(folder.join(name));
    }
    let _ = std::fs::remove_dir(folder);
}
