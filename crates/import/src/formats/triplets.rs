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
    let (Some(row), Some(column)) = (fields.position(), fields.position()) else {
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
    report.written(field);
    if value.is_none() {
        if field.is_empty() || Fields::new(field).next().len() < field.len() {
            report.line(line.number, rule, excerpt(line.text))?;
        } else {
            report.line(line.number, "values must be finite numbers", excerpt(field))?;
        }
    }
    Ok(value)
}

/// A remark may be a header in a form that is not understood: what follows is then no data.
pub(super) fn remark(line: &Line<'_>, report: &mut Report) -> Result<(), Stop> {
    const RULE: &str = "a header must be understood, not passed over as a remark";
    let text = line.text.to_ascii_lowercase();
    let has = |word: &[u8]| text.windows(word.len()).any(|part| part == word);
    if has(b"matrixmarket") {
        let found =
            format!("{}: the first line of a Matrix Market file begins with %%MatrixMarket", excerpt(line.text));
        return Err(report.fatal(Some(line.number), RULE, found));
    }
    // GNU Octave, `save -text`: its sparse matrices are lines of row, column, value.
    if has(b"# type:") && !has(b"sparse") {
        let found = format!("{}: write a sparse matrix, or Matrix Market", excerpt(line.text));
        return Err(report.fatal(Some(line.number), RULE, found));
    }
    Ok(())
}

/// The first line where it may hold sizes instead of an entry: n, n, and a whole number of at least n.
struct Suspect {
    line: u64,
    n: u64,
    entries: u64,
}

impl Suspect {
    fn new(line: &Line<'_>) -> Option<Self> {
        let mut fields = Fields::new(line.text);
        let (rows, n, entries) = (fields.whole()?, fields.whole()?, fields.whole()?);
        (rows == n && entries >= n && fields.end()).then_some(Self { line: line.number, n, entries })
    }

    /// After all other lines: sizes if as many follow as it says, or the last diagonal entry is there again; and if no
    /// index is larger.
    fn judge(&self, others: u64, largest: u64, again: bool, report: &mut Report) -> Result<(), Stop> {
        if largest > self.n || others == 0 || !(others == self.entries || again) {
            return Ok(());
        }
        let found = format!("{n} {n} {}, and {others} lines of data follow", self.entries, n = self.n);
        let rule = "a line of sizes must not stand above lines of row, column and value: remove it, or write the header \
                    of a Matrix Market file";
        Err(report.fatal(Some(self.line), rule, found))
    }
}

pub(super) fn scan<const VALUES: bool>(
    input: &Input,
    known: Known<'_>,
    report: &mut Report,
    mut hand_on: impl FnMut(u32, u32, f64),
) -> Result<Heading, Stop> {
    let mut lines = Lines::open(input, report)?;
    let (mut suspect, mut others, mut largest, mut again) = (None::<Suspect>, None::<u64>, 0, false);
    while let Some(line) = lines.next(report)? {
        if is_comment(line.text) {
            remark(&line, report)?;
            continue;
        }
        match &mut others {
            None => {
                suspect = Suspect::new(&line);
                others = Some(0);
            }
            Some(others) => *others += 1,
        }
        let follows = others != Some(0);
        let last = suspect.as_ref().map_or(0, |suspect| suspect.n);
        let mut look = |i: u32, j: u32, value: f64| {
            largest = largest.max(u64::from(i.max(j)) + 1);
            again |= follows && i == j && u64::from(i) + 1 == last;
            hand_on(i, j, value);
        };
        entry::<VALUES>(&line, &known, report, &mut look)?;
    }
    if let Some(suspect) = suspect {
        suspect.judge(others.unwrap_or(0), largest, again, report)?;
    }
    Ok(Heading { rows: None, symmetry: Symmetry::Either })
}
