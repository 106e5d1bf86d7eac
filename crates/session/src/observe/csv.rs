//! Results and iterations as CSV, row by row, to any writer.
//!
//! Times are written with 15 significant digits, the shortest form of t = n h: 0.009, where the product of binary numbers is
//! 0.009000000000000001.

use std::io::{Error, Write};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use lexical_core::WriteFloatOptions;
use lexical_core::format::STANDARD;
use ttb_coupling::{Outcome, StepInfo};
use ttb_scenario::types::{ALL_DIGITS, Csv, Decimal, Separator};

use crate::error::RunError;
use crate::observe::chosen::chosen;
use crate::observe::{Begin, GO_ON, Moment, Observer};

/// Digits of a time: as many as a product n h is right to.
const TIME_DIGITS: usize = 15;
/// Digits of a duration that was measured.
const SECONDS_DIGITS: usize = 7;
/// Room for a number in any form.
const ROOM: usize = 64;

/// Columns of the iterations.
const ITERATIONS: [&str; 13] = [
    "time",
    "iterations",
    "residual",
    "contraction",
    "roll_backs",
    "halvings",
    "converged",
    "seconds",
    "method",
    "train_track_trials",
    "rescues",
    "work",
    "work_imbalance",
];

/// Time and all columns, every few steps and at the last one.
pub struct ResultsCsv<W: Write> {
    rows: Rows<W>,
    every: u64,
    last: u64,
    patterns: Vec<String>,
    /// Places of the columns that are written.
    chosen: Vec<usize>,
}

impl<W: Write> ResultsCsv<W> {
    /// Writes every `every`-th step to a writer that is called `name` in messages.
    pub fn new(writer: W, name: &str, every: u64) -> Self {
        let rows = Rows::new(writer, name, Csv::default());
        Self { rows, every: every.max(1), last: 0, patterns: Vec::new(), chosen: Vec::new() }
    }

    /// Only the columns that are called so, in another form.
    pub fn with(self, columns: &[String], csv: Csv) -> Self {
        Self { patterns: columns.to_vec(), rows: Rows { form: Form::new(csv), ..self.rows }, ..self }
    }
}

impl<W: Write> Observer for ResultsCsv<W> {
    fn start(&mut self, begin: &Begin) -> Result<(), RunError> {
        self.last = begin.axis.steps();
        self.chosen = chosen(begin.columns, &self.patterns)?;
        let names: Vec<String> = self.chosen.iter().map(|i| begin.columns[*i].to_string()).collect();
        self.rows.header(std::iter::once("time").chain(names.iter().map(String::as_str)))
    }

    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        if moment.n.is_multiple_of(self.every) || moment.n == self.last {
            self.rows.time(moment.t);
            self.chosen.iter().for_each(|i| self.rows.number(moment.row[*i]));
            self.rows.end()?;
        }
        GO_ON
    }

    fn end(&mut self) -> Result<(), RunError> {
        self.rows.flush()
    }
}

/// One row a step.
pub struct IterationsCsv<W: Write>(Rows<W>);

impl<W: Write> IterationsCsv<W> {
    /// Writes to a writer that is called `name` in messages.
    pub fn new(writer: W, name: &str) -> Self {
        Self(Rows::new(writer, name, Csv::default()))
    }

    /// In another form.
    pub fn with(self, csv: Csv) -> Self {
        Self(Rows { form: Form::new(csv), ..self.0 })
    }

    fn row(&mut self, t: f64, info: &StepInfo, seconds: f64) -> Result<(), RunError> {
        let rows = &mut self.0;
        rows.time(t);
        rows.text(format_args!("{}", info.iterations));
        rows.number(info.residual);
        rows.number(info.contraction);
        let converged = u8::from(info.outcome == Outcome::Converged);
        rows.text(format_args!("{}", info.roll_backs));
        rows.text(format_args!("{}", info.halvings));
        rows.text(format_args!("{converged}"));
        rows.seconds(seconds);
        rows.text(format_args!("{}", info.method.name()));
        rows.text(format_args!("{}", info.train_track_trials));
        rows.text(format_args!("{}", info.rescues));
        rows.number(info.work.received);
        rows.number(info.work.residual + info.work.exchange);
        rows.end()
    }
}

impl<W: Write> Observer for IterationsCsv<W> {
    fn start(&mut self, _begin: &Begin) -> Result<(), RunError> {
        self.0.header(ITERATIONS.into_iter())
    }

    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        if let Some(info) = moment.info {
            self.row(moment.t, info, moment.timing.wall)?;
        }
        GO_ON
    }

    fn end(&mut self) -> Result<(), RunError> {
        self.0.flush()
    }
}

/// Rows of a file: each is put together in memory and written whole.
struct Rows<W: Write> {
    writer: W,
    name: String,
    row: Vec<u8>,
    form: Form,
}

/// How numbers are written; a few times faster than by the standard library, and a row has dozens of them.
struct Form {
    separator: u8,
    decimal: u8,
    /// Of every number but times; `None`: all digits of every number, zeros at the end, too.
    digits: Option<WriteFloatOptions>,
    all: WriteFloatOptions,
    time: WriteFloatOptions,
    seconds: WriteFloatOptions,
}

impl Form {
    fn new(csv: Csv) -> Self {
        let separator = match csv.separator {
            Separator::Comma => b',',
            Separator::Semicolon => b';',
            Separator::Tab => b'\t',
        };
        let decimal = match csv.decimal {
            Decimal::Point => b'.',
            Decimal::Comma => b',',
        };
        let options = |digits| {
            WriteFloatOptions::builder().max_significant_digits(NonZeroUsize::new(digits)).decimal_point(decimal)
        };
        Self {
            separator,
            decimal,
            digits: (csv.digits < ALL_DIGITS).then(|| options(csv.digits).build_strict()),
            all: options(ALL_DIGITS).min_significant_digits(NonZeroUsize::new(ALL_DIGITS)).build_strict(),
            time: options(TIME_DIGITS).build_strict(),
            seconds: options(SECONDS_DIGITS).build_strict(),
        }
    }
}

/// Appends a number.
fn append(row: &mut Vec<u8>, x: f64, options: &WriteFloatOptions) {
    let mut room = [0; ROOM];
    row.extend_from_slice(lexical_core::write_with_options::<_, STANDARD>(x, &mut room, options));
}

/// Appends a number without zeros at the end of its decimals.
fn append_trimmed(row: &mut Vec<u8>, x: f64, options: &WriteFloatOptions, decimal: u8) {
    let begin = row.len();
    append(row, x, options);
    let number = &row[begin..];
    let Some(point) = number.iter().position(|byte| *byte == decimal) else { return };
    let end = number.iter().position(|byte| *byte == b'e').unwrap_or(number.len());
    let zeros = number[point + 2..end].iter().rev().take_while(|byte| **byte == b'0').count();
    row.drain(begin + end - zeros..begin + end);
}

impl<W: Write> Rows<W> {
    fn new(writer: W, name: &str, csv: Csv) -> Self {
        Self { writer, name: name.into(), row: Vec::new(), form: Form::new(csv) }
    }

    /// The header goes through the csv crate: foreign names may need quotes.
    fn header<'a>(&mut self, names: impl Iterator<Item = &'a str>) -> Result<(), RunError> {
        let mut header = csv::WriterBuilder::new().delimiter(self.form.separator).from_writer(Vec::new());
        let written = header.write_record(names).map_err(Error::from);
        let bytes = written.and_then(|()| header.into_inner().map_err(|e| e.into_error()));
        let written = bytes.and_then(|bytes| self.writer.write_all(&bytes));
        written.map_err(|source| failed(&self.name, source))
    }

    fn number(&mut self, x: f64) {
        self.separate();
        match &self.form.digits {
            None => append(&mut self.row, x, &self.form.all),
            Some(options) => append_trimmed(&mut self.row, x, options, self.form.decimal),
        }
    }

    fn time(&mut self, t: f64) {
        self.separate();
        append_trimmed(&mut self.row, t, &self.form.time, self.form.decimal);
    }

    /// A duration that was measured.
    fn seconds(&mut self, seconds: f64) {
        self.separate();
        append_trimmed(&mut self.row, seconds, &self.form.seconds, self.form.decimal);
    }

    fn text(&mut self, text: std::fmt::Arguments) {
        self.separate();
        // Writing to memory does not fail.
        let _ = self.row.write_fmt(text);
    }

    fn separate(&mut self) {
        if !self.row.is_empty() {
            self.row.push(self.form.separator);
        }
    }

    fn end(&mut self) -> Result<(), RunError> {
        self.row.push(b'\n');
        let written = self.writer.write_all(&self.row);
        self.row.clear();
        written.map_err(|source| failed(&self.name, source))
    }

    fn flush(&mut self) -> Result<(), RunError> {
        self.writer.flush().map_err(|source| failed(&self.name, source))
    }
}

#[cold]
fn failed(name: &str, source: Error) -> RunError {
    RunError::Write { what: name.into(), source }
}
