//! The commands of `ttb` as a library, from the lowest room up:
//!
//! ```text
//! error, files, clock      what ends a command, files that are whole or not there, processor time
//! cli                     the command line
//! connect                 from FMU files to two coupled subsystems
//! results                 what a run leaves: rows, peaks, summary
//! pictures                histories and errors drawn as SVG and PNG
//! prepare                 from a scenario to its FMUs and its steps
//! system                  system structures (SSP): written, read
//! commands                one file or folder a verb
//! ```
//!
//! Only the commands print. Exit codes are those of [`error::Error::code`].

/// Prints a line; a reader that has gone away (`ttb schema | head`) is no error.
macro_rules! say {
    ($($text:tt)*) => {{
        use std::io::Write;
        let _ = writeln!(std::io::stdout(), $($text)*);
    }};
}

pub mod cli;
pub mod clock;
pub mod commands;
pub mod connect;
pub mod error;
pub mod files;
pub mod pictures;
pub mod prepare;
pub mod results;
pub mod system;
