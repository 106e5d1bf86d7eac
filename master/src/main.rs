//! `ttb`: builds, couples and runs the two FMUs. Only this crate prints; exit codes are those of [`error::Error::code`].

/// Prints a line; a reader that has gone away (`ttb schema | head`) is no error.
macro_rules! say {
    ($($text:tt)*) => {{
        use std::io::Write;
        let _ = writeln!(std::io::stdout(), $($text)*);
    }};
}

mod assign;
mod auto;
mod build;
mod check;
mod cli;
mod clock;
mod compare;
mod connect;
mod coupled;
mod equal;
mod error;
mod generate;
mod inspect;
mod inspect_bridge;
mod isolate;
mod job;
mod map;
mod parameters;
mod peaks;
mod picture;
mod plot;
mod preload;
mod probe;
mod record;
mod run;
mod series;
mod stretch;
mod summary;
mod system;

use std::io::Write;

use clap::Parser;
use cli::{Cli, Command};
use error::Error;
use ttb_fmi::leave;

fn main() {
    let code = match execute(Cli::parse().command) {
        Ok(()) => 0,
        Err(error) => {
            eprintln!("ttb: {error}");
            error.code()
        }
    };
    // Nobody is left to be told of a pipe that broke.
    let _ = std::io::stdout().flush();
    leave(code)
}

fn execute(command: Command) -> Result<(), Error> {
    match command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Build(arguments) => {
            let checked = build::decided(arguments.scenario.as_deref())?;
            let built = build::build(&checked, &arguments.output)?;
            say!("{}\n{}", built.train_track.display(), built.bridge.display());
            Ok(())
        }
        Command::CheckScenario { scenario } => {
            let checked = build::scenario(Some(&scenario))?;
            let supports = checked.bridge.supports.len();
            say!(
                "{}: no problems; {} cars, {supports} supports on the bridge",
                scenario.display(),
                checked.train_track.cars.len()
            );
            Ok(())
        }
        Command::Check(arguments) => check::check(&arguments),
        Command::Accuracy(arguments) => compare::accuracy::accuracy(&arguments),
        Command::Compare(arguments) => compare::compare(&arguments),
        Command::Inspect(arguments) => inspect::inspect(&arguments),
        Command::ExportSsp(arguments) => {
            say!("{}", system::export(&arguments)?.display());
            Ok(())
        }
        Command::Generate(arguments) => generate::generate(&arguments),
        Command::Host { preload } => {
            preload::load(&preload)?;
            ttb_fmi2::import::host().map_err(Error::Input)
        }
        Command::InspectBridge { file } => inspect_bridge::inspect(&file),
        Command::Schema { bridge } => {
            say!("{:#}", if bridge { ttb_scenario::model_schema() } else { ttb_scenario::schema() });
            Ok(())
        }
    }
}
