//! `ttb check-scenario`: all problems of a scenario, or a line that there are none.

use std::path::Path;

use crate::error::Error;
use crate::prepare::fmus;

/// The command.
pub fn check(scenario: &Path) -> Result<(), Error> {
    let checked = fmus::scenario(Some(scenario))?;
    let supports = checked.bridge.supports.len();
    let cars = checked.train_track.cars.len();
    say!("{}: no problems; {cars} cars, {supports} supports on the bridge", scenario.display());
    Ok(())
}
