//! What another process prints: read line by line in a thread, passed on, the last lines kept for the error message.

use std::collections::VecDeque;
use std::hash::{BuildHasher, RandomState};
use std::io::{BufRead, BufReader, PipeWriter, Read, Write};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

/// Lines kept.
const KEPT: usize = 3;
/// Longest line; a longer one is passed on in pieces.
const LINE: u64 = 4096;

type Lines = Arc<Mutex<VecDeque<String>>>;

/// The reading end of a process's output.
pub struct Output {
    end: PipeWriter,
    mark: String,
    reader: Option<JoinHandle<()>>,
    last: Lines,
}

impl Output {
    /// Begins to read, in a thread that calls `listener` with every line; the second is the writing end, for the process.
    ///
    /// # Errors
    /// The system gives no pipe or no thread.
    pub fn new(listener: impl Fn(&str) + Send + 'static) -> std::io::Result<(Self, PipeWriter)> {
        let (reader, end) = std::io::pipe()?;
        let writer = end.try_clone()?;
        let (last, mark) = (Lines::default(), end_mark());
        let (kept, until) = (Arc::clone(&last), mark.clone());
        let thread = std::thread::Builder::new().name("fmu-output".into()).spawn(move || {
            read(BufReader::new(reader), until.as_bytes(), |line| {
                let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
                kept.truncate(KEPT - 1);
                kept.push_front(line.to_string());
                drop(kept);
                listener(line);
            });
        });
        Ok((Self { end, mark, reader: Some(thread?), last }, writer))
    }

    /// Reads to the end, once the process has ended.
    pub fn finish(&mut self) {
        if let Some(reader) = self.reader.take() {
            let _ = self.end.write_all(&[b"\n", self.mark.as_bytes()].concat());
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

/// The line after which nothing is read: by then the process is gone, but some process it has started may still hold the pipe
/// open. Nobody can foresee it, so that nobody else writes it: RandomState has its keys from the system.
fn end_mark() -> String {
    let number = || RandomState::new().hash_one(std::process::id());
    format!("\0end of output {:016x}{:016x}\0\n", number(), number())
}

fn read(mut from: impl BufRead, mark: &[u8], mut pass_on: impl FnMut(&str)) {
    let (mut line, mut empty) = (Vec::new(), 0);
    loop {
        line.clear();
        let read = from.by_ref().take(LINE).read_until(b'\n', &mut line);
        if line == mark || !read.is_ok_and(|n| n > 0) {
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
    fn lines_are_passed_on_up_to_the_mark_which_is_another_each_time() {
        let (mut lines, mark) = (Vec::new(), end_mark());
        let text = [b"one\r\n\n\xfftwo".as_slice(), b"\n", end_mark().as_bytes(), mark.as_bytes(), b"three\n"].concat();
        read(text.as_slice(), mark.as_bytes(), |line| lines.push(line.to_string()));
        assert_eq!(
            (lines.len(), lines[0].as_str(), lines[1].as_str(), lines[2].as_str()),
            (4, "one", "", "\u{fffd}two")
        );
    }
}
