//! `ttb build`: only the two FMUs.

use crate::cli::Build;
use crate::error::Error;
use crate::prepare::auto::decided;
use crate::prepare::fmus;

/// The command.
pub fn build(arguments: &Build) -> Result<(), Error> {
    let checked = decided(arguments.scenario.as_deref())?;
    let built = fmus::build(&checked, &arguments.output)?;
    say!("{}\n{}", built.train_track.display(), built.bridge.display());
    Ok(())
}
