//! Reading one matrix.

use crate::collect::{Counts, Filler, MOST_ROWS};
use crate::dof::Dof;
use crate::formats::{Format, Known};
use crate::input::Input;
use crate::matrix::SymmetricMatrix;
use crate::numbering::Numbering;
use crate::problem::{Problems, Report, Stop};

/// Least bytes for a row: every row has at least its diagonal entry, `1 1 1` or more.
const SHORTEST: u64 = 4;

/// How a file was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// Format that was recognised.
    pub format: Format,
    /// Its length.
    pub bytes: u64,
    /// Entries in it.
    pub entries: u64,
    /// Largest |a_ij − a_ji| relative to √(a_ii a_jj); 0 where one triangle was given.
    pub asymmetry: f64,
    /// Significant digits of the value that has most of them, at most 17: with how many the file was written.
    pub digits: u32,
}

/// A matrix and what is known of its file.
#[derive(Clone, Debug)]
pub struct Matrix {
    /// Its lower triangle.
    pub matrix: SymmetricMatrix,
    /// Node and direction of every row, where the file itself says so.
    pub labels: Option<Vec<Dof>>,
    /// How it was read.
    pub facts: Facts,
}

/// Reads a matrix; without `format` it is told from the file's beginning.
///
/// `size` is the number of rows where it is known from another matrix, `labels` node and direction of every row, which
/// [`Format::Labels`] needs to put its lines into that order.
///
/// # Errors
/// Everything that is wrong with the file, up to a limit.
pub fn read_matrix(
    input: &Input,
    format: Option<Format>,
    size: Option<u32>,
    labels: Option<&[Dof]>,
) -> Result<Matrix, Problems> {
    let mut report = Report::new(input.name());
    match read(input, format, size, labels, &mut report) {
        Ok(matrix) if report.problems.is_empty() => Ok(matrix),
        _ => Err(Problems(report.problems)),
    }
}

fn read(
    input: &Input,
    format: Option<Format>,
    size: Option<u32>,
    labels: Option<&[Dof]>,
    report: &mut Report,
) -> Result<Matrix, Stop> {
    let bytes = input.length().map_err(|e| report.fatal(None, "the file cannot be read", e))?;
    let format = format.map_or_else(|| Format::detect(input, report), Ok)?;
    let own_labels = if labels.is_none() { format.labels(input, report)? } else { None };
    let numbering = match (format, labels.or(own_labels.as_deref())) {
        (Format::Labels | Format::Dmig, Some(labels)) => Some(Numbering::new(labels)),
        _ => None,
    };
    let most = size.map_or((bytes / SHORTEST).min(MOST_ROWS), u64::from);
    let known = Known { most, size, numbering: numbering.as_ref(), bytes };

    let mut counts = Counts::default();
    let mut entries = 0_u64;
    let heading = format.scan::<false>(input, known, report, |i, j, _| {
        entries += 1;
        counts.add(i, j);
    })?;
    if !report.problems.is_empty() {
        // Once more with values, so that their problems are told too.
        report.problems.clear();
        format.scan::<true>(input, known, report, |_, _, _| {})?;
        return Err(Stop);
    }
    let rows = heading.rows.or(size).unwrap_or(counts.size());
    if rows == 0 || entries == 0 {
        return Err(report.fatal(None, "the file must hold a matrix", "no entries"));
    }
    if size.is_none() && u64::from(rows) > entries {
        let found = format!("{rows} rows, {entries} entries");
        return Err(report.fatal(None, "every row must have a diagonal entry", found));
    }
    let mut filler = Filler::new(counts, rows);
    format.scan::<true>(input, known, report, |i, j, value| filler.add(i, j, value))?;
    if !report.problems.is_empty() {
        return Err(Stop);
    }
    let (matrix, asymmetry) = filler.finish(heading.symmetry, report)?;
    Ok(Matrix { matrix, labels: own_labels, facts: Facts { format, bytes, entries, asymmetry, digits: report.digits } })
}
