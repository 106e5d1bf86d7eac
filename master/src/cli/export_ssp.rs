//! Arguments of `ttb export-ssp`.

use std::path::PathBuf;

use clap::Args;

use super::set::Set;

pub(super) const HELP: &str = "\
FMPy, ecos, libcosim and other importers of SSP 1.0 simulate the file, in one pass a step;
`ttb run FILE.ssp` iterates and gives the results of the scenario. The settings of the iteration
are in the annotation org.ttb.coupling (docs/guide/ssp.md).";

/// Arguments of `ttb export-ssp`.
#[derive(Debug, Args)]
pub struct ExportSsp {
    /// The scenario file [default: the bundled ICE 3 over a cable-stayed bridge]
    pub scenario: Option<PathBuf>,
    /// Other values for keys of the scenario
    #[command(flatten)]
    pub set: Set,
    /// The file to write [default: the scenario's name with .ssp, in this folder]
    #[arg(short, long, value_name = "FILE.ssp")]
    pub output: Option<PathBuf>,
}
