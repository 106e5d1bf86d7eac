//! The command line: one definition for parsing and help, a file of arguments a verb.

mod accuracy;
mod build;
mod campaign;
mod check;
mod compare;
mod export_ssp;
mod generate;
mod inspect;
mod interoperability;
mod list;
mod new;
mod report;
mod run;
mod seconds;
mod set;
mod signature;
mod statics;
mod sweep;
mod ui;
mod view;

use std::path::PathBuf;

use clap::{Parser, Subcommand};

pub use accuracy::Accuracy;
pub use build::Build;
pub use campaign::{Campaign, Verb as CampaignVerb};
pub use check::Check;
pub use compare::{Budget, Compare, Compared, Fine};
pub use export_ssp::{ExportSsp, Master};
pub use generate::{Generate, Generated};
pub use inspect::Inspect;
pub use interoperability::Interoperability;
pub use list::{List, Listed};
pub use new::{Begin, New};
pub use report::Report;
pub use run::{Isolate, Run};
pub use set::Set;
pub use signature::Signature;
pub use statics::Static;
pub use sweep::{Common, Heading as SweepHeading, Keep, Sweep, Way as SweepWay};
pub use ui::Ui;
pub use view::View;

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
    1  ttb check has found errors or warnings
    2  bad input: every problem is listed
    3  a step did not converge, or a wheel has left its rail
    4  an FMU failed
    5  input or output failed
    6  ttb report --check: a limit is exceeded
    7  some runs of a sweep failed
  130  interrupted by Ctrl-C; results so far are kept
  143  ended by SIGTERM, 129: by SIGHUP; the same";

const SCHEMA_HELP: &str = "\
Put it beside your scenarios and name it in them: \"$schema\": \"scenario.schema.json\". Editors
then complete keys and check them.";

const CHECK_SCENARIO_HELP: &str = "\
With --json, standard output gets one object, and the exit code is 2 as well if there are problems:
  {\"problems\": [{\"file\", \"path\", \"rule\", \"value\", \"suggestion\"}, …],
   \"warnings\": [{\"path\", \"text\", …}, …]}";

const COMPLETIONS_HELP: &str = "\
  ttb completions bash > ~/.local/share/bash-completion/completions/ttb
  ttb completions fish > ~/.config/fish/completions/ttb.fish
  ttb completions zsh  > a file _ttb in a folder of $fpath";

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scenario: build its FMUs, couple them, write results. Or run a system structure (.ssp)
    #[command(after_help = run::HELP)]
    Run(Run),
    /// Begin: write a scenario that runs at once, with comments that say what to put in place of each number
    #[command(after_help = new::HELP)]
    New(New),
    /// Judge the results of a run or a sweep by the limits of codes, and write the report
    #[command(after_help = report::HELP)]
    Report(Report),
    /// Only build TrainTrack.fmu and Bridge.fmu
    Build(Build),
    /// Write a scenario as a system structure (SSP 1.0): both FMUs, connections and coupling settings in one file
    #[command(after_help = export_ssp::HELP)]
    ExportSsp(ExportSsp),
    /// Check a scenario and print all its problems
    #[command(after_help = CHECK_SCENARIO_HELP)]
    CheckScenario {
        /// The scenario file [default: the bundled ICE 3 over a cable-stayed bridge]
        scenario: Option<PathBuf>,
        /// Other values for keys of the scenario
        #[command(flatten)]
        set: Set,
        /// Print problems and warnings as JSON, for programs
        #[arg(long)]
        json: bool,
    },
    /// Show what engineers check first of a bridge: mass, reactions, mechanisms, lowest frequencies
    #[command(
        after_help = "Exit code 2 if there is a mechanism, forces do not balance, or rounding spoils the results."
    )]
    InspectBridge {
        /// A scenario, or a bridge model file
        file: PathBuf,
        /// Other values for keys of the scenario
        #[command(flatten)]
        set: Set,
    },
    /// Test an FMU: does it do what its description and the standard promise?
    #[command(after_help = check::HELP)]
    Check(Check),
    /// Run a scenario by the paper's methods: strongly coupled, loosely coupled, hybrid, multi-time-step
    #[command(after_help = compare::HELP)]
    Compare(Compare),
    /// Run a scenario at several steps and show how accurate every reported quantity is
    #[command(after_help = "The output folder gets accuracy.md, accuracy.csv and the plot accuracy.svg and .png.")]
    Accuracy(Accuracy),
    /// Trains at many speeds over one bridge: which governs, with no resonance missed. Also variants and seeds
    #[command(after_help = sweep::HELP)]
    Sweep(Sweep),
    /// A grid over any keys of a scenario, for many processors or a cluster; its status; its tables
    #[command(after_help = campaign::HELP)]
    Campaign(Campaign),
    /// Show what an FMU offers and propose a map of its variables
    Inspect(Inspect),
    /// Check and run what lies in a folder, FMUs and system structures, and write a page of counts
    #[command(after_help = interoperability::HELP)]
    Interoperability(Interoperability),
    /// Make a bridge model of shells and beams, and a scenario that runs a train over it
    Generate(Generate),
    /// Write the bridge for ParaView: sag under its own weight, natural modes, the crossing of the train
    #[command(after_help = view::HELP)]
    View(View),
    /// A page in the browser: bridge and train typed in, curves, verdict and report, computed by this program
    #[command(after_help = ui::HELP)]
    Ui(Ui),
    /// List what comes with the program: trains, cars, tracks, spectra, bridges, load models
    #[command(after_help = list::HELP)]
    List(List),
    /// Show at which wavelengths trains excite a bridge, and whether HSLM-A covers them
    #[command(after_help = signature::HELP)]
    Signature(Signature),
    /// Static values of a bridge under a load model or a train, wherever it acts worst
    #[command(after_help = statics::HELP)]
    Static(Static),
    /// Print the JSON Schema of scenario files
    #[command(after_help = SCHEMA_HELP)]
    Schema {
        /// Print the schema of bridge model files instead
        #[arg(long, conflicts_with = "summary")]
        bridge: bool,
        /// Print the schema of summary.json, which a run writes, instead
        #[arg(long)]
        summary: bool,
        /// Print the schema of verdicts.json, which a report writes, instead
        #[arg(long, conflicts_with_all = ["bridge", "summary"])]
        verdicts: bool,
    },
    /// Print the shell's completion script, to be sourced or put where the shell looks for it
    #[command(after_help = COMPLETIONS_HELP)]
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// Print the manual page, or write one for every command
    #[command(after_help = "ttb man | man -l -              reads it\nttb man -o ~/.local/share/man/man1")]
    Man {
        /// Folder for ttb.1, ttb-run.1 …; without it ttb.1 is printed
        #[arg(short, long)]
        output: Option<PathBuf>,
    },
    /// What `ttb run --isolate` starts to run an FMU in
    #[command(hide = true)]
    Host {
        /// Load this library first
        #[arg(long)]
        preload: Vec<PathBuf>,
    },
    /// What removes the temporary folders of a program that has ended
    #[command(hide = true)]
    Keeper,
}

impl Command {
    /// Whether it is a part of another command's work, in a process of its own.
    pub fn serves(&self) -> bool {
        match self {
            Self::Host { .. } | Self::Keeper => true,
            Self::Check(arguments) => arguments.worker.is_some(),
            _ => false,
        }
    }
}
