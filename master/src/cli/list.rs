//! Arguments of `ttb list`.

use clap::{Args, ValueEnum};

pub const HELP: &str = "\
Examples:
  ttb list trains                        every train of axle loads, with length, load, top speed
  ttb list trains hslm-a3 --axles        its axles as CSV (x in m, load in kN): a file to start from
  ttb list trains en15528-d2x6 --json    six wagons, with source
  ttb list cars ice3-motor               the data of a car, as a scenario may have them
  ttb list criteria deck-acceleration    what is judged, behind which filter, by which clause

A field `verified` says how sure data are: `secondary` stands for a standard whose text was not at hand.";

/// What can be listed.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Listed {
    /// Trains of axle loads; those of vehicles with their static loads
    Trains,
    /// Vehicles
    Cars,
    /// Kinds of track
    Tracks,
    /// Spectra of irregularity
    Spectra,
    /// Bridges
    Bridges,
    /// Static load models
    LoadModels,
    /// Files of limits, for --limits; NAME prints one: a file to start from
    Limits,
    /// Criteria of all of them: quantity, limit, filter, clause
    Criteria,
}

/// Arguments of `ttb list`.
#[derive(Debug, Args)]
pub struct List {
    /// What to list
    #[arg(value_enum)]
    pub what: Listed,
    /// One of them, or a family of trains such as hslm-a, or the file of a train: its data
    pub name: Option<String>,
    /// The axles of trains as CSV
    #[arg(long)]
    pub axles: bool,
    /// As JSON
    #[arg(long, conflicts_with = "axles")]
    pub json: bool,
}
