//! Tables: CSV files with a header line, in one dialect for all of them.
//!
//! | | |
//! |---|---|
//! | fields | apart by `;`, a tab, `,` or blanks: by the first of these that the header has; or by what `sep=` says |
//! | quotes | as in RFC 4180: `"a, b"`, `""` for a quote inside |
//! | header | the first line that is no remark; capitals do not count, nor does a unit `[m]` or `(m)` |
//! | numbers | `1.5`, `1.5e3`, `1.5D+03`; `1,5` where commas do not separate, or in quotes; never both in a file |
//! | else | a mark of UTF-8 at the beginning, ends of lines of all kinds, empty lines, `#` before a remark |

mod dialect;

use std::io::{Cursor, Read};

use crate::input::Input;
use crate::number::{real, whole};
use crate::problem::{Report, Stop, excerpt};

use dialect::Dialect;

/// Most bytes of a table.
const MOST: u64 = 1 << 28;

/// A table while it is read.
pub(crate) struct Table {
    records: csv::ByteRecordsIntoIter<Box<dyn Read>>,
    dialect: Dialect,
    /// Names of the columns, lower case.
    pub header: Vec<String>,
    line: u64,
    fields: Vec<String>,
    /// The sign before decimals that was seen: a point or a comma.
    decimal: Option<(u8, u64)>,
}

/// Position of a column.
#[derive(Clone, Copy)]
pub(crate) struct Column(usize);

impl Table {
    /// Opens a table and reads its header; columns other than `allowed`, if any are named, are refused.
    pub fn open(input: &Input, allowed: Option<&[&str]>, report: &mut Report) -> Result<Self, Stop> {
        let unreadable = |report: &mut Report, e: std::io::Error| report.fatal(None, "the file cannot be read", e);
        let length = input.length().map_err(|e| unreadable(report, e))?;
        if length > MOST {
            return Err(report.fatal(None, format!("a table must have at most {MOST} bytes"), length));
        }
        let mut bytes = Vec::new();
        input.open().and_then(|file| file.take(MOST).read_to_end(&mut bytes)).map_err(|e| unreadable(report, e))?;
        let dialect = Dialect::of(&bytes, report)?;
        let reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .delimiter(dialect.separator)
            .from_reader(Box::new(Cursor::new(bytes.split_off(dialect.skip))) as Box<dyn Read>);
        let mut table = Self {
            records: reader.into_byte_records(),
            dialect,
            header: Vec::new(),
            line: 0,
            fields: Vec::new(),
            decimal: None,
        };
        if !table.record(report)? {
            return Err(report.fatal(Some(1), "a header line must follow", "the file ends here"));
        }
        let header: Vec<String> = table.fields.iter().map(|name| dialect::column_name(name)).collect();
        for (i, name) in header.iter().enumerate() {
            let empty = allowed.is_none() && name.is_empty();
            let unknown = allowed.is_some_and(|allowed| !allowed.contains(&name.as_str()));
            if unknown || header[..i].contains(name) && !empty {
                let list =
                    allowed.map_or_else(|| "different".into(), |allowed| format!("among {}", allowed.join(", ")));
                let rule = format!("columns must be {list}, each at most once");
                return Err(report.fatal(Some(table.line), rule, excerpt(name.as_bytes())));
            }
        }
        table.header = header;
        Ok(table)
    }

    /// A column, if it is there.
    pub fn column(&self, name: &str) -> Option<Column> {
        self.header.iter().position(|header| header == name).map(Column)
    }

    /// A column that must be there.
    pub fn needs(&self, name: &str, report: &mut Report) -> Result<Column, Stop> {
        let found = format!("columns {}", self.header.join(", "));
        self.column(name).ok_or_else(|| report.fatal(Some(self.line), format!("there must be a column {name}"), found))
    }

    /// The next line that is not empty and no remark (#).
    pub fn advance(&mut self, report: &mut Report) -> Result<bool, Stop> {
        while self.record(report)? {
            // Spreadsheets end their lines with empty fields.
            while self.fields.len() > self.header.len() && self.fields.last().is_some_and(String::is_empty) {
                self.fields.pop();
            }
            if self.fields.len() <= self.header.len() {
                return Ok(true);
            }
            let decimals = if self.dialect.separator == b',' {
                "; with commas before decimals, fields must be apart by semicolons"
            } else {
                ""
            };
            let found = format!("{} fields for {} columns{decimals}", self.fields.len(), self.header.len());
            report.line(self.line, "a line must not have more fields than the header", found)?;
        }
        Ok(false)
    }

    /// Reads a line into `fields`.
    fn record(&mut self, report: &mut Report) -> Result<bool, Stop> {
        for record in self.records.by_ref() {
            let record = record.map_err(|e| report.fatal(None, "the table cannot be read", e))?;
            self.line = record.position().map_or(0, csv::Position::line) + self.dialect.lines;
            let text = |field: &[u8]| String::from_utf8_lossy(field).trim().to_owned();
            self.fields.clear();
            let blanks = self.dialect.separator == b' ';
            self.fields.extend(record.iter().map(text).filter(|field| !(blanks && field.is_empty())));
            let first = self.fields.first().map_or("", String::as_str);
            if !first.starts_with('#') && self.fields.iter().any(|field| !field.is_empty()) {
                return Ok(true);
            }
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
    pub fn number(&mut self, column: Column, report: &mut Report) -> Result<Option<f64>, Stop> {
        let text = self.fields.get(column.0).map_or("", String::as_str);
        let (value, sign) = match real(text.as_bytes()) {
            Some(value) => (Some(value), text.contains('.').then_some(b'.')),
            None => (dialect::with_comma(text), Some(b',')),
        };
        if value.is_some()
            && let Some(sign) = sign
        {
            let (first, line) = *self.decimal.get_or_insert((sign, self.line));
            if first != sign {
                let rule = "points and commas before decimals must not be mixed";
                let found = format!("{}, and another in line {line}", excerpt(text.as_bytes()));
                return Err(report.fatal(Some(self.line), rule, found));
            }
        }
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
