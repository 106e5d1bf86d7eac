//! Fortran's fixed fields: so many of such a width on a line.

use std::ops::Range;

use crate::lines::Lines;
use crate::problem::{Report, Stop};

/// A format such as (10I8) or (1P,4D20.12).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CardFormat {
    /// Fields on a line.
    pub repeat: usize,
    /// Characters of a field.
    pub width: usize,
    /// Whole numbers.
    pub whole: bool,
}

impl CardFormat {
    /// Understands a format in parentheses.
    pub fn parse(text: &[u8]) -> Option<Self> {
        let text: Vec<u8> =
            text.iter().filter(|byte| !byte.is_ascii_whitespace()).map(u8::to_ascii_uppercase).collect();
        let mut rest = text.strip_prefix(b"(")?.strip_suffix(b")")?;
        // Inner parentheses around the whole: (4(1PE20.12)) is read as 4 times the inner.
        let mut repeat = number(&mut rest);
        if let Some(inner) = rest.strip_prefix(b"(") {
            rest = inner.strip_suffix(b")")?;
        } else if let Some(scaled) = rest.strip_prefix(b"P") {
            rest = scaled.strip_prefix(b",").unwrap_or(scaled);
            repeat = None;
        }
        let mut inner = number(&mut rest);
        if let Some(scaled) = rest.strip_prefix(b"P") {
            rest = scaled.strip_prefix(b",").unwrap_or(scaled);
            inner = number(&mut rest);
        }
        let (&kind, mut rest) = rest.split_first()?;
        let width = number(&mut rest)?;
        let repeat = repeat.unwrap_or(1).checked_mul(inner.unwrap_or(1))?;
        let whole = match kind {
            b'I' => true,
            b'E' | b'D' | b'F' | b'G' => false,
            _ => return None,
        };
        let decimals = rest.iter().all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'E'));
        let sensible = (1..=1000).contains(&repeat) && (1..=100).contains(&width) && decimals;
        sensible.then_some(Self { repeat, width, whole })
    }
}

fn number(rest: &mut &[u8]) -> Option<usize> {
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let (head, tail) = rest.split_at(digits);
    *rest = tail;
    let text = std::str::from_utf8(head).ok().filter(|text| !text.is_empty())?;
    Some(text.parse().unwrap_or(usize::MAX))
}

/// Reads fields one after the other.
///
/// Where blanks separate as many fields as the line must hold, they count, and not the widths: some programs (SciPy's
/// `hb_write`) announce other widths than they write.
pub(super) struct Cards<'a> {
    lines: &'a mut Lines,
    format: CardFormat,
    line: Vec<u8>,
    /// Where the fields of the line lie.
    fields: Vec<Range<usize>>,
    /// Fields of the line already read.
    read: usize,
    /// Fields still to come, the line's not counted.
    left: u64,
    what: &'a str,
}

impl<'a> Cards<'a> {
    /// Of `count` fields in all.
    pub fn new(lines: &'a mut Lines, format: CardFormat, count: u64, what: &'a str) -> Self {
        Self { lines, format, line: Vec::new(), fields: Vec::new(), read: 0, left: count, what }
    }

    /// Line of the last field.
    pub fn line(&self) -> u64 {
        self.lines.number()
    }

    /// The next field without blanks around it.
    pub fn next(&mut self, report: &mut Report) -> Result<&[u8], Stop> {
        if self.read == self.fields.len() {
            let line = self.lines.expect(self.what, report)?;
            self.line.clear();
            self.line.extend_from_slice(line.text);
            self.read = 0;
            let most = self.format.repeat.min(usize::try_from(self.left).unwrap_or(usize::MAX)).max(1);
            self.left = self.left.saturating_sub(most as u64);
            self.split(most);
        }
        let field = self.fields[self.read].clone();
        self.read += 1;
        Ok(self.line[field].trim_ascii())
    }

    /// Finds the fields of a line that must hold `count`.
    fn split(&mut self, count: usize) {
        self.fields.clear();
        let mut at = 0;
        for word in self.line.split(u8::is_ascii_whitespace) {
            if !word.is_empty() {
                self.fields.push(at..at + word.len());
            }
            at += word.len() + 1;
        }
        if self.fields.len() != count {
            let (width, length) = (self.format.width, self.line.len());
            self.fields.clear();
            self.fields.extend((0..count).map(|k| (k * width).min(length)..((k + 1) * width).min(length)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_of_fortran_are_understood() {
        let format = |repeat, width, whole| Some(CardFormat { repeat, width, whole });
        let cases = [
            ("(16I5)", format(16, 5, true)),
            ("(I14)", format(1, 14, true)),
            ("(1I14)", format(1, 14, true)),
            ("( 10 i8 )", format(10, 8, true)),
            ("(1P,4D20.12)", format(4, 20, false)),
            ("(1P4E20.12)", format(4, 20, false)),
            ("(4(1PE20.12))", format(4, 20, false)),
            ("(1PE25.15)", format(1, 25, false)),
            ("(3E26.16E3)", format(3, 26, false)),
            ("(D25.15)", format(1, 25, false)),
            ("(5F20.7)", format(5, 20, false)),
        ];
        for (text, expected) in cases {
            assert_eq!(CardFormat::parse(text.as_bytes()), expected, "{text}");
        }
        for text in
            ["", "()", "(I)", "(A8)", "16I5", "(0I5)", "(3I0)", "(99999999999999999999I5)", "(((I5)))", "(2I5,3E7.1)"]
        {
            assert_eq!(CardFormat::parse(text.as_bytes()), None, "{text}");
        }
    }
}
