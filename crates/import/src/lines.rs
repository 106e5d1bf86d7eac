//! A file line by line, in chunks: memory does not grow with the file.

use std::io::{ErrorKind, Read};

use crate::input::Input;
use crate::problem::{Report, Stop};

/// Bytes read at once.
const CHUNK: usize = 1 << 20;
/// Longest line; formats have 30 to 120 characters.
const LONGEST: usize = 1 << 16;

/// A line without its end.
pub(crate) struct Line<'a> {
    /// Number of the line, from 1.
    pub number: u64,
    pub text: &'a [u8],
}

/// Reads a file line by line.
pub(crate) struct Lines {
    source: Box<dyn Read>,
    buffer: Vec<u8>,
    from: usize,
    to: usize,
    ended: bool,
    number: u64,
}

impl Lines {
    pub fn open(input: &Input, report: &mut Report) -> Result<Self, Stop> {
        let opened = input.length().and_then(|length| Ok((length, input.open()?)));
        let (length, source) = opened.map_err(|e| report.fatal(None, "the file cannot be read", e))?;
        // One byte more than the file lets the end be seen without another round.
        let size = usize::try_from(length).unwrap_or(CHUNK).saturating_add(1).min(CHUNK);
        Ok(Self { source, buffer: vec![0; size.max(64)], from: 0, to: 0, ended: false, number: 0 })
    }

    /// Number of the line last read.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// The next line, `None` at the end.
    pub fn next(&mut self, report: &mut Report) -> Result<Option<Line<'_>>, Stop> {
        let mut searched = 0;
        let (end, next) = loop {
            if let Some(length) = memchr::memchr(b'\n', &self.buffer[self.from + searched..self.to]) {
                let end = self.from + searched + length;
                break (end, end + 1);
            }
            if self.ended {
                if self.from == self.to {
                    return Ok(None);
                }
                break (self.to, self.to);
            }
            searched = self.to - self.from;
            if searched > LONGEST {
                break (self.to, self.to); // refused below
            }
            self.fill(report)?;
        };
        let mut text = &self.buffer[self.from..end];
        self.from = next;
        self.number += 1;
        if text.len() > LONGEST {
            let found = format!("more than {LONGEST} characters");
            return Err(report.fatal(Some(self.number), "a line is too long, this is no text file of a matrix", found));
        }
        if let [head @ .., b'\r'] = text {
            text = head;
        }
        if self.number == 1 {
            if text.starts_with(&[0xff, 0xfe]) || text.starts_with(&[0xfe, 0xff]) {
                return Err(report.fatal(Some(1), "a text file must be UTF-8 or ASCII", "UTF-16; save it as UTF-8"));
            }
            text = text.strip_prefix("\u{feff}".as_bytes()).unwrap_or(text);
        }
        Ok(Some(Line { number: self.number, text }))
    }

    /// As [`Lines::next`] where a line must follow.
    pub fn expect(&mut self, what: &str, report: &mut Report) -> Result<Line<'_>, Stop> {
        let number = self.number + 1;
        match self.next(report)? {
            Some(line) => Ok(line),
            None => Err(report.fatal(Some(number), format!("{what} must follow"), "the file ends here")),
        }
    }

    /// Passes over `count` lines.
    pub fn skip(&mut self, count: u64, report: &mut Report) -> Result<(), Stop> {
        for _ in 0..count {
            if self.next(report)?.is_none() {
                break;
            }
        }
        Ok(())
    }

    /// Moves what is left to the buffer's begin and reads behind it.
    fn fill(&mut self, report: &mut Report) -> Result<(), Stop> {
        self.buffer.copy_within(self.from..self.to, 0);
        self.to -= self.from;
        self.from = 0;
        if self.to == self.buffer.len() {
            // A file that grew since it was opened.
            self.buffer.resize(CHUNK.max(2 * LONGEST), 0);
        }
        loop {
            match self.source.read(&mut self.buffer[self.to..]) {
                Ok(0) => self.ended = true,
                Ok(count) => self.to += count,
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                Err(error) => return Err(report.fatal(None, "the file cannot be read", error)),
            }
            return Ok(());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &[u8]) -> Vec<Vec<u8>> {
        let mut report = Report::new("t");
        let mut lines = Lines::open(&Input::bytes("t", text), &mut report).unwrap();
        let mut all = Vec::new();
        while let Some(line) = lines.next(&mut report).unwrap() {
            all.push(line.text.to_vec());
        }
        all
    }

    #[test]
    fn ends_of_lines_are_no_part_of_them() {
        assert_eq!(lines(b"a\r\n\nbc"), [b"a".to_vec(), b"".to_vec(), b"bc".to_vec()]);
        assert_eq!(lines(b"a\n"), [b"a".to_vec()]);
        assert!(lines(b"").is_empty());
    }

    #[test]
    fn a_line_across_two_chunks_is_whole() {
        let mut text = vec![b' '; CHUNK - 3];
        (0..CHUNK - 3).step_by(50).for_each(|i| text[i] = b'\n');
        text.extend(b"\nabcdefgh\nz");
        let all = lines(&text);
        assert_eq!(all[all.len() - 2..], [b"abcdefgh".to_vec(), b"z".to_vec()]);
    }

    #[test]
    fn an_endless_line_is_refused() {
        let mut report = Report::new("t");
        let mut lines = Lines::open(&Input::bytes("t", vec![b'1'; 3 * CHUNK]), &mut report).unwrap();
        assert!(lines.next(&mut report).is_err());
        assert!(report.problems[0].to_string().contains("too long"));
    }
}
