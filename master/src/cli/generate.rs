//! Arguments of `ttb generate`: the bridges that can be made, and their numbers.

use std::path::PathBuf;

use clap::{Args, Subcommand};

/// Arguments of `ttb generate`.
#[derive(Debug, Args)]
pub struct Generate {
    /// What to make
    #[command(subcommand)]
    pub what: Generated,
    /// Folder for bridge.json and scenario.json
    #[arg(short, long, default_value = ".", global = true)]
    pub output: PathBuf,
}

/// The bridges that can be made.
#[derive(Debug, Subcommand)]
pub enum Generated {
    /// One tower, two planes of cables, 112 + 80 + 32 m, a simply supported girder at either end
    CableStayed {
        /// Degrees of freedom aimed at
        #[arg(long, default_value_t = 120_000)]
        dofs: usize,
        /// Track axis to the right of the bridge's, m
        #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
        track_y: f64,
        /// Length of the girders before and after, m
        #[arg(long, default_value_t = 32.0)]
        approach: f64,
    },
    /// Simply supported girders in a row
    Viaduct {
        /// Number of girders
        #[arg(long, default_value_t = 10)]
        spans: usize,
        /// Length of each, m
        #[arg(long, default_value_t = 32.0)]
        span: f64,
        /// Width, m
        #[arg(long, default_value_t = 10.8)]
        width: f64,
        /// Height, m
        #[arg(long, default_value_t = 3.5)]
        depth: f64,
        /// Degrees of freedom aimed at, in all
        #[arg(long, default_value_t = 120_000)]
        dofs: usize,
        /// Track axis to the right of the bridge's, m
        #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
        track_y: f64,
    },
}
