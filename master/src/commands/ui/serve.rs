//! Answers requests until a signal asks for the end.

use std::io::{Read, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;

use sha2::{Digest, Sha256};
use tiny_http::{Method, Request as Http, Server, StatusCode};
use ttb_web::{Engine, page};

use super::foreign::{self, Dropped};
use super::gate::{Asked, Gate, Request};
use super::jobs::Jobs;
use crate::signals::Stop;

/// Threads that answer: long computations, and what a page asks meanwhile.
const THREADS: usize = 6;
/// Between two looks at the signals.
const PAUSE: Duration = Duration::from_millis(100);
/// Most bytes of a request.
const MOST: u64 = 1 << 30;
const JSON: &str = "application/json";

/// What of the web a page may use: this program, and what the page makes itself; a report that it opens has its one script.
fn policy() -> String {
    let report = base64(&Sha256::digest(ttb_report::SCRIPT));
    format!(
        "default-src 'none'; script-src 'self' 'sha256-{report}'; style-src 'self' 'unsafe-inline'; img-src 'self' data: \
         blob:; connect-src 'self'; worker-src blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    )
}

/// Bytes as browsers write digests.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let bits = three.iter().enumerate().fold(0u32, |bits, (i, byte)| bits | u32::from(*byte) << (16 - 8 * i));
        for i in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * i) & 63) as usize];
            text.push(if i <= three.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

/// The page and the engine behind the gate.
pub struct Service {
    gate: Gate,
    engine: Engine,
    jobs: Jobs,
    dropped: Dropped,
    policy: String,
    /// The page itself, which names the engine and the scenario.
    index: String,
    scenario: Option<String>,
}

struct Answer {
    status: u16,
    kind: &'static str,
    body: Vec<u8>,
}

impl Service {
    /// Behind a gate; with the text of a scenario that the page opens.
    pub fn new(gate: Gate, engine: Engine, scenario: Option<String>) -> Self {
        let index = page::FILES.iter().find(|(name, ..)| *name == "index.html").map_or("", |(.., text)| text);
        let mut named = r#"<meta name="engine" content="native">"#.to_string();
        if scenario.is_some() {
            named += r#"<meta name="scenario" content="scenario.json">"#;
        }
        let index = index.replace(r#"<meta name="engine" content="wasm">"#, &named);
        Self { gate, engine, jobs: Jobs::default(), dropped: Dropped::default(), policy: policy(), index, scenario }
    }

    /// Answers until `stop` was asked.
    pub fn serve(&self, server: &Server, stop: &Stop) {
        std::thread::scope(|scope| {
            for _ in 0..THREADS {
                scope.spawn(|| self.answer_all(server, stop));
            }
            while stop.asked().is_none() {
                std::thread::sleep(PAUSE);
                self.jobs.sweep(false);
            }
            self.jobs.sweep(true);
        });
    }

    fn answer_all(&self, server: &Server, stop: &Stop) {
        while stop.asked().is_none() {
            let Ok(Some(mut request)) = server.recv_timeout(PAUSE) else { continue };
            let answer = self.answer(&mut request);
            // A tab that was closed takes no answer; that is no error.
            let _ = write(&answer, &self.policy, request.into_writer());
        }
    }

    fn answer(&self, request: &mut Http) -> Answer {
        let header = |name: &'static str| {
            request.headers().iter().find(|header| header.field.equiv(name)).map(|header| header.value.as_str())
        };
        let posts = *request.method() == Method::Post;
        if !posts && *request.method() != Method::Get {
            return text(405, "files are got, verbs are posted");
        }
        let (host, origin, site) = (header("Host"), header("Origin"), header("Sec-Fetch-Site"));
        match self.gate.pass(&Request { url: request.url(), posts, host, origin, site }) {
            Err((status, why)) => text(status, why),
            Ok(Asked::File(name)) => self.file(&name),
            Ok(Asked::Verb(verb, job)) => {
                let mut body = Vec::new();
                match request.as_reader().take(MOST + 1).read_to_end(&mut body) {
                    Ok(_) if body.len() as u64 <= MOST => self.verb(&verb, &job, &body),
                    _ => text(413, "the request is too large, or its end is missing"),
                }
            }
        }
    }

    fn file(&self, name: &str) -> Answer {
        let answer = |kind, text: &str| Answer { status: 200, kind, body: text.as_bytes().to_vec() };
        match (name, &self.scenario) {
            ("index.html", _) => answer("text/html; charset=utf-8", &self.index),
            ("scenario.json", Some(scenario)) => answer(JSON, scenario),
            _ => match page::FILES.iter().find(|(known, ..)| *known == name) {
                Some((_, kind, content)) => answer(kind, content),
                None => text(404, "there is no such file"),
            },
        }
    }

    fn verb(&self, verb: &str, job: &str, body: &[u8]) -> Answer {
        match verb {
            "alive" => self.jobs.hear(job),
            "cancel" => self.jobs.leave(job),
            _ => {
                let stop = self.jobs.begin(job);
                let answered = catch_unwind(AssertUnwindSafe(|| match verb {
                    "foreign" => foreign::run(body, &stop),
                    "fmu" => self.dropped.keep(body),
                    _ => self.engine.call(verb, body, &stop),
                }));
                self.jobs.end(job);
                let failed =
                    |_| br#"{"error":"the computation ended by an error of the program","problems":[]}"#.to_vec();
                return Answer { status: 200, kind: JSON, body: answered.unwrap_or_else(failed) };
            }
        }
        Answer { status: 200, kind: JSON, body: b"{}".to_vec() }
    }
}

fn text(status: u16, why: &str) -> Answer {
    Answer { status, kind: "text/plain; charset=utf-8", body: format!("{why}\n").into_bytes() }
}

/// Writes an answer. Every connection ends with it: the server gives each one a thread, and of several that come at the same time
/// one may have to wait until a thread is free, which those of a browser that are kept for later would not be.
fn write(answer: &Answer, policy: &str, mut to: impl Write) -> std::io::Result<()> {
    let Answer { status, kind, body } = answer;
    let (reason, length) = (StatusCode(*status).default_reason_phrase(), body.len());
    write!(to, "HTTP/1.1 {status} {reason}\r\nContent-Length: {length}\r\nConnection: close\r\n")?;
    let headers = [
        ("Content-Type", *kind),
        ("Content-Security-Policy", policy),
        ("Cache-Control", "no-store"),
        ("Cross-Origin-Opener-Policy", "same-origin"),
        ("Cross-Origin-Resource-Policy", "same-origin"),
        ("Referrer-Policy", "no-referrer"),
        ("X-Content-Type-Options", "nosniff"),
    ];
    for (name, value) in headers {
        write!(to, "{name}: {value}\r\n")?;
    }
    to.write_all(b"\r\n")?;
    to.write_all(body)?;
    to.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_written_as_in_rfc_4648() {
        for (bytes, text) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }
}
