//! Matrix Market, coordinate and array format (Boisvert, Pozo, Remington, The Matrix Market exchange formats, NISTIR 5935, 1996).

use super::{Heading, Known, array, triplets};
use crate::collect::Symmetry;
use crate::input::Input;
use crate::lines::Lines;
use crate::number::Fields;
use crate::problem::{Report, Stop, excerpt};

/// Shortest line of an entry: `1 1 1`, and its end.
const SHORTEST: u64 = 6;

pub(super) fn is_banner(text: &[u8]) -> bool {
    text.get(..14).is_some_and(|head| head.eq_ignore_ascii_case(b"%%MatrixMarket"))
}

pub(super) fn scan<const VALUES: bool>(
    input: &Input,
    mut known: Known<'_>,
    report: &mut Report,
    mut hand_on: impl FnMut(u32, u32, f64),
) -> Result<Heading, Stop> {
    let mut lines = Lines::open(input, report)?;
    let (symmetry, array) = banner(&mut lines, report)?;
    if array {
        return array::scan(&mut lines, &known, symmetry, report, hand_on);
    }
    let (rows, announced) = size(&mut lines, &known, report)?;
    known.size = Some(rows);
    let mut found = 0_u64;
    while let Some(line) = lines.next(report)? {
        if triplets::is_comment(line.text) {
            continue;
        }
        found += 1;
        if found > announced {
            let rule = format!("the header announces {announced} entries");
            return Err(report.fatal(Some(line.number), rule, "more lines follow"));
        }
        triplets::entry::<VALUES>(&line, &known, report, &mut hand_on)?;
    }
    if found < announced {
        let rule = format!("the header announces {announced} entries");
        return Err(report.fatal(Some(lines.number()), rule, format!("the file ends after {found}")));
    }
    Ok(Heading { rows: Some(rows), symmetry })
}

/// The symmetry, and whether all entries follow.
fn banner(lines: &mut Lines, report: &mut Report) -> Result<(Symmetry, bool), Stop> {
    let line = lines.expect("%%MatrixMarket", report)?;
    let lower = line.text.to_ascii_lowercase();
    let mut fields = Fields::new(&lower);
    let words: [&[u8]; 5] = std::array::from_fn(|_| fields.next());
    let mut refuse = |rule: &str, word: &[u8]| Err(report.fatal(Some(line.number), rule, excerpt(word)));
    if words[0] != b"%%matrixmarket" || words[1] != b"matrix" {
        return refuse("the first line must begin with %%MatrixMarket matrix", line.text);
    }
    let array = words[2] == b"array";
    if !array && words[2] != b"coordinate" {
        return refuse("the matrix must be in coordinate or array format", words[2]);
    }
    if !matches!(words[3], b"real" | b"integer" | b"double" | b"unsigned-integer") {
        return refuse("the matrix must be real or integer", words[3]);
    }
    match words[4] {
        b"symmetric" => Ok((Symmetry::Triangle, array)),
        b"general" => Ok((Symmetry::Full, array)),
        other => refuse("the matrix must be symmetric or general", other),
    }
}

/// Rows and entries announced, as far as the file can hold them.
fn size(lines: &mut Lines, known: &Known<'_>, report: &mut Report) -> Result<(u32, u64), Stop> {
    loop {
        let line = lines.expect("a line with rows, columns and entries", report)?;
        if triplets::is_comment(line.text) {
            continue;
        }
        let mut fields = Fields::new(line.text);
        let (Some(rows), Some(columns), Some(entries), true) =
            (fields.whole(), fields.whole(), fields.whole(), fields.end())
        else {
            let rule = "the line after the comments must hold rows, columns and entries";
            return Err(report.fatal(Some(line.number), rule, excerpt(line.text)));
        };
        if rows != columns {
            let found = format!("{rows} rows, {columns} columns");
            return Err(report.fatal(Some(line.number), "the matrix must be square", found));
        }
        if entries > known.bytes / SHORTEST + 1 {
            let found = format!("{entries} entries in a file of {} bytes", known.bytes);
            return Err(report.fatal(Some(line.number), "the header must announce what the file can hold", found));
        }
        return Ok((known.announced(rows, line.number, report)?, entries));
    }
}
