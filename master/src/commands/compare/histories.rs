//! histories.csv: the four quantities of every row over time, as the figures draw them.

use std::fmt::Write as _;
use std::path::Path;

use crate::error::Error;
use crate::files;
use crate::results::ran::{QUANTITIES, Ran};

/// Writes a line for every step of every row: method, step, time, the quantities; SI units.
pub fn write<'a>(rows: impl Iterator<Item = &'a Ran>, path: &Path) -> Result<(), Error> {
    let mut text = String::from("method,step_s,time");
    // Writing to a string does not fail.
    for of in &QUANTITIES {
        let _ = write!(text, ",{}", of.key.replace('-', "_"));
    }
    text.push('\n');
    for ran in rows {
        for (i, t) in ran.time.iter().enumerate() {
            let _ = write!(text, "\"{}\",{},{t}", ran.method, ran.step);
            for history in &ran.histories {
                let _ = write!(text, ",{}", history[i]);
            }
            text.push('\n');
        }
    }
    files::write(path, text.as_bytes())
}
