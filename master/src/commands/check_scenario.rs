//! `ttb check-scenario`: all problems of a scenario, or a line that there are none; on request as JSON.

use std::path::Path;

use serde::Serialize;
use ttb_scenario::{Checked, Problem, Problems, Warning};

use crate::cli::Set;
use crate::error::Error;
use crate::prepare::fmus;

/// What programs are told.
#[derive(Serialize)]
struct Told<'a> {
    problems: &'a [Problem],
    warnings: &'a [Warning],
}

/// The command.
pub fn check(scenario: Option<&Path>, set: &Set, json: bool) -> Result<(), Error> {
    let found = fmus::scenario(scenario, set).and_then(|checked| {
        let remarks = remarks(&checked)?;
        Ok((checked, remarks))
    });
    if json {
        tell(&found)?;
    }
    let (checked, remarks) = found?;
    remarks.iter().for_each(|remark| note!("ttb: warning: {remark}"));
    if !json {
        let name = scenario.map_or("the bundled scenario".into(), |path| path.display().to_string());
        let supports = checked.bridge.supports.len();
        let cars = checked.train_track.consist().len();
        let cars = if cars == 1 { "1 car".to_string() } else { format!("{cars} cars") };
        say!("{name}: no problems; {cars}, {supports} supports on the bridge");
    }
    Ok(())
}

/// What only shows when the bridge's matrices are factorised.
fn remarks(checked: &Checked) -> Result<Vec<String>, Error> {
    ttb_bridge::inspect::remarks(&checked.bridge).map_err(|e| Error::Input(e.to_string()))
}

fn tell(found: &Result<(Checked, Vec<String>), Error>) -> Result<(), Error> {
    let as_warning = |text: &String| Warning { text: text.clone(), ..Warning::default() };
    let (problems, warnings) = match found {
        Ok((checked, remarks)) => {
            (Vec::new(), [checked.findings.clone(), remarks.iter().map(as_warning).collect()].concat())
        }
        Err(Error::Scenario(Problems(problems))) => (problems.clone(), Vec::new()),
        Err(other) => (vec![Problem::whole(other.to_string())], Vec::new()),
    };
    let told = serde_json::to_string(&Told { problems: &problems, warnings: &warnings });
    say!("{}", told.map_err(|e| Error::Input(e.to_string()))?);
    Ok(())
}
