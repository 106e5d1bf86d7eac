//! Tables: CSV files with a header line.

use crate::input::Input;
use crate::lines::Lines;
use crate::number::{real, whole};
use crate::problem::{Report, Stop, excerpt};

/// A table while it is read.
pub(crate) struct Table {
    lines: Lines,
    /// Names of the columns, lower case.
    header: Vec<String>,
    line: u64,
    fields: Vec<String>,
}

/// Position of a column.
#[derive(Clone, Copy)]
pub(crate) struct Column(usize);

/// Fields of a line, apart by commas, semicolons or tabs; a field may stand in quotes.
fn split(text: &[u8]) -> Vec<String> {
    let mut fields = vec![Vec::new()];
    let mut quoted = false;
    for &byte in text {
        match byte {
            b'"' => quoted = !quoted,
            b',' | b';' | b'\t' if !quoted => fields.push(Vec::new()),
            _ => fields.last_mut().into_iter().for_each(|field| field.push(byte)),
        }
    }
    fields.iter().map(|field| String::from_utf8_lossy(field).trim().to_owned()).collect()
}

impl Table {
    /// Opens a table and reads its header; columns other than `allowed` are refused.
    pub fn open(input: &Input, allowed: &[&str], report: &mut Report) -> Result<Self, Stop> {
        let mut lines = Lines::open(input, report)?;
        let first = lines.expect("a header line", report)?;
        let text = first.text.strip_prefix("\u{feff}".as_bytes()).unwrap_or(first.text);
        let header: Vec<String> = split(text).iter().map(|name| name.to_lowercase()).collect();
        for (i, name) in header.iter().enumerate() {
            let rule = format!("columns must be among {}, each at most once", allowed.join(", "));
            if !allowed.contains(&name.as_str()) || header[..i].contains(name) {
                return Err(report.fatal(Some(1), rule, excerpt(name.as_bytes())));
            }
        }
        Ok(Self { lines, header, line: 1, fields: Vec::new() })
    }

    /// A column, if it is there.
    pub fn column(&self, name: &str) -> Option<Column> {
        self.header.iter().position(|header| header == name).map(Column)
    }

    /// A column that must be there.
    pub fn needs(&self, name: &str, report: &mut Report) -> Result<Column, Stop> {
        let found = format!("columns {}", self.header.join(", "));
        self.column(name).ok_or_else(|| report.fatal(Some(1), format!("there must be a column {name}"), found))
    }

    /// The next line that is not empty and no remark (#).
    pub fn advance(&mut self, report: &mut Report) -> Result<bool, Stop> {
        while let Some(line) = self.lines.next(report)? {
            let text = line.text.trim_ascii();
            if text.is_empty() || text[0] == b'#' {
                continue;
            }
            self.fields = split(text);
            self.line = line.number;
            if self.fields.len() > self.header.len() {
                let found = format!("{} fields for {} columns", self.fields.len(), self.header.len());
                report.line(self.line, "a line must not have more fields than the header", found)?;
                continue;
            }
            return Ok(true);
        }
        Ok(false)
    }

    /// Number of the line.
    pub fn line(&self) -> u64 {
        self.line
    }

    /// A field; empty where the line ends before it.
    pub fn text(&self, column: Column) -> &str {
        self.fields.get(column.0).map_or("", String::as_str)
    }

    /// A field as a finite number, or a problem.
    pub fn real(&self, column: Column, report: &mut Report) -> Result<Option<f64>, Stop> {
        let value = real(self.text(column).as_bytes());
        self.check(value, column, "a finite number", report)
    }

    /// A field as a whole number ≥ 1, or a problem.
    pub fn count(&self, column: Column, report: &mut Report) -> Result<Option<u32>, Stop> {
        let value = whole(self.text(column).as_bytes()).and_then(|n| u32::try_from(n).ok()).filter(|n| *n > 0);
        self.check(value, column, "a whole number from 1", report)
    }

    /// Passes a value on, or notes that the field must be `what`.
    pub fn check<T>(
        &self,
        value: Option<T>,
        column: Column,
        what: &str,
        report: &mut Report,
    ) -> Result<Option<T>, Stop> {
        if value.is_none() {
            let rule = format!("{} must be {what}", self.header[column.0]);
            report.line(self.line, rule, excerpt(self.text(column).as_bytes()))?;
        }
        Ok(value)
    }
}
