//! Answers requests until a signal asks for the end.

use std::net::TcpListener;
use std::panic::{AssertUnwindSafe, catch_unwind};

use sha2::{Digest, Sha256};
use ttb_web::{Engine, page};

use super::foreign::Dropped;
use super::gate::{Asked, Gate, Request};
use super::http::{self, Request as Http};
use super::jobs::Jobs;
use crate::signals::Stop;

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
    ///
    /// # Errors
    /// The listener is broken.
    pub fn serve(&self, listener: &TcpListener, stop: &Stop) -> std::io::Result<()> {
        let answer = |request: &mut Http| written(&self.answer(request), &self.policy);
        http::serve(listener, stop, &answer, &|| self.jobs.sweep(stop.asked().is_some()))
    }

    fn answer(&self, request: &mut Http) -> Answer {
        let posts = request.method == "POST";
        if !posts && request.method != "GET" {
            return text(405, "files are got, verbs are posted");
        }
        let [host, origin, site] = ["Host", "Origin", "Sec-Fetch-Site"].map(|name| request.header(name));
        match self.gate.pass(&Request { url: &request.url, posts, host, origin, site }) {
            Err((status, why)) => text(status, why),
            Ok(Asked::File(name)) => self.file(&name),
            Ok(Asked::Verb(verb, job)) => match request.body(MOST) {
                Some(body) => self.verb(&verb, &job, &body),
                None => text(413, "the request is too large, or its end is missing"),
            },
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

/// An answer as it is sent; the connection ends with it.
fn written(answer: &Answer, policy: &str) -> Vec<u8> {
    let Answer { status, kind, body } = answer;
    let reason = match status {
        200 => "OK",
        403 => "Forbidden",
        404 => "Not Found",
        405 => "Method Not Allowed",
        _ => "Content Too Large",
    };
    let headers = [
        ("Connection", "close"),
        ("Content-Type", *kind),
        ("Content-Security-Policy", policy),
        ("Cache-Control", "no-store"),
        ("Cross-Origin-Opener-Policy", "same-origin"),
        ("Cross-Origin-Resource-Policy", "same-origin"),
        ("Referrer-Policy", "no-referrer"),
        ("X-Content-Type-Options", "nosniff"),
    ];
    let headers: String = headers.iter().map(|(name, value)| format!("{name}: {value}\r\n")).collect();
    let head = format!("HTTP/1.1 {status} {reason}\r\nContent-Length: {}\r\n{headers}\r\n", body.len());
    [head.as_bytes(), body].concat()
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
