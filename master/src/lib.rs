//! The commands of `ttb` as a library, from the lowest room up:
//!
//! ```text
//! parts                   files that are being written
//! error, signals          what ends a command, from inside and from outside
//! files, clock            files that are whole or not there, processor time
//! cli                     the command line
//! connect                 from FMU files to two coupled subsystems
//! results                 what a run leaves: rows, peaks, summary
//! pictures                histories and errors drawn as SVG and PNG
//! view                    files for viewers of finite-element models
//! prepare                 from a scenario to its FMUs and its steps
//! system                  system structures (SSP): written, read
//! assess                  from runs to verdicts
//! commands                one file or folder a verb
//! ```
//!
//! Only the commands print. Exit codes are those of [`error::Error::code`].

/// Prints a line; a reader that has gone away (`ttb schema | head`) is no error.
macro_rules! say {
    ($($text:tt)*) => {{
        use std::io::Write;
        let _ = writeln!(std::io::stdout(), "{}", $crate::printed::printable(&format!($($text)*)));
    }};
}

/// Prints a line for the user on standard error; a terminal that has gone away is no error.
#[macro_export]
macro_rules! note {
    ($($text:tt)*) => {{
        use std::io::Write;
        let _ = writeln!(std::io::stderr(), "{}", $crate::printed::printable(&format!($($text)*)));
    }};
}

pub use ttb_fmi::text as printed;

pub mod assess;
pub mod cli;
pub mod clock;
pub mod commands;
pub mod connect;
pub mod error;
pub mod files;
pub mod parts;
pub mod pictures;
pub mod prepare;
pub mod results;
pub mod signals;
pub mod system;
pub mod view;
