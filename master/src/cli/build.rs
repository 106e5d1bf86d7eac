//! Arguments of `ttb build`.

use std::path::PathBuf;

use clap::Args;

/// Arguments of `ttb build`.
#[derive(Debug, Args)]
pub struct Build {
    /// The scenario file [default: the bundled ICE 3 over a cable-stayed bridge]
    pub scenario: Option<PathBuf>,
    /// Folder for the FMUs
    #[arg(short, long, default_value = ".")]
    pub output: PathBuf,
}
