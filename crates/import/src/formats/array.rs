//! Matrix Market, array format: every value of a matrix, column by column; of a symmetric one from the diagonal down.

use super::{Heading, Known, triplets};
use crate::collect::Symmetry;
use crate::lines::Lines;
use crate::number::{Fields, real};
use crate::problem::{Report, Stop, excerpt};

/// Shortest value: a digit and a blank.
const SHORTEST: u64 = 2;

/// Reads on below the first line. Zeros off the diagonal are not handed on, so that both passes need the values.
pub(super) fn scan(
    lines: &mut Lines,
    known: &Known<'_>,
    symmetry: Symmetry,
    report: &mut Report,
    mut hand_on: impl FnMut(u32, u32, f64),
) -> Result<Heading, Stop> {
    let rows = size(lines, known, symmetry, report)?;
    let (mut i, mut j) = (0, 0);
    while let Some(line) = lines.next(report)? {
        if triplets::is_comment(line.text) {
            continue;
        }
        let mut fields = Fields::new(line.text);
        while let field = fields.next()
            && !field.is_empty()
        {
            if j == rows {
                let rule = format!("the header announces {rows} columns");
                return Err(report.fatal(Some(line.number), rule, "more values follow"));
            }
            let value = real(field);
            report.written(field);
            match value {
                Some(value) if value != 0.0 || i == j => hand_on(i, j, value),
                Some(_) => {}
                None => report.line(line.number, "values must be finite numbers", excerpt(field))?,
            }
            i += 1;
            if i == rows {
                j += 1;
                i = if symmetry == Symmetry::Triangle { j } else { 0 };
            }
        }
    }
    if j < rows {
        let rule = format!("the header announces {rows} columns");
        let found = format!("the file ends in column {}, at row {}", j + 1, i + 1);
        return Err(report.fatal(Some(lines.number()), rule, found));
    }
    Ok(Heading { rows: Some(rows), symmetry })
}

/// Number of rows, as far as the file can hold them.
fn size(lines: &mut Lines, known: &Known<'_>, symmetry: Symmetry, report: &mut Report) -> Result<u32, Stop> {
    loop {
        let line = lines.expect("a line with rows and columns", report)?;
        if triplets::is_comment(line.text) {
            continue;
        }
        let mut fields = Fields::new(line.text);
        let (Some(rows), Some(columns), true) = (fields.whole(), fields.whole(), fields.end()) else {
            let rule = "the line after the comments must hold rows and columns";
            return Err(report.fatal(Some(line.number), rule, excerpt(line.text)));
        };
        if rows != columns {
            let found = format!("{rows} rows, {columns} columns");
            return Err(report.fatal(Some(line.number), "the matrix must be square", found));
        }
        let number = line.number;
        let all = u128::from(rows) * u128::from(rows);
        let values = if symmetry == Symmetry::Triangle { (all + u128::from(rows)) / 2 } else { all };
        if values > u128::from(known.bytes / SHORTEST + 1) {
            let found = format!("{rows} rows in a file of {} bytes", known.bytes);
            return Err(report.fatal(Some(number), "the header must announce what the file can hold", found));
        }
        return known.announced(rows, number, report);
    }
}
