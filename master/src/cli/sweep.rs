//! Arguments of `ttb sweep`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::set::Set;

pub(super) const HELP: &str = "\
Examples:
  ttb sweep bridge.json --trains hslm-a,ice2,mine.csv --speeds 140:420 -o out
  ttb sweep bridge.json --trains hslm-a --speeds 140:420 --refine --variants bounds -o out
  ttb sweep bridge.json --speeds 200:300 --way coupled --seeds 1:20 -j 2 -o out
  ttb sweep bridge.json --bridge THEIRS.fmu --map map.json --speeds 200:300 -o out

The output folder gets
  runs.csv, peaks.csv, envelope.csv   a row a run, a reduced value, a point of the deck; results.h5: the same as arrays
  curves.svg, .png                    largest deck acceleration and deflection over speed
  coupled-check.json, history/        the governing runs of axle loads once more, step by step, with their histories
  plan.json, journal/, timings.csv    what was asked for, one small file a run, seconds a run
The same command again computes what is missing: after Ctrl-C, kill, a power cut, or with more trains and speeds.

Exit code 7: some runs failed; each is a row of runs.csv with its message.";

/// Arguments of `ttb sweep`.
#[derive(Debug, Args)]
pub struct Sweep {
    /// The scenario file
    pub scenario: PathBuf,
    /// Trains: names (`ttb list trains`) or files of axle loads, with commas between them [default: the scenario's own]
    #[arg(long, value_name = "LIST")]
    pub trains: Option<String>,
    /// Speeds in km/h: from:to, from:to:step or a list [default: the scenario's own]
    #[arg(long, value_name = "LIST")]
    pub speeds: Option<String>,
    /// Step of from:to: `auto`, so fine that no resonance is missed, or km/h [default: auto; 5 where vehicles run]
    #[arg(long, value_name = "STEP")]
    pub step: Option<String>,
    /// Seek the largest values between the speeds by golden section
    #[arg(long)]
    pub refine: bool,
    /// Also moments, shears and reactions, where runs are computed in modes
    #[arg(long)]
    pub forces: bool,
    /// Seeds of the irregularity, such as 1:20: the same rails for all trains and speeds, and a smooth one
    #[arg(long, value_name = "LIST")]
    pub seeds: Option<String>,
    /// `bounds` (low mass; high mass with low stiffness), `bounds:0.95,1.05,0.9` with factors, or a file of variants
    #[arg(long, value_name = "WORD|FILE")]
    pub variants: Option<String>,
    /// How runs are computed
    #[arg(long, value_enum, default_value = "auto")]
    pub way: Way,
    /// In which direction trains cross the bridge
    #[arg(long, value_enum, default_value = "forward")]
    pub heading: Heading,
    /// Limits, names and files with commas between them: their filters decide which values are made; kept for `ttb report`
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub limits: Vec<String>,
    /// Use this FMU as the bridge, isolated, with any train; several times for several bridges in track order
    #[arg(long, value_name = "FMU")]
    pub bridge: Vec<PathBuf>,
    /// How the given bridge's variables belong to ours; `ttb inspect FMU --map` proposes one. One for all, or one for each
    #[arg(long, value_name = "FILE", requires = "bridge")]
    pub map: Vec<PathBuf>,
    /// Other values of keys
    #[command(flatten)]
    pub set: Set,
    /// How and where
    #[command(flatten)]
    pub common: Common,
}

/// How and where runs are computed.
#[derive(Clone, Debug, Args)]
pub struct Common {
    /// Folder for the results
    #[arg(short, long)]
    pub output: PathBuf,
    /// Workers [default: one a processor]
    #[arg(short, long, value_name = "N")]
    pub jobs: Option<usize>,
    /// Only say how many runs it is, about how long they take and how much disk
    #[arg(long)]
    pub dry_run: bool,
    /// Only this part of the runs, i/n counted from 0: for tasks of a cluster. Tables are made by `ttb campaign merge`
    #[arg(long, value_name = "I/N")]
    pub shard: Option<ttb_campaign::Shard>,
    /// Discard all runs that are in the folder
    #[arg(long)]
    pub restart: bool,
    /// Compute failed runs once more
    #[arg(long)]
    pub retry: bool,
    /// Whose histories are kept in history/ and results.h5
    #[arg(long, value_enum, default_value = "worst", value_name = "WHOSE")]
    pub keep_histories: Keep,
    /// Longest time a call of a bridge FMU may take [default: 60]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub timeout: Option<f64>,
    /// Load this library before bridge FMUs, e.g. libpython3.11.so.1.0 for those made with PythonFMU
    #[arg(long, value_name = "LIB")]
    pub preload: Vec<PathBuf>,
    /// No progress, no summary
    #[arg(short, long)]
    pub quiet: bool,
}

/// Whose histories are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Keep {
    /// Those of all runs
    All,
    /// Those of the governing runs
    #[default]
    Worst,
    /// None
    None,
}

/// In which direction trains cross the bridge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Heading {
    /// The first axle enters at the bridge's begin
    Forward,
    /// The first axle enters at the bridge's end
    Backward,
    /// Every train once in either direction
    Both,
}

/// How runs are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Way {
    /// Modal or one-axle for axle loads, coupled where seeds are given
    Auto,
    /// Axle loads on the modes of the bridge
    Modal,
    /// Axle loads by superposition of the passage of one axle
    OneAxle,
    /// Vehicles on their track, or axle loads on a rigid one, step by step
    Coupled,
}
