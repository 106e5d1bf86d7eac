//! Arguments of `ttb run`.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::set::Set;

pub(super) const HELP: &str = "\
The output folder gets
  results.csv             time, then every output by its FMI name, SI units
  iterations.csv          one row a step: iterations, residual, contraction, roll-backs, seconds
  runs.csv, peaks.csv     reduced values that criteria judge: ttb report FOLDER
  summary.json            peaks with place and time, iterations, timing, every file read with its hash
  results.svg, .png       deck, cars and wheels over time
  scenario.resolved.json  the scenario with all defaults and the steps that were taken; maps likewise
  system.resolved.ssp     instead, of a system structure: flattened, all values and settings inside
  *.fmu                   the FMUs that were built for the run
While a run lasts, another run into its folder is refused. When a run begins its first step, it
removes what an earlier run left in the folder; a run that is refused leaves the folder as it is.

A bridge FMU of your own (docs/guide/bridges.md):
  ttb check THEIRS.fmu                     does it do what its description and FMI promise?
  ttb inspect --map THEIRS.fmu > map.json  a map of its variables onto ours
  ttb run scenario.json --bridge THEIRS.fmu --map map.json
Trial steps before the run find wrong signs and units, and states that are not restored.

An FMU that crashes ends the program, and results are lost, unless it is isolated:
  ttb run scenario.json --bridge THEIRS.fmu --isolate --timeout 10";

/// Arguments of `ttb run`.
#[derive(Debug, Args)]
pub struct Run {
    /// The scenario file, or a system structure of two FMUs, FILE.ssp or FILE.ssd [default: the bundled ICE 3 over a cable-stayed bridge]
    pub scenario: Option<PathBuf>,
    /// Other values for keys of the scenario
    #[command(flatten)]
    pub set: Set,
    /// Folder for the results
    #[arg(short, long, default_value = "ttb-out")]
    pub output: PathBuf,
    /// Use this FMU as the train–track subsystem instead of building one
    #[arg(long, value_name = "FMU")]
    pub train_track: Option<PathBuf>,
    /// Use this FMU as the bridge instead of building one; several times for several bridges in track order
    #[arg(long, value_name = "FMU")]
    pub bridge: Vec<PathBuf>,
    /// How the given bridge's variables belong to ours, where they stand, parameters; `ttb inspect FMU --map` proposes one
    ///
    /// With several bridges: one map for all, or one for each in the same order.
    #[arg(long, value_name = "FILE", requires = "bridge")]
    pub map: Vec<PathBuf>,
    /// Run FMUs in processes of their own: should one crash or hang, the results so far are kept
    ///
    /// Without value: the FMUs given by --bridge and --train-track, or both of an .ssp file. What such an FMU prints goes
    /// to standard error, each line after its name.
    #[arg(long, value_name = "SIDE", num_args = 0..=1, require_equals = true, default_missing_value = "given")]
    pub isolate: Option<Isolate>,
    /// Longest time a call of an isolated FMU may take [default: 60]
    #[arg(long, value_name = "SECONDS", requires = "isolate", allow_negative_numbers = true)]
    pub timeout: Option<f64>,
    /// Load this library before the FMUs, e.g. libpython3.11.so.1.0 for those made with PythonFMU
    #[arg(long, value_name = "LIB")]
    pub preload: Vec<PathBuf>,
    /// Limits whose filters are applied to every step: bundled files and your own, later ones override single entries
    ///
    /// `ttb list limits` shows the bundled ones. The reduced values go into peaks.csv; `ttb report FOLDER` judges them.
    #[arg(long, value_name = "A,B.json", value_delimiter = ',')]
    pub limits: Vec<String>,
    /// Skip the trial steps before the run that test roll-back, signs and units of the FMUs
    #[arg(long)]
    pub no_probe: bool,
    /// No progress, no summary
    #[arg(short, long)]
    pub quiet: bool,
}

impl Run {
    /// The system structure to be run, if it is one: by the file's name.
    pub fn system(&self) -> Option<&Path> {
        let known = |ending: &std::ffi::OsStr| ending.eq_ignore_ascii_case("ssp") || ending.eq_ignore_ascii_case("ssd");
        let is_system = |path: &&Path| path.extension().is_some_and(known);
        self.scenario.as_deref().filter(is_system)
    }

    /// Whether the train–track and the bridge FMU come from the user: by an option, or in a system structure.
    pub fn given(&self) -> [bool; 2] {
        let system = self.system().is_some();
        [self.train_track.is_some(), !self.bridge.is_empty()].map(|given| system || given)
    }
}

/// The FMUs to isolate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Isolate {
    /// The train–track FMU
    TrainTrack,
    /// The bridge FMU
    Bridge,
    /// Both FMUs
    Both,
    /// Those given by --bridge and --train-track, or by an .ssp file
    #[value(hide = true)]
    Given,
}
