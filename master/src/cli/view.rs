//! Arguments of `ttb view`.

use std::path::PathBuf;

use clap::Args;

use super::set::Set;

pub(super) const HELP: &str = "\
The output folder gets
  bridge.vtu      the model with fields on its points: sag under its own weight (m), the natural
                  modes by their frequency, each scaled to a greatest displacement of 1
  crossing.pvd    with --crossing: displacements (m) while the train crosses, and its wheelsets
z is up, x along the track. Imported matrices keep their own axes and show their nodes only.

In ParaView: open bridge.vtu, add the filter Warp By Vector, choose a field and a scale.
  ttb view examples/box-girder.json -o view
  ttb view ttb-out -o view --crossing         the run in a folder of results, once more";

/// Arguments of `ttb view`.
#[derive(Debug, Args)]
pub struct View {
    /// A scenario, a bridge model file, or a folder of results
    pub what: PathBuf,
    /// Folder for the files
    #[arg(short, long, default_value = "ttb-view")]
    pub output: PathBuf,
    /// Number of natural modes
    #[arg(long, default_value_t = 8)]
    pub modes: usize,
    /// Also run the scenario, in all degrees of freedom, and write the bridge under the crossing train
    #[arg(long)]
    pub crossing: bool,
    /// Moments of the crossing, evenly spaced
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..), requires = "crossing")]
    pub frames: u64,
    /// Other values of the scenario
    #[command(flatten)]
    pub set: Set,
    /// No progress
    #[arg(short, long)]
    pub quiet: bool,
}
