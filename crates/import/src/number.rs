//! Numbers and fields of a line.

use std::borrow::Cow;

/// Fields of a line, apart by blanks, tabs, commas or semicolons.
pub(crate) struct Fields<'a> {
    rest: &'a [u8],
}

#[inline]
fn separates(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b',' | b';')
}

impl<'a> Fields<'a> {
    #[inline]
    pub fn new(text: &'a [u8]) -> Self {
        Self { rest: text }
    }

    #[inline]
    fn skip(&mut self) {
        while let [byte, rest @ ..] = self.rest
            && separates(*byte)
        {
            self.rest = rest;
        }
    }

    /// The next field; empty at the end.
    #[inline]
    pub fn next(&mut self) -> &'a [u8] {
        self.skip();
        let length = self.rest.iter().position(|byte| separates(*byte)).unwrap_or(self.rest.len());
        let (field, rest) = self.rest.split_at(length);
        self.rest = rest;
        field
    }

    /// The next field as a whole number ≥ 0; too large a number saturates.
    #[inline]
    pub fn whole(&mut self) -> Option<u64> {
        /// So many digits fit surely.
        const FIT: usize = 19;
        self.skip();
        let before = self.rest.len();
        let mut number = 0_u64;
        while let [byte, rest @ ..] = self.rest
            && byte.is_ascii_digit()
        {
            number = number.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
            self.rest = rest;
        }
        let digits = before - self.rest.len();
        let ends = self.rest.first().is_none_or(|byte| separates(*byte));
        (digits > 0 && ends).then_some(if digits > FIT { u64::MAX } else { number })
    }

    /// As [`Fields::whole`]; a whole number may also be written as 1.0000e+00, as Matlab's `save -ascii` does.
    #[inline]
    pub fn position(&mut self) -> Option<u64> {
        /// Larger ones are no rows, and not all of them are doubles.
        const LARGEST: f64 = 1e15;
        let before = self.rest;
        self.whole().or_else(|| {
            self.rest = before;
            let number = real(self.next()).filter(|x| x.fract() == 0.0 && (0.0..LARGEST).contains(x))?;
            Some(number as u64)
        })
    }

    /// Passes over a minus; was there one?
    #[inline]
    pub fn minus(&mut self) -> bool {
        self.skip();
        match self.rest {
            [b'-', rest @ ..] => {
                self.rest = rest;
                true
            }
            _ => false,
        }
    }

    /// All that is left, without blanks around it.
    #[inline]
    pub fn remainder(mut self) -> &'a [u8] {
        self.skip();
        self.rest.trim_ascii_end()
    }

    /// Nothing but separators is left.
    #[inline]
    pub fn end(&mut self) -> bool {
        self.skip();
        self.rest.is_empty()
    }
}

/// A whole field as a whole number ≥ 0.
pub(crate) fn whole(text: &[u8]) -> Option<u64> {
    let mut fields = Fields::new(text);
    fields.whole().filter(|_| fields.end())
}

/// A field as a finite number, also as Fortran writes it: 1.5D+03, 1.5-103.
pub(crate) fn real(text: &[u8]) -> Option<f64> {
    let number = match lexical_core::parse::<f64>(text) {
        Ok(number) => Some(number),
        Err(_) => lexical_core::parse::<f64>(&fortran(text)?).ok(),
    };
    number.filter(|number| number.is_finite())
}

/// Significant digits of a number as it is written: from the first to the last digit that is not 0.
pub(crate) fn significant(text: &[u8]) -> u32 {
    let (mut digits, mut zeros) = (0, 0);
    for byte in text {
        match byte {
            b'0' if digits == 0 => {}
            b'0' => zeros += 1,
            b'1'..=b'9' => {
                digits += zeros + 1;
                zeros = 0;
            }
            b'.' => {}
            b'+' | b'-' if digits == 0 && zeros == 0 => {}
            _ => break,
        }
    }
    digits
}

/// Fortran's exponents with the letter e.
fn fortran(text: &[u8]) -> Option<Cow<'_, [u8]>> {
    const LONGEST: usize = 64;
    if text.len() > LONGEST || !text.first()?.is_ascii_digit() && !matches!(text[0], b'+' | b'-' | b'.') {
        return None;
    }
    if let Some(at) = text.iter().position(|byte| matches!(byte, b'd' | b'D')) {
        let mut owned = text.to_vec();
        owned[at] = b'e';
        return Some(owned.into());
    }
    // A sign inside, without a letter before it: the exponent of three digits pushed the letter out.
    let at = text.iter().skip(1).position(|byte| matches!(byte, b'+' | b'-'))? + 1;
    let has_letter = text.iter().any(u8::is_ascii_alphabetic);
    (!has_letter).then(|| [&text[..at], b"e", &text[at..]].concat().into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_c_and_fortran_are_read() {
        let cases = [
            ("1", 1.0),
            ("-5.5306891025641e+10", -5.5306891025641e10),
            ("+1.5", 1.5),
            ("1.", 1.0),
            (".5", 0.5),
            ("1.5D+03", 1500.0),
            ("-1.5d-03", -0.0015),
            ("1.5-103", 1.5e-103),
            ("1.5+103", 1.5e103),
            ("0.1E-400", 0.0),
        ];
        for (text, number) in cases {
            assert_eq!(real(text.as_bytes()), Some(number), "{text}");
        }
    }

    #[test]
    fn significant_digits_are_those_between_zeros() {
        for (text, digits) in [
            ("0", 0),
            ("0.000", 0),
            ("100", 1),
            ("-0.0012500e+05", 3),
            ("2.705649230769231E12", 16),
            ("2.705649E+12", 7),
            ("1.5-103", 2),
            ("+1.50D+03", 2),
        ] {
            assert_eq!(significant(text.as_bytes()), digits, "{text}");
        }
    }

    #[test]
    fn what_is_no_finite_number_is_not_read() {
        for text in [
            "",
            "nan",
            "NaN",
            "inf",
            "-Infinity",
            "1e400",
            "1,5",
            "1 5",
            "abc",
            "--1",
            "1e",
            "0x1",
            "d5",
            "1-",
            "1.5-1-1",
            "e5",
        ] {
            assert_eq!(real(text.as_bytes()), None, "{text}");
        }
        for text in ["", "-1", "1.0", "1a", "x", " "] {
            assert_eq!(whole(text.as_bytes()), None, "{text}");
        }
        assert_eq!(whole(b"99999999999999999999999"), Some(u64::MAX));
    }
}
