//! `ttb`: builds, couples and runs the two FMUs. What the program does, a verb a line.

use std::io::Write;

use clap::Parser;
use ttb::cli::{Cli, Command};
use ttb::commands::{
    accuracy, build, campaign, check, check_scenario, compare, export_ssp, generate, help_files, host, inspect,
    inspect_bridge, interoperability, keeper, list, new, report, run, schema, signature, statics, sweep, ui, view,
};
use ttb::error::Error;
use ttb::signals::Stop;
use ttb_fmi::leave;

fn main() {
    // Should this program crash or be killed, somebody must clear up after it.
    if let Ok(program) = std::env::current_exe() {
        ttb_fmi::temporary::keeper(program, vec!["keeper".into()]);
    }
    let command = Cli::parse().command;
    // What works for another process of this program ends as that one says.
    let stop = if command.serves() {
        Stop::default()
    } else {
        let stop = Stop::watch();
        // An FMU in this process must not end it, nor leave it otherwise than it was.
        ttb_fmi::guard::arm();
        stop
    };
    let done = execute(command, &stop);
    stop.unless_ending();
    let code = match done {
        Ok(()) => 0,
        Err(error) => {
            ttb::note!("ttb: {error}");
            error.code()
        }
    };
    // Nobody is left to be told of a pipe that broke.
    let _ = std::io::stdout().flush();
    leave(code)
}

fn execute(command: Command, stop: &Stop) -> Result<(), Error> {
    match command {
        Command::Run(arguments) => run::run(&arguments, stop),
        Command::New(arguments) => new::new(&arguments),
        Command::Report(arguments) => report::report(&arguments),
        Command::Build(arguments) => build::build(&arguments, stop),
        Command::CheckScenario { scenario, set, json } => check_scenario::check(scenario.as_deref(), &set, json),
        Command::Check(arguments) => check::check(&arguments),
        Command::Compare(arguments) => compare::compare(&arguments, stop),
        Command::Accuracy(arguments) => accuracy::accuracy(&arguments, stop),
        Command::Sweep(arguments) => sweep::sweep(&arguments, stop),
        Command::Campaign(arguments) => campaign::campaign(&arguments, stop),
        Command::Inspect(arguments) => inspect::inspect(&arguments),
        Command::InspectBridge { file, set } => inspect_bridge::inspect(&file, &set),
        Command::Interoperability(arguments) => interoperability::interoperability(&arguments),
        Command::ExportSsp(arguments) => export_ssp::export(&arguments),
        Command::Generate(arguments) => generate::generate(&arguments),
        Command::View(arguments) => view::view(&arguments, stop),
        Command::Schema { bridge, summary, verdicts } => schema::schema(bridge, summary, verdicts),
        Command::Ui(arguments) => ui::ui(&arguments, stop),
        Command::List(arguments) => list::list(&arguments),
        Command::Signature(arguments) => signature::signature(&arguments),
        Command::Static(arguments) => statics::compute(&arguments),
        Command::Completions { shell } => help_files::completions(shell),
        Command::Man { output } => help_files::man(output.as_deref()),
        Command::Host { preload } => host::host(&preload),
        Command::Keeper => keeper::keep(),
    }
}
