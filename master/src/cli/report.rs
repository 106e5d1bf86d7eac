//! Arguments of `ttb report`.

use std::path::PathBuf;

use clap::Args;

pub(super) const HELP: &str = "\
FOLDER is that of a run or of a sweep: it has runs.csv and peaks.csv. The report is one HTML file
that needs nothing else; verdicts.json is written beside it. A table of the verdicts goes to
standard output.

  ttb run MY.json -o out && ttb report out
  ttb report out --limits en1990-2002,mine.json --check

mine.json overrides single entries, and facts of the bridge:
  { \"facts\": { \"track\": \"ballast\", \"third_mode_hz\": 31.5 },
    \"criteria\": [ { \"id\": \"deck-acceleration\", \"source\": \"owner's specification 3.2\",
                    \"cases\": [ { \"limit\": 3.0 } ] } ] }

--verify takes the time of four runs, and shows how much the step decides and what the bridge adds
to the comfort: ttb report out --verify

Exit code 6 with --check if a limit is exceeded. A criterion that is not judged is no failure; it
is listed with its reason.";

/// Arguments of `ttb report`.
#[derive(Debug, Args)]
pub struct Report {
    /// Folder of a run or of a sweep
    pub folder: PathBuf,
    /// The report [default: FOLDER/report.html]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Limits: bundled files and your own, later ones override single entries [default: those of the run]
    #[arg(long, value_name = "A,B.json", value_delimiter = ',')]
    pub limits: Vec<String>,
    /// End with exit code 6 if a limit is exceeded
    #[arg(long)]
    pub check: bool,
    /// Compute the governing run with vehicles once more: at half the step, and over a deck that does not move
    #[arg(long)]
    pub verify: bool,
    /// No table of the verdicts
    #[arg(short, long)]
    pub quiet: bool,
}
