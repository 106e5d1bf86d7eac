//! Arguments of `ttb build`.

use std::path::PathBuf;

use clap::Args;

use super::set::Set;

/// Arguments of `ttb build`.
#[derive(Debug, Args)]
pub struct Build {
    /// The scenario file [default: the bundled ICE 3 over a cable-stayed bridge]
    pub scenario: Option<PathBuf>,
    /// Other values for keys of the scenario
    #[command(flatten)]
    pub set: Set,
    /// Folder for the FMUs
    #[arg(short, long, default_value = ".")]
    pub output: PathBuf,
}
