//! The command line: one definition for parsing and help.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

/// Train–track–bridge co-simulation.
///
/// A train with its track and a bridge are two FMUs (FMI 2.0 co-simulation); this program couples them by iterating the
/// forces of the track's supports on the deck until both sides agree, at every time step.
#[derive(Debug, Parser)]
#[command(name = "ttb", version, max_term_width = 100, after_help = AFTER_HELP)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const AFTER_HELP: &str = "\
First steps:
  ttb run                      an ICE 3 over a cable-stayed bridge, results in ttb-out/
  ttb run examples/r1.json     a small published case
  ttb check-scenario MY.json   every problem of a scenario at once

Exit codes:
    0  ok
    1  ttb check has findings
    2  bad input: every problem is listed
    3  a step did not converge
    4  an FMU failed
    5  input or output failed
  130  interrupted; results so far are kept";

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scenario: build its FMUs, couple them, write results. Or run a system structure (.ssp)
    #[command(after_help = RUN_HELP)]
    Run(Run),
    /// Only build TrainTrack.fmu and Bridge.fmu
    Build(Build),
    /// Write a scenario as a system structure (SSP 1.0): both FMUs, connections and coupling settings in one file
    #[command(after_help = EXPORT_HELP)]
    ExportSsp(ExportSsp),
    /// Check a scenario and print all its problems
    CheckScenario {
        /// The scenario file
        scenario: PathBuf,
    },
    /// Show what engineers check first of a bridge: mass, reactions, what is loose, lowest frequencies
    #[command(after_help = "Exit code 2 if something is loose or forces do not balance.")]
    InspectBridge {
        /// A scenario, or a bridge model file
        file: PathBuf,
    },
    /// Test an FMU: does it do what its description and the standard promise?
    #[command(after_help = CHECK_HELP)]
    Check(Check),
    /// Run a scenario by the paper's methods: strongly coupled, loosely coupled, hybrid, multi-time-step
    #[command(after_help = COMPARE_HELP)]
    Compare(Compare),
    /// Run a scenario at several steps and show how accurate every reported quantity is
    #[command(after_help = "The output folder gets accuracy.md, accuracy.csv and the plot accuracy.svg and .png.")]
    Accuracy(Accuracy),
    /// Show what an FMU offers and propose a map of its variables
    Inspect(Inspect),
    /// Make a bridge model of shells and beams, and a scenario that runs a train over it
    Generate(Generate),
    /// Print the JSON Schema of scenario files
    #[command(
        after_help = "Put it beside your scenarios and name it in them, \"$schema\": \"scenario.schema.json\": editors then complete and check."
    )]
    Schema {
        /// That of bridge model files instead
        #[arg(long)]
        bridge: bool,
    },
    /// What `ttb run --isolate` starts to run an FMU in
    #[command(hide = true)]
    Host {
        /// Load this library first
        #[arg(long)]
        preload: Vec<PathBuf>,
    },
}

const RUN_HELP: &str = "\
The output folder gets
  results.csv      time, then every output by its FMI name, SI units (opens in FMPy, pandas, spreadsheets)
  iterations.csv   one row a step: iterations, residual, contraction, roll-backs, seconds
  summary.json     peaks with place and time, contact forces, iterations, timing, versions
  results.svg      deck, cars and wheels over time
  *.fmu            the two FMUs that were run

A bridge of somebody else's (docs/guide/bridges.md):
  ttb check THEIRS.fmu                         does it keep what FMI promises?
  ttb inspect --map THEIRS.fmu > map.json      a map of its variables onto ours: names, signs, units, places
  ttb run scenario.json --bridge THEIRS.fmu --map map.json
Trial steps before the run find wrong signs and units, and states that do not come back.

A foreign FMU that crashes takes the program and its results along, unless it is isolated:
  ttb run scenario.json --bridge THEIRS.fmu --isolate --timeout 10";

const EXPORT_HELP: &str = "\
FMPy, ecos, libcosim and other importers of SSP 1.0 simulate the file, in one pass a step; `ttb run FILE.ssp` iterates
and gives the results of the scenario. The settings of the iteration stand in the annotation org.ttb.coupling
(docs/guide/ssp.md).";

/// Arguments of `ttb export-ssp`.
#[derive(Debug, Args)]
pub struct ExportSsp {
    /// The scenario file [default: the bundled ICE 3 over a cable-stayed bridge]
    pub scenario: Option<PathBuf>,
    /// The file to write [default: the scenario's name with .ssp, in this folder]
    #[arg(short, long, value_name = "FILE.ssp")]
    pub output: Option<PathBuf>,
}

/// Arguments of `ttb run`.
#[derive(Debug, Args)]
pub struct Run {
    /// The scenario file, or a system structure of two FMUs, FILE.ssp [default: the bundled ICE 3 over a cable-stayed bridge]
    pub scenario: Option<PathBuf>,
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
    /// to standard error, each line after its name. Linux only.
    #[arg(long, value_name = "SIDE", num_args = 0..=1, require_equals = true, default_missing_value = "given")]
    pub isolate: Option<Isolate>,
    /// Longest time a call of an isolated FMU may take [default: 60]
    #[arg(long, value_name = "SECONDS", requires = "isolate", allow_negative_numbers = true)]
    pub timeout: Option<f64>,
    /// Load this library before the FMUs, e.g. libpython3.11.so.1.0 for those made with PythonFMU
    #[arg(long, value_name = "LIB")]
    pub preload: Vec<PathBuf>,
    /// Skip the trial steps before the run that test roll-back, signs and units of the FMUs
    #[arg(long)]
    pub no_probe: bool,
    /// No progress, no summary
    #[arg(short, long)]
    pub quiet: bool,
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

const CHECK_HELP: &str = "\
One line a finding: error or warning, the rule's name, what is wrong, where, what was seen.
Every test runs in a process of its own, so that a crash or a hang is a finding.
Exit code 0 without findings, 1 with any.";

/// Arguments of `ttb check`.
#[derive(Debug, Args)]
pub struct Check {
    /// The FMU
    pub fmu: PathBuf,
    /// Print the findings as JSON
    #[arg(long)]
    pub json: bool,
    /// Seconds a single call may take
    #[arg(long, default_value_t = 30.0, value_name = "SECONDS")]
    pub timeout: f64,
    /// Load this library before the FMU, e.g. libpython3.11.so.1.0 for one made with PythonFMU
    #[arg(long, value_name = "LIB")]
    pub preload: Vec<PathBuf>,
    /// Make one of the checks in this process
    #[arg(long, hide = true)]
    pub worker: Option<String>,
    /// Where it reports
    #[arg(long, hide = true)]
    pub report: Option<PathBuf>,
}

const COMPARE_HELP: &str = "\
Without --steps every method runs at its own step, as in the paper: the scenario's, and LCM at the longest whole part of it
that is well below its limit of convergence; HSA at that step too. The output folder gets compare.csv, compare.json and
figure-7 to figure-10 as SVG and PNG.

  ttb compare examples/r1.json
  ttb compare examples/cable-stayed-120k/scenario.json --budget scm=300
Ctrl-C ends the row at hand; the table then has the rows so far.";

/// Arguments of `ttb compare`.
#[derive(Debug, Args)]
pub struct Compare {
    /// The scenario file [default: the bundled ICE 3 over a cable-stayed bridge]
    pub scenario: Option<PathBuf>,
    /// Folder for the results
    #[arg(short, long, default_value = "ttb-compare")]
    pub output: PathBuf,
    /// Methods, in the order of the table
    #[arg(long, value_enum, value_delimiter = ',', default_values_t = Compared::ALL)]
    pub methods: Vec<Compared>,
    /// All methods at each of these steps
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', value_parser = positive)]
    pub steps: Vec<f64>,
    /// Step of the run that peaks are compared with; none: no such run [default: a tenth of the scenario's]
    #[arg(long, value_name = "SECONDS", default_value = "auto", hide_default_value = true)]
    pub reference: Fine,
    /// CPU time that the steps of a row may take; the total is then extrapolated. With a method: its rows alone
    #[arg(long, value_name = "[METHOD=]SECONDS", value_delimiter = ',')]
    pub budget: Vec<Budget>,
    /// Monitored point [default: the first]
    #[arg(long, value_name = "NAME")]
    pub point: Option<String>,
    /// Car, counted from the front
    #[arg(long, default_value_t = 1)]
    pub car: usize,
    /// Wheelset, counted from the front
    #[arg(long, default_value_t = 1)]
    pub wheel: usize,
    /// No progress
    #[arg(short, long)]
    pub quiet: bool,
}

/// Arguments of `ttb accuracy`.
#[derive(Debug, Args)]
pub struct Accuracy {
    /// The scenario file [default: the bundled ICE 3 over a cable-stayed bridge]
    pub scenario: Option<PathBuf>,
    /// Folder for the results
    #[arg(short, long, default_value = "ttb-accuracy")]
    pub output: PathBuf,
    /// Steps, multiples of the fine one
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', value_parser = positive,
        default_values_t = [4e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4])]
    pub steps: Vec<f64>,
    /// Step of the fine run
    #[arg(long, value_name = "SECONDS", value_parser = positive, default_value_t = 2e-5)]
    pub reference: f64,
    /// No progress
    #[arg(short, long)]
    pub quiet: bool,
}

/// The methods compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Compared {
    /// Strongly coupled, one system refactorised every step, as in the paper
    Scm,
    /// Strongly coupled, constant matrices and the contacts' Schur complement
    Schur,
    /// Loosely coupled at the wheels
    Lcm,
    /// Loosely coupled with the best under-relaxation
    LcmRelaxed,
    /// The hybrid algorithm: this program
    Hsa,
    /// The hybrid algorithm, train and track with ten steps a step of the bridge
    Multi,
}

impl Compared {
    const ALL: [Self; 6] = [Self::Scm, Self::Schur, Self::Lcm, Self::LcmRelaxed, Self::Hsa, Self::Multi];
}

/// How long rows may take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Whose rows; none: all.
    pub method: Option<Compared>,
    /// CPU time, s.
    pub seconds: f64,
}

impl std::str::FromStr for Budget {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((method, seconds)) = text.split_once('=') else {
            return Ok(Self { method: None, seconds: positive(text)? });
        };
        Ok(Self { method: Some(Compared::from_str(method, false)?), seconds: positive(seconds)? })
    }
}

/// The step of the fine run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fine {
    /// A tenth of the scenario's.
    Auto,
    /// No such run.
    None,
    /// s.
    Step(f64),
}

impl Fine {
    /// In seconds, for a scenario's step.
    pub fn fine(self, step: f64) -> Option<f64> {
        match self {
            Self::Auto => Some(0.1 * step),
            Self::None => None,
            Self::Step(h) => Some(h),
        }
    }
}

impl std::str::FromStr for Fine {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "auto" => Ok(Self::Auto),
            "none" => Ok(Self::None),
            other => positive(other).map(Self::Step),
        }
    }
}

/// A positive number of seconds.
fn positive(text: &str) -> Result<f64, String> {
    let seconds = text.parse::<f64>().ok().filter(|s| *s > 0.0 && s.is_finite());
    seconds.ok_or_else(|| "a positive number of seconds is wanted".into())
}

/// Arguments of `ttb inspect`.
#[derive(Debug, Args)]
pub struct Inspect {
    /// The FMU
    pub fmu: PathBuf,
    /// Print only the proposed map
    #[arg(long)]
    pub map: bool,
}

/// Arguments of `ttb build`.
#[derive(Debug, Args)]
pub struct Build {
    /// The scenario file [default: the bundled ICE 3 over a cable-stayed bridge]
    pub scenario: Option<PathBuf>,
    /// Folder for the FMUs
    #[arg(short, long, default_value = ".")]
    pub output: PathBuf,
}

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
