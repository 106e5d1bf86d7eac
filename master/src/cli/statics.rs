//! Arguments of `ttb static`.

use std::path::PathBuf;

use clap::Args;

use super::Set;

pub const HELP: &str = "\
Examples:
  ttb static MY.json --load lm71             load model 71 wherever it acts worst
  ttb static MY.json --load sw0 --alpha 1.21
  ttb static MY.json --load hslm-a3 -o a3.csv

Values are those of the whole deck and of the scenario's points; -o writes them for every deck point.";

/// Arguments of `ttb static`.
#[derive(Debug, Args)]
pub struct Static {
    /// The scenario with the bridge
    pub scenario: PathBuf,
    /// A load model (lm71, sw0, sw2), or a train as for `ttb signature`
    #[arg(long, default_value = "lm71")]
    pub load: String,
    /// Factor on all loads
    #[arg(long, default_value_t = 1.0)]
    pub alpha: f64,
    /// File for the values at all deck points, CSV
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// Other values for keys of the scenario
    #[command(flatten)]
    pub set: Set,
}
