//! `ttb build`: only the two FMUs.

use crate::cli::Build;
use crate::error::Error;
use crate::prepare::auto::decided;
use crate::prepare::fmus;
use crate::results::folder::Folder;
use crate::signals::Stop;

/// The command.
pub fn build(arguments: &Build, stop: &Stop) -> Result<(), Error> {
    let (checked, prepared) = decided(arguments.scenario.as_deref(), &arguments.set)?;
    fmus::only_in_runs(&checked, "ttb build")?;
    let folder = Folder::claim(&arguments.output, stop)?;
    let built = fmus::build(&checked, prepared, folder.path())?;
    say!("{}\n{}", built.train_track.display(), built.bridge.display());
    Ok(())
}
