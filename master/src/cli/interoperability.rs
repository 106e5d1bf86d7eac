//! Arguments of `ttb interoperability`.

use std::path::PathBuf;

use clap::Args;

pub(super) const HELP: &str = "\
The page has three tables: FMUs by the tool that made them, with the findings of `ttb check`; why FMUs
are not run; systems, and why they are not run. Only counts go into it, no file and no name of one.
--files adds a row for each file, to find them again.

  ttb interoperability ~/models -o interoperability.md

Every FMU is checked and every system is run in processes of their own, which are ended when they take
too long.";

/// Arguments of `ttb interoperability`.
#[derive(Debug, Args)]
pub struct Interoperability {
    /// Folder with FMUs (.fmu) and system structures (.ssp), also in folders in it
    pub folder: PathBuf,
    /// The page to write [default: standard output]
    #[arg(short, long, value_name = "FILE.md")]
    pub output: Option<PathBuf>,
    /// Seconds a single call of an FMU may take
    #[arg(long, default_value_t = 10.0, value_name = "SECONDS")]
    pub timeout: f64,
    /// Seconds a check or a run may take; a system that still runs then counts as run
    #[arg(long, default_value_t = 60.0, value_name = "SECONDS")]
    pub limit: f64,
    /// Also a row for each file
    #[arg(long)]
    pub files: bool,
}
