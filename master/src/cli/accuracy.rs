//! Arguments of `ttb accuracy`.

use std::path::PathBuf;

use clap::Args;

use super::seconds::positive;
use super::set::Set;

/// Arguments of `ttb accuracy`.
#[derive(Debug, Args)]
pub struct Accuracy {
    /// The scenario file [default: the bundled ICE 3 over a cable-stayed bridge]
    pub scenario: Option<PathBuf>,
    /// Other values for keys of the scenario
    #[command(flatten)]
    pub set: Set,
    /// Folder for the results
    #[arg(short, long, default_value = "ttb-accuracy")]
    pub output: PathBuf,
    /// Steps, multiples of the fine one, separated by commas [default: 4e-3,2e-3,1e-3,5e-4,2e-4,1e-4]
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', value_parser = positive, hide_default_value = true,
        default_values_t = [4e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4])]
    pub steps: Vec<f64>,
    /// Step of the fine run
    #[arg(long, value_name = "SECONDS", value_parser = positive, default_value_t = 2e-5)]
    pub reference: f64,
    /// No progress
    #[arg(short, long)]
    pub quiet: bool,
}
