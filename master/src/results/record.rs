//! What a run leaves behind step by step: results.csv and iterations.csv, and every value at hand for peaks and plots.

use std::collections::HashSet;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use lexical_core::WriteFloatOptions;
use lexical_core::format::STANDARD;
use ttb_contract::names::parse_support;
use ttb_contract::{Signal, Subsystem};
use ttb_coupling::StepInfo;
use ttb_coupling::iteration::Outcome;
use ttb_fmi::FmuSubsystem;

use crate::connect::connected::BridgeSide;
use crate::error::Error;

/// How numbers are written: a few times faster than the standard library, and a row has dozens of them.
const DIGITS: WriteFloatOptions =
    WriteFloatOptions::builder().min_significant_digits(NonZeroUsize::new(17)).build_strict();

/// Columns of iterations.csv.
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

/// A recorded variable.
#[derive(Clone, Debug)]
pub struct Column {
    /// FMI name.
    pub name: String,
    /// Unit from the FMU's description, empty if it names none.
    pub unit: String,
}

/// Columns, the present row and the open files.
pub struct Recorder {
    /// All recorded variables: those of the train–track FMU, then the bridge's.
    pub columns: Vec<Column>,
    /// Their present values.
    pub row: Vec<f64>,
    /// How many of them are the train–track FMU's.
    of_train_track: usize,
    results: Table,
    iterations: Table,
    every: u64,
    last: u64,
}

impl Recorder {
    /// Opens both files in `folder` and writes their headers. Variables of the supports are left out unless asked for.
    pub fn new(
        folder: &Path,
        train_track: &mut FmuSubsystem,
        bridge: &mut BridgeSide,
        supports: bool,
        every: usize,
        last: u64,
    ) -> Result<Self, Error> {
        let wanted = |signal: &Signal| supports || parse_support(&signal.name).is_none();
        let column = |Signal { name, unit }: Signal| Column { name, unit };
        let mut columns: Vec<Column> = train_track.record(&wanted).into_iter().map(column).collect();
        let of_train_track = columns.len();
        columns.extend(bridge.record(&wanted).into_iter().map(column));
        // Foreign FMUs on either side may have outputs of one name.
        let (others, own) = columns.split_at_mut(of_train_track);
        let taken: HashSet<&str> = others.iter().map(|c| c.name.as_str()).collect();
        for column in own.iter_mut().filter(|c| taken.contains(c.name.as_str())) {
            column.name = format!("{}.{}", bridge.name(), column.name);
        }
        let names = columns.iter().map(|c| c.name.as_str());
        let results = Table::create(&folder.join("results.csv"), std::iter::once("time").chain(names))?;
        let iterations = Table::create(&folder.join("iterations.csv"), ITERATIONS.into_iter())?;
        Ok(Self {
            row: vec![0.0; columns.len()],
            columns,
            of_train_track,
            results,
            iterations,
            every: every as u64,
            last,
        })
    }

    /// Reads all recorded variables after step `n`, which ended at `t`, and writes the row if it is due.
    pub fn record(
        &mut self,
        train_track: &mut FmuSubsystem,
        bridge: &mut BridgeSide,
        n: u64,
        t: f64,
    ) -> Result<(), Error> {
        let failed = |e: ttb_contract::Failure| Error::Fmu(e.to_string());
        let (first, second) = self.row.split_at_mut(self.of_train_track);
        train_track.read(first).and_then(|()| bridge.read(second)).map_err(failed)?;
        if n.is_multiple_of(self.every) || n == self.last {
            self.results.number(t);
            self.row.iter().for_each(|x| self.results.number(*x));
            self.results.end_row()?;
        }
        Ok(())
    }

    /// Writes the row of a step in iterations.csv; `seconds` is the step's wall time.
    pub fn iteration(&mut self, t: f64, info: &StepInfo, seconds: f64) -> Result<(), Error> {
        let table = &mut self.iterations;
        table.number(t);
        table.text(format_args!("{}", info.iterations));
        table.number(info.residual);
        table.number(info.contraction);
        let converged = u8::from(info.outcome == Outcome::Converged);
        table.text(format_args!("{},{},{converged}", info.roll_backs, info.halvings));
        table.text(format_args!("{seconds:.6e}"));
        table.text(format_args!("{},{},{}", info.method.name(), info.train_track_trials, info.rescues));
        table.number(info.work.received);
        table.number(info.work.residual + info.work.exchange);
        table.end_row()
    }

    /// Position of a column.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|c| c.name == name)
    }

    /// Everything on disk.
    pub fn flush(&mut self) -> Result<(), Error> {
        self.results.flush()?;
        self.iterations.flush()
    }
}

/// Real outputs of an FMU that are to be recorded; appends their columns.
/// A CSV file of numbers; rows are put together in one reused buffer.
struct Table {
    path: PathBuf,
    file: BufWriter<File>,
    row: Vec<u8>,
}

impl Table {
    /// The header goes through the csv crate: foreign names may need quotes.
    fn create<'a>(path: &Path, header: impl Iterator<Item = &'a str>) -> Result<Self, Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let written = writer.write_record(header).map_err(std::io::Error::from);
        let head = written.and_then(|()| writer.into_inner().map_err(|e| e.into_error())).map_err(Error::io(path))?;
        let mut file = BufWriter::new(File::create(path).map_err(Error::io(path))?);
        file.write_all(&head).map_err(Error::io(path))?;
        Ok(Self { path: path.to_path_buf(), file, row: Vec::new() })
    }
    /// A number with 17 significant digits: reading it back gives the same bits.
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
    fn end_row(&mut self) -> Result<(), Error> {
        self.row.push(b'\n');
        let written = self.file.write_all(&self.row);
        self.row.clear();
        written.map_err(Error::io(&self.path))
    }
    fn flush(&mut self) -> Result<(), Error> {
        self.file.flush().map_err(Error::io(&self.path))
    }
}
