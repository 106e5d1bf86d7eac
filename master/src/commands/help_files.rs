//! `ttb completions` and `ttb man`: help for shells and for `man`, from the definition of the command line.

use std::io::Write;
use std::path::Path;

use clap::CommandFactory;
use clap_complete::{Shell, generate};
use clap_mangen::Man;

use crate::cli::Cli;
use crate::error::Error;

/// `ttb completions`: the script to standard output.
pub fn completions(shell: Shell) -> Result<(), Error> {
    let mut script = Vec::new();
    generate(shell, &mut Cli::command(), "ttb", &mut script);
    print(&script)
}

/// `ttb man`: the page of the program to standard output, or one page a command into a folder.
pub fn man(output: Option<&Path>) -> Result<(), Error> {
    let Some(folder) = output else {
        let mut page = Vec::new();
        Man::new(Cli::command()).render(&mut page).map_err(Error::io(Path::new("ttb.1")))?;
        return print(&page);
    };
    std::fs::create_dir_all(folder).map_err(Error::io(folder))?;
    clap_mangen::generate_to(Cli::command(), folder).map_err(Error::io(folder))
}

/// A reader that has gone away is no error.
fn print(bytes: &[u8]) -> Result<(), Error> {
    let _ = std::io::stdout().write_all(bytes);
    Ok(())
}
