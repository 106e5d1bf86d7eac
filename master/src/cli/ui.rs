//! Arguments of `ttb ui`.

use std::path::PathBuf;

use clap::Args;

pub(super) const HELP: &str = "\
Open the address that is printed in a browser on this machine. It holds a secret: whoever does not know it is refused, and
other machines cannot reach the port at all. Nothing is written; what the page saves, the browser saves where you say.

Examples:
  ttb ui                          an empty page, the port chosen by the system
  ttb ui bridge.json --open       with a scenario; files that it names are looked for beside it
  ssh -L 8080:localhost:8080 HOST ttb ui --port 8080      on another machine, over a tunnel

Ctrl-C ends it, with exit code 0: what runs then is left off.";

/// Arguments of `ttb ui`.
#[derive(Debug, Args)]
pub struct Ui {
    /// The scenario that the page opens
    pub scenario: Option<PathBuf>,
    /// Port on this machine; 0: chosen by the system
    #[arg(long, default_value_t = 0)]
    pub port: u16,
    /// Open the address in the browser of the desktop
    #[arg(long)]
    pub open: bool,
}
