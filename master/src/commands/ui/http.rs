//! HTTP/1.1 as the page needs it: a connection brings one request and takes one answer.
//!
//! Every connection has a thread of its own. Browsers hold spare connections open without a word; with threads that several
//! connections share, a request may wait for one of those until the browser closes it.

use std::io::{self, ErrorKind, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use crate::signals::Stop;

/// Between two looks at the signals.
const PAUSE: Duration = Duration::from_millis(100);
/// So long a connection may bring nothing.
const PATIENCE: Duration = Duration::from_secs(60);
/// Connections at a time; more are closed.
const CONNECTIONS: usize = 200;
/// Most bytes of a request before its body, and most headers.
const HEAD: usize = 1 << 15;
const HEADERS: usize = 64;
/// Bytes of a body that are read although nobody wants them: an answer is lost where a connection ends with unread bytes.
const UNWANTED: u64 = 1 << 16;

/// A request whose body is not read yet.
pub struct Request<'a> {
    /// Such as POST.
    pub method: String,
    /// Path with query.
    pub url: String,
    headers: Vec<(String, String)>,
    length: u64,
    /// What came with the head.
    begun: Vec<u8>,
    stream: Patient<'a>,
}

/// A connection that is read until it says nothing for long, or the program is asked to end.
#[derive(Clone, Copy)]
struct Patient<'a> {
    stream: &'a TcpStream,
    stop: &'a Stop,
}

impl Read for Patient<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let begin = Instant::now();
        loop {
            match (&mut &*self.stream).read(buffer) {
                Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                    if begin.elapsed() > PATIENCE || self.stop.asked().is_some() {
                        return Err(error);
                    }
                }
                done => return done,
            }
        }
    }
}

impl<'a> Request<'a> {
    /// The head of a request; nothing if the connection brings none.
    fn read(mut stream: Patient<'a>) -> Option<Self> {
        let (mut bytes, mut part) = (Vec::new(), [0; 4096]);
        loop {
            let count = stream.read(&mut part).ok().filter(|count| *count > 0)?;
            bytes.extend_from_slice(&part[..count]);
            let mut headers = [httparse::EMPTY_HEADER; HEADERS];
            let mut parsed = httparse::Request::new(&mut headers);
            let end = match parsed.parse(&bytes).ok()? {
                httparse::Status::Complete(end) => end,
                httparse::Status::Partial if bytes.len() < HEAD => continue,
                httparse::Status::Partial => return None,
            };
            let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
            let headers = parsed.headers.iter().map(|header| (header.name.to_string(), text(header.value)));
            let (method, url) = (parsed.method?.to_string(), parsed.path?.to_string());
            let mut request = Self { method, url, headers: headers.collect(), length: 0, begun: Vec::new(), stream };
            request.length = request.header("Content-Length").map_or(Some(0), |length| length.parse().ok())?;
            request.begun = bytes.split_off(end);
            return Some(request);
        }
    }

    /// A header's value.
    pub fn header(&self, name: &str) -> Option<&str> {
        let found = self.headers.iter().find(|(known, _)| known.eq_ignore_ascii_case(name));
        found.map(|(_, value)| value.as_str())
    }

    /// The body; nothing if it has more bytes than `most`, or its end is missing.
    pub fn body(&mut self, most: u64) -> Option<Vec<u8>> {
        if self.length > most {
            return None;
        }
        if self.header("Expect").is_some() {
            (&mut &*self.stream.stream).write_all(b"HTTP/1.1 100 Continue\r\n\r\n").ok()?;
        }
        let mut body = std::mem::take(&mut self.begun);
        let rest = self.length.saturating_sub(body.len() as u64);
        self.stream.take(rest).read_to_end(&mut body).ok()?;
        let whole = body.len() as u64 >= self.length;
        body.truncate(self.length as usize);
        self.length = 0;
        whole.then_some(body)
    }

    fn finish(mut self, answer: &[u8]) -> io::Result<()> {
        let mut to = self.stream.stream;
        to.write_all(answer)?;
        to.flush()?;
        if self.length <= UNWANTED {
            self.body(UNWANTED);
        }
        Ok(())
    }
}

/// Has every request answered, by the bytes of an answer, until `stop` was asked; `meanwhile` is called in between.
///
/// # Errors
/// The listener is broken.
pub fn serve(
    listener: &TcpListener,
    stop: &Stop,
    answer: &(impl Fn(&mut Request) -> Vec<u8> + Sync),
    meanwhile: &dyn Fn(),
) -> io::Result<()> {
    let (port, open) = (listener.local_addr()?.port(), AtomicUsize::new(0));
    let connection = &|stream: TcpStream| {
        let ready = stream.set_read_timeout(Some(PAUSE)).and_then(|()| stream.set_nodelay(true));
        if ready.is_ok()
            && let Some(mut request) = Request::read(Patient { stream: &stream, stop })
        {
            let answer = answer(&mut request);
            // A tab that was closed takes no answer; that is no error.
            let _ = request.finish(&answer);
        }
        open.fetch_sub(1, Ordering::Relaxed);
    };
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while stop.asked().is_none() {
                let Ok((stream, _)) = listener.accept() else {
                    // Too many open files, say: it may pass.
                    std::thread::sleep(PAUSE);
                    continue;
                };
                if open.fetch_add(1, Ordering::Relaxed) < CONNECTIONS {
                    scope.spawn(move || connection(stream));
                } else {
                    open.fetch_sub(1, Ordering::Relaxed);
                }
            }
        });
        while stop.asked().is_none() {
            std::thread::sleep(PAUSE);
            meanwhile();
        }
        meanwhile();
        // The listening thread looks at the signals when somebody connects.
        let _ = TcpStream::connect((Ipv4Addr::LOCALHOST, port));
    });
    Ok(())
}
