//! How a table is written, told from its first lines.

use crate::number::real;
use crate::problem::{Report, Stop};

/// What separates, and what stands before the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Dialect {
    /// `;`, tab, `,` or blank.
    pub separator: u8,
    /// Bytes before the table: the mark of UTF-8, a line `sep=;`.
    pub skip: usize,
    /// Lines in them.
    pub lines: u64,
}

impl Dialect {
    pub fn of(bytes: &[u8], report: &mut Report) -> Result<Self, Stop> {
        const RULE: &str = "a table must be a text file of UTF-8";
        if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
            return Err(report.fatal(None, RULE, "it is UTF-16: save it as UTF-8 (Excel: \"CSV UTF-8\")"));
        }
        if bytes.starts_with(b"PK\x03\x04") {
            return Err(report.fatal(None, RULE, "it is a workbook (.xlsx, .ods) or another archive: save it as CSV"));
        }
        if bytes.iter().take(4096).any(|byte| *byte == 0) {
            return Err(report.fatal(None, RULE, "it has bytes of value 0"));
        }
        let mut skip = if bytes.starts_with("\u{feff}".as_bytes()) { "\u{feff}".len() } else { 0 };
        let mut lines = 0;
        let mut said = None;
        let first = line(&bytes[skip..]);
        if let [b's' | b'S', b'e' | b'E', b'p' | b'P', b'=', separator] = first.trim_ascii_end() {
            said = Some(*separator);
            skip += first.len();
            skip += bytes[skip..].iter().take(2).take_while(|byte| matches!(byte, b'\r' | b'\n')).count();
            lines = 1;
        }
        let header = bytes[skip..]
            .split(|byte| matches!(byte, b'\n' | b'\r'))
            .find(|line| !matches!(line.trim_ascii().first(), None | Some(b'#')))
            .unwrap_or_default();
        let outside = outside_quotes(header);
        let separator = said.or_else(|| [b';', b'\t', b','].into_iter().find(|sign| outside.contains(sign)));
        let separator = separator.unwrap_or(if outside.trim_ascii().contains(&b' ') { b' ' } else { b',' });
        Ok(Self { separator, skip, lines })
    }
}

fn line(bytes: &[u8]) -> &[u8] {
    bytes.split(|byte| matches!(byte, b'\n' | b'\r')).next().unwrap_or_default()
}

fn outside_quotes(text: &[u8]) -> Vec<u8> {
    let mut quoted = false;
    let outside = text.iter().copied().filter(|byte| {
        quoted ^= *byte == b'"';
        !quoted
    });
    outside.collect()
}

/// A header's name without capitals and without the unit m.
pub(super) fn column_name(text: &str) -> String {
    let lower = text.to_lowercase();
    let name = lower.strip_suffix("[m]").or_else(|| lower.strip_suffix("(m)")).unwrap_or(&lower);
    name.trim().to_owned()
}

/// A number with one comma before its decimals.
pub(super) fn with_comma(text: &str) -> Option<f64> {
    let (whole, decimals) = text.split_once(',')?;
    let plain = !whole.contains('.') && !decimals.contains(['.', ',']);
    real(format!("{whole}.{decimals}").as_bytes()).filter(|_| plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_separates_is_told_from_the_header() {
        let cases = [
            ("x,r\n1,2\n", b',', 0),
            ("x;r\n1,5;2\n", b';', 0),
            ("# a; remark\n\nx\tr\n", b'\t', 0),
            ("\u{feff}x;r\n", b';', 3),
            ("sep=;\r\nx;r\r\n", b';', 7),
            ("\u{feff}SEP=,\nx,r\n", b',', 9),
            ("x r\n1 2\n", b' ', 0),
            ("\"a;b\",c\n", b',', 0),
            ("x\n1\n", b',', 0),
            ("", b',', 0),
        ];
        for (text, separator, skip) in cases {
            let found = Dialect::of(text.as_bytes(), &mut Report::new("t")).unwrap();
            assert_eq!((found.separator, found.skip), (separator, skip), "{text:?}");
        }
    }

    #[test]
    fn a_comma_stands_before_decimals_once_and_without_points() {
        for (text, value) in
            [("0,65", Some(0.65)), ("-1,5e-3", Some(-1.5e-3)), ("1.234,5", None), ("1,234,5", None), ("1,", Some(1.0))]
        {
            assert_eq!(with_comma(text), value, "{text}");
        }
        assert_eq!(column_name("X [m]"), "x");
        assert_eq!(column_name("r (mm)"), "r (mm)");
    }
}
