//! `ttb export-ssp`: a scenario as a system structure.

use crate::cli::ExportSsp;
use crate::error::Error;
use crate::system;

/// The command.
pub fn export(arguments: &ExportSsp) -> Result<(), Error> {
    say!("{}", system::export(arguments)?.display());
    Ok(())
}
