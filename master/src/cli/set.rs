//! `--set KEY=VALUE`, on every command that takes a scenario.

use clap::Args;
use ttb_scenario::Setting;

/// Other values for keys of the scenario.
#[derive(Args, Clone, Debug, Default)]
pub struct Set {
    /// Another value for a key of the scenario, such as train.speed.km_h=280; several times for several keys
    ///
    /// KEY is a path into the file, with numbers in brackets for entries of lists: `bridge.structure.spans[0].mass=12e3`.
    /// VALUE is JSON; what is no JSON is a text: track.type=slab. Units are those of the key. A key that is not in the file
    /// is added; one that no scenario has is refused.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<Setting>,
}
