//! Arguments of `ttb campaign`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::sweep::Common;

pub(super) const HELP: &str = "\
PLAN.json says what is varied; only `scenario` is needed:
  {
    \"scenario\": \"bridge.json\",
    \"trains\": [\"hslm-a\", \"ice2\"], \"speeds\": \"140:420\", \"step\": \"auto\", \"refine\": false, \"forces\": false,
    \"seeds\": \"1:20\", \"variants\": \"bounds\", \"way\": \"auto\",
    \"axes\": { \"bridge.damping.ratio\": [0.01, 0.015] }
  }
Every key of the scenario can be an axis. Bridge FMUs of other programs in the place of its bridge:
    \"bridges\": [{ \"fmu\": \"Bridge.fmu\", \"map\": \"map.json\" }]
With a Slurm cluster:
  ttb campaign plan PLAN.json -o out --tasks 16 > array.sbatch
  sbatch array.sbatch             # again until `ttb campaign status out` misses nothing
  ttb campaign merge out";

/// Arguments of `ttb campaign`.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Campaign {
    /// What to do with a campaign instead of computing it
    #[command(subcommand)]
    pub verb: Option<Verb>,
    /// The file that says what is varied, or the plan.json of a campaign's folder
    #[arg(required = true)]
    pub plan: Option<PathBuf>,
    /// How and where
    #[command(flatten)]
    pub common: Option<Common>,
}

/// What can be done with a campaign.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Say which runs are done, failed, missing
    Status {
        /// The campaign's folder
        folder: PathBuf,
        /// Also say what is missing of each of so many shards
        #[arg(long)]
        shards: Option<usize>,
    },
    /// Make the tables of a campaign whose shards are all there; gaps are refused
    Merge {
        /// The campaign's folder
        folder: PathBuf,
        /// Make them of what is there
        #[arg(long)]
        partial: bool,
    },
    /// Print a script for a Slurm array that computes a campaign
    Plan {
        /// The campaign's folder, or the file that says what is varied
        plan: PathBuf,
        /// Folder for the results, where a file is given
        #[arg(short, long)]
        output: Option<PathBuf>,
        /// Number of tasks
        #[arg(long, default_value_t = 16)]
        tasks: usize,
        /// Minutes a task may take
        #[arg(long, default_value_t = 60)]
        minutes: u64,
    },
}
