//! Arguments of `ttb check`.

use std::path::PathBuf;

use clap::Args;

pub(super) const HELP: &str = "\
One line a finding: error, warning or remark, the rule's name, what is wrong, where, what was seen,
in brackets the section of FMI 2.0 and the command that makes the same test alone:

  ttb check THEIRS.fmu --only roll-back

Every test runs in a process of its own, so that a crash or a call that does not come back is a
finding. Exit code 0 without findings or with remarks alone, otherwise 1.";

/// Arguments of `ttb check`.
#[derive(Debug, Args)]
pub struct Check {
    /// The FMU
    #[arg(required_unless_present = "rules")]
    pub fmu: Option<PathBuf>,
    /// Print the findings as JSON
    #[arg(long)]
    pub json: bool,
    /// Make these checks only: description, or one that a finding names
    #[arg(long, value_name = "CHECK", value_delimiter = ',')]
    pub only: Vec<String>,
    /// Print all rules, each with the section of FMI 2.0 it rests on
    #[arg(long)]
    pub rules: bool,
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
