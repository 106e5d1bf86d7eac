//! A file of rows that holds whole ones, whatever happens.

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Rows that are written at once, bytes.
const BUFFER: usize = 1 << 16;

/// Takes a row, or several, with every call of `write`, and puts them on the disk in larger parts. On a disk that is full as
/// many rows stay as there is room for.
pub struct Rows {
    path: PathBuf,
    /// Made with the first row.
    file: Option<File>,
    rows: Vec<u8>,
    /// Length of the file, whole rows.
    length: u64,
}

impl Rows {
    /// Of a new file, which is made when there is something to write.
    pub fn of(path: &Path) -> Self {
        Self { path: path.to_path_buf(), file: None, rows: Vec::new(), length: 0 }
    }
}

impl Write for Rows {
    fn write(&mut self, rows: &[u8]) -> io::Result<usize> {
        self.rows.extend_from_slice(rows);
        // The header at once: there is something to look at from the beginning.
        if self.length == 0 || self.rows.len() >= BUFFER {
            self.flush()?;
        }
        Ok(rows.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        let file = match &mut self.file {
            Some(file) => file,
            None if self.rows.is_empty() => return Ok(()),
            file => file.insert(OpenOptions::new().write(true).create(true).truncate(true).open(&self.path)?),
        };
        let mut written = 0;
        let ended = loop {
            if written == self.rows.len() {
                break Ok(());
            }
            match file.write(&self.rows[written..]) {
                Ok(0) => break Err(io::ErrorKind::WriteZero.into()),
                Ok(count) => written += count,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => break Err(error),
            }
        };
        let whole = self.rows[..written].iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
        self.length += whole as u64;
        if ended.is_err() {
            // The part of a row that still had room.
            let _ = file.set_len(self.length);
        }
        self.rows.clear();
        ended
    }
}
