//! Results and iterations as CSV, row by row, to any writer.

use std::io::{Error, Write};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use lexical_core::WriteFloatOptions;
use lexical_core::format::STANDARD;
use ttb_coupling::{Outcome, StepInfo};

use crate::error::RunError;
use crate::observe::{Begin, GO_ON, Moment, Observer};

/// How numbers are written: with 17 significant digits, so that reading them gives the same bits; a few times faster than
/// the standard library, and a row has dozens of them.
const DIGITS: WriteFloatOptions =
    WriteFloatOptions::builder().min_significant_digits(NonZeroUsize::new(17)).build_strict();

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
}

impl<W: Write> ResultsCsv<W> {
    /// Writes every `every`-th step to a writer that is called `name` in messages.
    pub fn new(writer: W, name: &str, every: u64) -> Self {
        Self { rows: Rows::new(writer, name), every: every.max(1), last: 0 }
    }
}

impl<W: Write> Observer for ResultsCsv<W> {
    fn start(&mut self, begin: &Begin) -> Result<(), RunError> {
        self.last = begin.axis.steps();
        let names: Vec<String> = begin.columns.iter().map(ToString::to_string).collect();
        self.rows.header(std::iter::once("time").chain(names.iter().map(String::as_str)))
    }

    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        if moment.n.is_multiple_of(self.every) || moment.n == self.last {
            self.rows.number(moment.t);
            moment.row.iter().for_each(|x| self.rows.number(*x));
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
        Self(Rows::new(writer, name))
    }

    fn row(&mut self, t: f64, info: &StepInfo, seconds: f64) -> Result<(), RunError> {
        let rows = &mut self.0;
        rows.number(t);
        rows.text(format_args!("{}", info.iterations));
        rows.number(info.residual);
        rows.number(info.contraction);
        let converged = u8::from(info.outcome == Outcome::Converged);
        rows.text(format_args!("{},{},{converged}", info.roll_backs, info.halvings));
        rows.text(format_args!("{seconds:.6e}"));
        rows.text(format_args!("{},{},{}", info.method.name(), info.train_track_trials, info.rescues));
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
}

impl<W: Write> Rows<W> {
    fn new(writer: W, name: &str) -> Self {
        Self { writer, name: name.into(), row: Vec::new() }
    }

    /// The header goes through the csv crate: foreign names may need quotes.
    fn header<'a>(&mut self, names: impl Iterator<Item = &'a str>) -> Result<(), RunError> {
        let mut header = csv::Writer::from_writer(Vec::new());
        let written = header.write_record(names).map_err(Error::from);
        let bytes = written.and_then(|()| header.into_inner().map_err(|e| e.into_error()));
        let written = bytes.and_then(|bytes| self.writer.write_all(&bytes));
        written.map_err(|source| failed(&self.name, source))
    }

    fn number(&mut self, x: f64) {
        self.comma();
        let mut digits = [0; DIGITS.buffer_size_const::<f64, STANDARD>()];
        self.row.extend_from_slice(lexical_core::write_with_options::<_, STANDARD>(x, &mut digits, &DIGITS));
    }

    fn text(&mut self, text: std::fmt::Arguments) {
        self.comma();
        // Writing to memory does not fail.
        let _ = self.row.write_fmt(text);
    }

    fn comma(&mut self) {
        if !self.row.is_empty() {
            self.row.push(b',');
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
