//! Histories of the few runs that are kept whole: `history/<run_id>.csv`.

use std::fs::{self, File};
use std::io::{BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;

/// Name of the folder.
const FOLDER: &str = "history";

/// Histories of one run: columns over time, SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    /// t, s.
    pub time: Vec<f64>,
    /// Name, unit and values of each column.
    pub values: Vec<(String, String, Vec<f64>)>,
}

impl History {
    /// Time and all columns: name, unit, values.
    pub fn columns(&self) -> impl Iterator<Item = (&str, &str, &[f64])> {
        let time = [("time", "s", self.time.as_slice())];
        time.into_iter().chain(self.values.iter().map(|(name, unit, x)| (name.as_str(), unit.as_str(), x.as_slice())))
    }

    /// Writes it for a run, whole or not at all. The header has the unit after every name: `point[mid].acceleration [m/s2]`.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&self, campaign: &Path, id: &str) -> Result<(), Error> {
        let path = place(campaign, id);
        let folder = campaign.join(FOLDER);
        fs::create_dir_all(&folder).map_err(Error::io(&folder))?;
        let part = path.with_extension("part");
        let write = || {
            let mut rows = csv::Writer::from_writer(BufWriter::new(File::create(&part)?));
            rows.write_record(self.columns().map(|(name, unit, _)| format!("{name} [{unit}]")))?;
            for i in 0..self.time.len() {
                rows.write_record(self.columns().map(|(_, _, x)| x.get(i).copied().unwrap_or(f64::NAN).to_string()))?;
            }
            rows.into_inner().map_err(|error| error.into_error())?.flush()?;
            fs::rename(&part, &path)
        };
        write().map_err(Error::io(&path))
    }

    /// Reads what was written for a run; `None` if nothing was.
    ///
    /// # Errors
    /// It is there and cannot be read.
    pub fn read(campaign: &Path, id: &str) -> Result<Option<Self>, Error> {
        let path = place(campaign, id);
        let file = match File::open(&path) {
            Ok(file) => file,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(Error::io(&path)(error)),
        };
        Self::parse(file).map(Some).map_err(Error::io(&path))
    }

    /// Whether a run's history is there.
    #[must_use]
    pub fn is_kept(campaign: &Path, id: &str) -> bool {
        place(campaign, id).is_file()
    }

    /// What [`History::write`] has written, from wherever it is.
    ///
    /// # Errors
    /// It is no such table.
    pub fn parse(file: impl Read) -> std::io::Result<Self> {
        let mut rows = csv::Reader::from_reader(file);
        let mut columns: Vec<(String, String, Vec<f64>)> = Vec::new();
        for name in rows.headers()? {
            let (name, unit) = name.rsplit_once(" [").unwrap_or((name, ""));
            columns.push((name.into(), unit.trim_end_matches(']').into(), Vec::new()));
        }
        for row in rows.records() {
            for ((_, _, values), text) in columns.iter_mut().zip(row?.iter()) {
                values.push(text.parse().map_err(|_| std::io::Error::other(format!("`{text}` must be a number")))?);
            }
        }
        if columns.is_empty() {
            return Err(std::io::Error::other("it has no column"));
        }
        let time = columns.remove(0).2;
        Ok(Self { time, values: columns })
    }
}

fn place(campaign: &Path, id: &str) -> PathBuf {
    campaign.join(FOLDER).join(format!("{id}.csv"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_history_is_read_as_it_was_written() {
        let folder = tempfile::tempdir().unwrap();
        let column = ("point[a,b].acceleration".to_string(), "m/s2".to_string(), vec![0.1, -1e-17]);
        let history = History { time: vec![0.0, 1e-3], values: vec![column] };
        assert_eq!(History::read(folder.path(), "0").unwrap(), None);
        history.write(folder.path(), "0").unwrap();
        assert_eq!(History::read(folder.path(), "0").unwrap(), Some(history));
    }
}
