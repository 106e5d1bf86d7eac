//! Arguments of `ttb new`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

pub(super) const HELP: &str = "\
  ttb new single-span mybridge --spans 24 --n0 4.5 --mass 15000 --train ice3
  ttb run mybridge/scenario.json -o mybridge/results
The scenario's comments say what to put in place of each number. A folder that holds one of the
files already is left as it is.";

/// Arguments of `ttb new`.
#[derive(Debug, Args)]
pub struct New {
    /// What to begin with
    pub what: Begin,
    /// Folder for scenario.json and what belongs to it
    pub folder: PathBuf,
    /// Lengths of the spans, m, separated by commas [default: 24; viaduct: 24,24,24]
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    pub spans: Vec<f64>,
    /// One beam over all spans instead of one beam each
    #[arg(long)]
    pub continuous: bool,
    /// First natural frequency, Hz [default: between the limits of EN 1991-2 figure 6.10]
    #[arg(long, allow_negative_numbers = true)]
    pub n0: Option<f64>,
    /// Mass with ballast and dead loads, kg/m [default: 12000]
    #[arg(long, allow_negative_numbers = true)]
    pub mass: Option<f64>,
    /// A bundled train or car
    #[arg(long, default_value = "ice3")]
    pub train: String,
    /// Its speed, km/h
    #[arg(long, default_value_t = 250.0, allow_negative_numbers = true)]
    pub speed: f64,
}

/// What a project can begin with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Begin {
    /// A beam on two bearings
    SingleSpan,
    /// Beams in a row, or one over several spans
    Viaduct,
    /// The bundled cable-stayed bridge of 224 m, as a frame
    CableStayed,
    /// K and M, as another program would write them
    Matrices,
    /// A bridge of your own as an FMU, in Python
    Fmu,
}
