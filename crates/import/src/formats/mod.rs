//! The formats of matrix files.
//!
//! A scan passes over a file and hands every entry on, from 0; with `VALUES` off it skips the numbers, which is enough
//! to count.

mod array;
mod cards;
mod dmig;
mod foreign;
mod harwell;
mod labels;
mod market;
mod triplets;

use std::io::Read;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::collect::Symmetry;
use crate::dof::Dof;
use crate::input::Input;
use crate::lines::Lines;
use crate::number::{Fields, real};
use crate::numbering::Numbering;
use crate::problem::{Report, Stop};

/// How a matrix is written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Format {
    /// Matrix Market, coordinate or array format.
    MatrixMarket,
    /// Lines of row, column, value without header: CalculiX's .sti and .mas, Abaqus' COORDINATE.
    Triplets,
    /// Lines of node, freedom, node, freedom, value: Abaqus' MATRIX INPUT.
    Labels,
    /// Harwell–Boeing: what ANSYS' HBMAT writes as ASCII, or SciPy's `hb_write`.
    HarwellBoeing,
    /// DMIG in wide fields, as Nastran punches it.
    Dmig,
}

/// What is known before a file is scanned.
#[derive(Clone, Copy)]
pub(crate) struct Known<'a> {
    /// Largest number of rows that the file can be about.
    pub most: u64,
    /// Number of rows, if a file before has told.
    pub size: Option<u32>,
    /// Rows by label.
    pub numbering: Option<&'a Numbering>,
    /// Length of the file in bytes.
    pub bytes: u64,
}

impl Known<'_> {
    /// Checks the number of rows that a header announces.
    fn announced(&self, rows: u64, line: u64, report: &mut Report) -> Result<u32, Stop> {
        if let Some(size) = self.size.filter(|size| u64::from(*size) != rows) {
            let found = format!("{rows} instead of {size} rows");
            return Err(report.fatal(Some(line), "the matrices must have as many rows as the stiffness matrix", found));
        }
        if rows == 0 || rows > self.most {
            let found = format!("{rows} rows in a file of {} bytes", self.bytes);
            return Err(report.fatal(Some(line), "the header must announce what the file can hold", found));
        }
        Ok(rows as u32) // `most` is below 2³¹
    }

    /// A row or column number of the file as index from 0.
    #[inline]
    fn index(&self, number: u64) -> Option<u32> {
        let most = self.size.map_or(self.most, u64::from);
        (1..=most).contains(&number).then(|| (number - 1) as u32)
    }

    /// Notes an index out of range.
    fn outside(&self, line: u64, found: &[u64], report: &mut Report) -> Result<(), Stop> {
        let most = self.size.map_or(self.most, u64::from);
        let zero = if found.contains(&0) { "; rows and columns count from 1" } else { "" };
        let found: Vec<String> = found.iter().map(u64::to_string).collect();
        let found = format!("{}{zero}", found.join(", "));
        report.line(line, format!("row and column must lie between 1 and {most}"), found)
    }
}

/// What a file says of itself.
pub(crate) struct Heading {
    /// Number of rows.
    pub rows: Option<u32>,
    pub symmetry: Symmetry,
}

const RULE: &str = "the format must be Matrix Market, Harwell-Boeing, DMIG, or lines of 3 or 5 numbers";
/// Fields that are counted on a line.
const MANY: usize = 12;
/// Lines in which a first entry of DMIG is looked for.
const LAST: u64 = 100_000;

impl Format {
    /// Tells the format from a file's first lines.
    pub(crate) fn detect(input: &Input, report: &mut Report) -> Result<Self, Stop> {
        let mut head = Vec::new();
        // What cannot be read is said below.
        let _ = input.open().and_then(|file| file.take(foreign::HEAD).read_to_end(&mut head));
        if !market::is_banner(&head)
            && let Some(known) = foreign::recognise(&head)
        {
            return Err(report.fatal(None, RULE, known));
        }
        let mut lines = Lines::open(input, report)?;
        let mut first_data = None;
        let mut third = Vec::new();
        while let Some(line) = lines.next(report)? {
            if line.number == 1 && market::is_banner(line.text) {
                return Ok(Self::MatrixMarket);
            }
            if line.number == 3 {
                third = line.text.to_vec();
            }
            if line.number == 4 && harwell::is_type(&third) && line.text.trim_ascii_start().starts_with(b"(") {
                return Ok(Self::HarwellBoeing);
            }
            if dmig::is_entry(line.text) {
                return Ok(Self::Dmig);
            }
            if triplets::is_comment(line.text) {
                triplets::remark(&line, report)?;
            } else if first_data.is_none() {
                let mut fields = Fields::new(line.text);
                let number = real(fields.next()).is_some();
                let count = 1 + std::iter::from_fn(|| Some(fields.next()).filter(|f| !f.is_empty())).take(MANY).count();
                first_data = Some((line.number, count, number));
            }
            // Nastran's punch begins with titles and grid points.
            let numbers = first_data.is_some_and(|(.., number)| number);
            if numbers && line.number >= 4 || line.number >= LAST {
                break;
            }
        }
        match first_data {
            Some((_, 3, _)) => Ok(Self::Triplets),
            Some((_, 5, _)) => Ok(Self::Labels),
            Some((line, count @ (1 | 2), true)) => {
                let found = format!("{count} fields; a line of sizes belongs into Matrix Market, below its first line");
                Err(report.fatal(Some(line), RULE, found))
            }
            Some((line, count, true)) if count > 5 => {
                let many = if count > MANY { "more than " } else { "" };
                let found =
                    format!("{many}{} fields; a matrix in full is written by scipy.io.mmwrite", count.min(MANY));
                Err(report.fatal(Some(line), RULE, found))
            }
            Some((line, count, _)) => Err(report.fatal(Some(line), RULE, format!("{} fields", count.min(MANY)))),
            None => Err(report.fatal(None, "the file must hold a matrix", "it holds no line of data")),
        }
    }

    /// Passes over the file and hands entries (row, column, value) on.
    pub(crate) fn scan<const VALUES: bool>(
        self,
        input: &Input,
        known: Known<'_>,
        report: &mut Report,
        entry: impl FnMut(u32, u32, f64),
    ) -> Result<Heading, Stop> {
        match self {
            Self::MatrixMarket => market::scan::<VALUES>(input, known, report, entry),
            Self::Triplets => triplets::scan::<VALUES>(input, known, report, entry),
            Self::Labels => labels::scan::<VALUES>(input, known, report, entry),
            Self::HarwellBoeing => harwell::scan::<VALUES>(input, known, report, entry),
            Self::Dmig => dmig::scan::<VALUES>(input, known.numbering, report, entry),
        }
    }

    /// The labels that a file of this format carries, sorted; `None` if its rows are numbers.
    pub(crate) fn labels(self, input: &Input, report: &mut Report) -> Result<Option<Vec<Dof>>, Stop> {
        match self {
            Self::Labels => labels::collect(input, report).map(Some),
            Self::Dmig => dmig::collect(input, report).map(Some),
            _ => Ok(None),
        }
    }
}
