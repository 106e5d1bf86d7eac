//! What an isolated FMU prints: read line by line in a thread, passed on, the last lines kept for the error message.

use super::settings::Listener;
use std::collections::VecDeque;
use std::io::{BufRead, BufReader, PipeWriter, Read, Write};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

/// Lines kept.
const KEPT: usize = 3;
/// Longest line; a longer one is passed on in pieces.
const LINE: u64 = 4096;
/// The line after which nothing is read: by then the FMU's process is gone, but some process it has started may still hold
/// the pipe open.
const END: &[u8] = b"\0ttb: end of output\0\n";

type Lines = Arc<Mutex<VecDeque<String>>>;

/// The reading end of an FMU's output.
pub struct Output {
    end: PipeWriter,
    reader: Option<JoinHandle<()>>,
    last: Lines,
}

impl Output {
    /// Begins to read; the second is the writing end, for the process.
    pub fn new(name: &str, listener: Listener) -> std::io::Result<(Self, PipeWriter)> {
        let (reader, end) = std::io::pipe()?;
        let writer = end.try_clone()?;
        let (name, last) = (name.to_string(), Lines::default());
        let kept = Arc::clone(&last);
        let thread = std::thread::Builder::new().name("fmu-output".into()).spawn(move || {
            read(BufReader::new(reader), |line| {
                let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
                kept.truncate(KEPT - 1);
                kept.push_front(line.to_string());
                drop(kept);
                listener(&name, line);
            });
        });
        Ok((Self { end, reader: Some(thread?), last }, writer))
    }

    /// Reads to the end, once the process has ended.
    pub fn finish(&mut self) {
        if let Some(reader) = self.reader.take() {
            let _ = self.end.write_all(&[b"\n", END].concat());
            let _ = reader.join();
        }
    }

    /// The last lines, for a message.
    pub fn last_lines(&self) -> String {
        let last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let lines: Vec<&str> = last.iter().rev().map(String::as_str).collect();
        if lines.is_empty() { String::new() } else { format!("; it printed: {}", lines.join(" | ")) }
    }
}

fn read(mut from: impl BufRead, mut pass_on: impl FnMut(&str)) {
    let (mut line, mut empty) = (Vec::new(), 0);
    loop {
        line.clear();
        let read = from.by_ref().take(LINE).read_until(b'\n', &mut line);
        if line == END || !read.is_ok_and(|n| n > 0) {
            return;
        }
        let text = String::from_utf8_lossy(&line);
        let text = text.trim_end();
        // Empty lines wait for what follows: the last one may be ours.
        if text.is_empty() {
            empty += 1;
            continue;
        }
        (0..std::mem::take(&mut empty)).for_each(|_| pass_on(""));
        pass_on(text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_passed_on_up_to_the_mark() {
        let mut lines = Vec::new();
        let text = [b"one\r\n\n\xfftwo".as_slice(), b"\n", END, b"three\n"].concat();
        read(text.as_slice(), |line| lines.push(line.to_string()));
        assert_eq!(lines, ["one", "", "\u{fffd}two"]);
    }
}
