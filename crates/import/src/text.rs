//! Files of text that are read as a whole, bounded.

use std::fs::File;
use std::io::{Error, Read, Result};
use std::path::Path;

/// Most bytes of a text: far more than any scenario, model or map has.
const MOST: u64 = 1 << 30;
/// Bytes of the beginning in which a text has no zero byte.
const HEAD: usize = 4096;

/// As [`text`], but of a regular file only: a pipe that a file names would be waited for.
///
/// # Errors
/// As there; it is no regular file.
pub fn text_of_file(path: &Path) -> Result<String> {
    if std::fs::metadata(path)?.is_file() { text(path) } else { Err(Error::other("not a regular file")) }
}

/// Reads a text of UTF-8: a regular file, or a pipe that someone writes to and closes.
///
/// # Errors
/// It cannot be read; it is a device, no text, or endless.
pub fn text(path: &Path) -> Result<String> {
    let mut file = File::open(path)?;
    let kind = file.metadata()?.file_type();
    if kind.is_dir() {
        return Err(Error::other("it is a folder"));
    }
    let mut bytes = Vec::new();
    Read::by_ref(&mut file).take(HEAD as u64).read_to_end(&mut bytes)?;
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(Error::other("it is UTF-16: save it as UTF-8"));
    }
    if bytes.contains(&0) {
        return Err(Error::other("it is no text: it has bytes of value 0"));
    }
    file.take(MOST).read_to_end(&mut bytes)?;
    if bytes.len() as u64 >= MOST {
        return Err(Error::other(format!("it is longer than {MOST} bytes, or endless")));
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].iter().filter(|byte| **byte == b'\n').count() + 1;
        Error::other(format!("it is not UTF-8, first in line {line}"))
    })
}
