//! Arguments of `ttb export-ssp`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::set::Set;

pub(super) const HELP: &str = "\
FMPy, ecos, libcosim and other importers of SSP 1.0 simulate the file, in one pass a step;
`ttb run FILE.ssp` iterates and gives the results of the scenario, whatever --for says. The settings
of the iteration are in the annotation org.ttb.coupling.

Which force is connected decides how accurate another master is (docs/guide/ssp.md):
  ttb export-ssp my.json --for one-pass-parallel    FMPy, ecos, libcosim: forces of the begin of a step
  ttb export-ssp my.json --for one-pass-sequential  train and track first, then the bridge: mean forces
  ttb export-ssp my.json --for iterating            steps are repeated: mean forces, end values of the deck";

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
    /// Connect what is most accurate in such a master
    #[arg(long = "for", value_name = "MASTER", default_value = "one-pass-parallel")]
    pub master: Master,
}

/// How a master exchanges values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Master {
    /// Both sides take a step under values of its begin
    OnePassParallel,
    /// Train and track take a step first, the bridge under the forces of this step
    OnePassSequential,
    /// Steps are repeated until both sides agree
    Iterating,
}
