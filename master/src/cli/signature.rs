//! Arguments of `ttb signature`.

use std::path::PathBuf;

use clap::Args;

use super::Set;

pub const HELP: &str = "\
Examples:
  ttb signature ice2 mine.csv                        resonance lengths; does HSLM-A cover them?
  ttb signature hslm-a --bridge MY.json              and the speeds v = f λ that they mean for a bridge
  ttb signature hslm-a ice2 -o signature.csv         G(λ) as a table

G(λ) orders trains and finds speeds that deserve a look. It is no proof: `ttb sweep` computes the passages.";

/// Arguments of `ttb signature`.
#[derive(Debug, Args)]
pub struct Signature {
    /// Names of trains (`ttb list trains`), or their files
    #[arg(required = true)]
    pub trains: Vec<String>,
    /// A scenario with the bridge: its frequency and damping
    #[arg(long)]
    pub bridge: Option<PathBuf>,
    /// Damping ratio of the bridge, %, where no scenario tells it [default: 1]
    #[arg(long, value_name = "PERCENT", conflicts_with = "bridge")]
    pub damping: Option<f64>,
    /// File for the signatures: train, λ in m, G in kN
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// Other values for keys of the scenario
    #[command(flatten)]
    pub set: Set,
}
