//! `ttb check-scenario`: all problems of a scenario, or a line that there are none.

use std::path::Path;

use crate::cli::Set;
use crate::error::Error;
use crate::prepare::fmus;

/// The command.
pub fn check(scenario: &Path, set: &Set) -> Result<(), Error> {
    let checked = fmus::scenario(Some(scenario), set)?;
    // What only shows when the bridge's matrices are factorised.
    let remarks = ttb_bridge::inspect::remarks(&checked.bridge).map_err(|e| Error::Input(e.to_string()))?;
    remarks.iter().for_each(|remark| note!("ttb: warning: {remark}"));
    let supports = checked.bridge.supports.len();
    let cars = checked.train_track.consist().len();
    let cars = if cars == 1 { "1 car".to_string() } else { format!("{cars} cars") };
    say!("{}: no problems; {cars}, {supports} supports on the bridge", scenario.display());
    Ok(())
}
