//! Lines of row, column, value.

use super::{Heading, Known};
use crate::collect::Symmetry;
use crate::input::Input;
use crate::lines::{Line, Lines};
use crate::number::{Fields, real};
use crate::problem::{Report, Stop, excerpt};

/// Empty or a remark.
pub(super) fn is_comment(text: &[u8]) -> bool {
    matches!(text.trim_ascii_start().first(), None | Some(b'%' | b'#' | b'*'))
}

/// Hands on the entry in a line, or notes what is wrong with it.
#[inline]
pub(super) fn entry<const VALUES: bool>(
    line: &Line<'_>,
    known: &Known<'_>,
    report: &mut Report,
    hand_on: &mut impl FnMut(u32, u32, f64),
) -> Result<(), Stop> {
    let mut fields = Fields::new(line.text);
    let (Some(row), Some(column)) = (fields.whole(), fields.whole()) else {
        return report.line(line.number, "a line must hold row, column and value", excerpt(line.text));
    };
    let (Some(i), Some(j)) = (known.index(row), known.index(column)) else {
        return known.outside(line.number, &[row, column], report);
    };
    let value = value::<VALUES>(fields, line, "a line must hold row, column and value", report)?;
    if let Some(value) = value {
        hand_on(i, j, value);
    }
    Ok(())
}

/// The last field as a value.
#[inline]
pub(super) fn value<const VALUES: bool>(
    fields: Fields<'_>,
    line: &Line<'_>,
    rule: &str,
    report: &mut Report,
) -> Result<Option<f64>, Stop> {
    if !VALUES {
        return Ok(Some(0.0));
    }
    let field = fields.remainder();
    let value = real(field);
    if value.is_none() {
        if field.is_empty() || Fields::new(field).next().len() < field.len() {
            report.line(line.number, rule, excerpt(line.text))?;
        } else {
            report.line(line.number, "values must be finite numbers", excerpt(field))?;
        }
    }
    Ok(value)
}

pub(super) fn scan<const VALUES: bool>(
    input: &Input,
    known: Known<'_>,
    report: &mut Report,
    mut hand_on: impl FnMut(u32, u32, f64),
) -> Result<Heading, Stop> {
    let mut lines = Lines::open(input, report)?;
    while let Some(line) = lines.next(report)? {
        if !is_comment(line.text) {
            entry::<VALUES>(&line, &known, report, &mut hand_on)?;
        }
    }
    Ok(Heading { rows: None, symmetry: Symmetry::Either })
}
