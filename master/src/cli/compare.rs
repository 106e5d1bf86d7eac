//! Arguments of `ttb compare`: methods, steps, budgets.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::seconds::positive;
use super::set::Set;

pub(super) const HELP: &str = "\
Without --steps every method runs at its own step, as in the paper: at the scenario's step, and LCM
at the longest whole part of it that is well below its limit of convergence; HSA at that step too.
The output folder gets compare.csv, compare.json, histories.csv and figure-7 to figure-10 as SVG
and PNG.

  ttb compare examples/r1.json
  ttb compare examples/cable-stayed-120k/scenario.json --budget scm=300
Ctrl-C ends the row at hand; the table then has the rows so far.";

/// Arguments of `ttb compare`.
#[derive(Debug, Args)]
pub struct Compare {
    /// The scenario file [default: the bundled ICE 3 over a cable-stayed bridge]
    pub scenario: Option<PathBuf>,
    /// Other values for keys of the scenario
    #[command(flatten)]
    pub set: Set,
    /// Folder for the results
    #[arg(short, long, default_value = "ttb-compare")]
    pub output: PathBuf,
    /// Methods, in the order of the table, separated by commas [default: all, in the order below]
    #[arg(long, value_enum, value_delimiter = ',', hide_default_value = true, default_values_t = Compared::ALL)]
    pub methods: Vec<Compared>,
    /// All methods at each of these steps, separated by commas
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
