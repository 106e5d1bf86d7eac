//! Harwell–Boeing, assembled real matrices (Duff, Grimes, Lewis, Users' guide for the Harwell-Boeing sparse matrix
//! collection, 1992), as ANSYS' HBMAT and SciPy's `hb_write` write them.
//!
//! Pointers of the columns, then all rows, then all values. Rows and values are read side by side from two places of the
//! file, so that neither has to be kept.

use super::cards::{CardFormat, Cards};
use super::{Heading, Known};
use crate::collect::Symmetry;
use crate::input::Input;
use crate::lines::Lines;
use crate::number::{Fields, real, whole};
use crate::problem::{Report, Stop, excerpt};

/// Does the third line name a type of matrix?
pub(super) fn is_type(text: &[u8]) -> bool {
    let word = Fields::new(text).next().to_ascii_uppercase();
    matches!(word[..], [b'R' | b'C' | b'P' | b'I', b'S' | b'U' | b'H' | b'Z' | b'R', b'A' | b'E'])
}

struct Head {
    symmetry: Symmetry,
    rows: u32,
    entries: u64,
    formats: [CardFormat; 3],
    /// Lines before the values.
    before_values: u64,
}

pub(super) fn scan<const VALUES: bool>(
    input: &Input,
    known: Known<'_>,
    report: &mut Report,
    mut hand_on: impl FnMut(u32, u32, f64),
) -> Result<Heading, Stop> {
    let mut lines = Lines::open(input, report)?;
    let head = head(&mut lines, &known, report)?;
    let pointers = pointers(&mut lines, &head, report)?;

    let mut value_lines = Lines::open(input, report)?;
    if VALUES {
        value_lines.skip(head.before_values, report)?;
    }
    let mut rows = Cards::new(&mut lines, head.formats[1], head.entries, "row numbers");
    let mut values = Cards::new(&mut value_lines, head.formats[2], head.entries, "values");
    let known = Known { size: Some(head.rows), ..known };
    for (j, ends) in pointers.windows(2).enumerate() {
        for _ in ends[0]..ends[1] {
            let field = rows.next(report)?;
            let row = whole(field);
            let shown = if row.is_none() { excerpt(field) } else { String::new() };
            let index = row.and_then(|row| known.index(row));
            match (row, index) {
                (None, _) => report.line(rows.line(), "row numbers must be whole numbers", shown)?,
                (Some(row), None) => known.outside(rows.line(), &[row], report)?,
                _ => {}
            }
            let mut value = Some(0.0);
            if VALUES {
                let field = values.next(report)?;
                value = real(field);
                report.written(field);
                let shown = if value.is_none() { excerpt(field) } else { String::new() };
                if value.is_none() {
                    report.line(values.line(), "values must be finite numbers", shown)?;
                }
            }
            if let (Some(i), Some(value)) = (index, value) {
                hand_on(i, j as u32, value);
            }
        }
    }
    if lines.number() != head.before_values {
        let found = format!("the last row number is on line {}", lines.number());
        return Err(report.fatal(Some(2), format!("values must begin after line {}", head.before_values), found));
    }
    Ok(Heading { rows: Some(head.rows), symmetry: head.symmetry })
}

fn head(lines: &mut Lines, known: &Known<'_>, report: &mut Report) -> Result<Head, Stop> {
    lines.expect("a title", report)?;
    let line = lines.expect("numbers of lines", report)?;
    let mut fields = Fields::new(line.text);
    let counts: [Option<u64>; 4] = std::array::from_fn(|_| fields.whole());
    let [Some(_), Some(pointer_lines), Some(row_lines), Some(_)] = counts else {
        let rule = "the second line must hold numbers of lines: all, pointers, rows, values";
        return Err(report.fatal(Some(line.number), rule, excerpt(line.text)));
    };
    let right_hand_lines = if fields.end() { Some(0) } else { fields.whole() };
    let right_hand = right_hand_lines.is_some_and(|count| count > 0);

    let line = lines.expect("type and size of the matrix", report)?;
    let mut fields = Fields::new(line.text);
    let kind = fields.next();
    let symmetry = match kind.to_ascii_uppercase()[..] {
        [b'R', b'S', b'A'] => Symmetry::Triangle,
        [b'R', b'U', b'A'] => Symmetry::Full,
        _ => {
            let rule = "the matrix must be real, symmetric or unsymmetric, assembled: RSA or RUA";
            return Err(report.fatal(Some(line.number), rule, excerpt(kind)));
        }
    };
    let (Some(rows), Some(columns), Some(entries)) = (fields.whole(), fields.whole(), fields.whole()) else {
        let rule = "the third line must hold type, rows, columns and entries";
        return Err(report.fatal(Some(line.number), rule, excerpt(line.text)));
    };
    if rows != columns {
        let found = format!("{rows} rows, {columns} columns");
        return Err(report.fatal(Some(line.number), "the matrix must be square", found));
    }
    if entries > known.bytes {
        let found = format!("{entries} entries in a file of {} bytes", known.bytes);
        return Err(report.fatal(Some(line.number), "the header must announce what the file can hold", found));
    }
    let number = line.number;
    let rows = known.announced(rows, number, report)?;

    let line = lines.expect("formats", report)?;
    let formats: Vec<Option<CardFormat>> = groups(line.text).take(3).map(CardFormat::parse).collect();
    let formats = match formats[..] {
        [Some(p), Some(r), Some(v)] if p.whole && r.whole && !v.whole => [p, r, v],
        _ => {
            let rule =
                "the fourth line must hold formats of pointers, rows and values, such as (10I8) (10I8) (4E20.12)";
            return Err(report.fatal(Some(line.number), rule, excerpt(line.text)));
        }
    };
    if right_hand {
        lines.expect("the type of the right-hand side", report)?;
    }
    let before_values = lines.number().saturating_add(pointer_lines).saturating_add(row_lines);
    Ok(Head { symmetry, rows, entries, formats, before_values })
}

/// Texts in parentheses.
fn groups(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let from = at + text[at..].iter().position(|byte| *byte == b'(')?;
        let mut depth = 0;
        let length = text[from..].iter().position(|byte| {
            depth += i32::from(*byte == b'(') - i32::from(*byte == b')');
            depth == 0
        })?;
        at = from + length + 1;
        Some(&text[from..at])
    })
}

/// Where columns begin, from 0.
fn pointers(lines: &mut Lines, head: &Head, report: &mut Report) -> Result<Vec<u64>, Stop> {
    let mut cards = Cards::new(lines, head.formats[0], u64::from(head.rows) + 1, "pointers of the columns");
    let mut pointers = Vec::new();
    let mut last = 1;
    for j in 0..=head.rows {
        let field = cards.next(report)?;
        let (pointer, shown) = (whole(field), excerpt(field));
        let bounds = if j == 0 { 1..=1 } else { last..=head.entries + 1 };
        match pointer.filter(|pointer| bounds.contains(pointer)) {
            Some(pointer) => {
                last = pointer;
                pointers.push(pointer - 1);
            }
            None => {
                let rule = format!("pointers must not fall and run from 1 to {}", head.entries + 1);
                return Err(report.fatal(Some(cards.line()), rule, shown));
            }
        }
    }
    if last != head.entries + 1 {
        let rule = format!("the last pointer must be {}", head.entries + 1);
        return Err(report.fatal(Some(cards.line()), rule, last));
    }
    Ok(pointers)
}
