//! Arguments of `ttb inspect`.

use std::path::PathBuf;

use clap::Args;

/// Arguments of `ttb inspect`.
#[derive(Debug, Args)]
pub struct Inspect {
    /// The FMU
    pub fmu: PathBuf,
    /// Print only the proposed map
    #[arg(long)]
    pub map: bool,
}
