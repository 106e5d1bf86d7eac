//! A run with a bridge FMU of another program: the commands that a user would call, each in a process of its own.
//!
//! ```text
//! scenario, FMU, map ──► ttb run --bridge FMU --map map.json --isolate -o out ──► ttb report out ──► report, verdicts, hashes
//! ```
//!
//! An FMU may crash or hang: the page's program goes on. Everything lies in a temporary folder that is gone afterwards.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use ttb_fmi::temporary::Temporary;
use ttb_web::Fault;
use ttb_web::request::{Limits, SCENARIO};

/// Between two looks at a process and at whether it was left off.
const PAUSE: Duration = Duration::from_millis(20);
const OWN: &str = "limits.json";
const MAP: &str = "map.json";

/// What is asked for.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    /// Text of the scenario: train, track, where the supports stand, one speed.
    scenario: String,
    /// The FMU on this computer.
    bridge: PathBuf,
    /// Text of its map; empty: equal names.
    #[serde(default)]
    map: String,
    #[serde(default)]
    limits: Limits,
}

/// What a run leaves.
#[derive(Serialize)]
struct Done {
    /// report.html.
    report: String,
    /// verdicts.json.
    verdicts: Value,
    /// Files that went in, with their roles and hashes.
    inputs: Value,
    /// What the commands said.
    said: String,
}

/// The answer to a request, JSON.
pub fn run(body: &[u8], stop: &AtomicBool) -> Vec<u8> {
    match done(body, stop) {
        Ok(Some(done)) => serde_json::to_vec(&done),
        Ok(None) => Ok(br#"{"stopped":true}"#.to_vec()),
        Err(fault) => serde_json::to_vec(&fault),
    }
    .unwrap_or_default()
}

fn done(body: &[u8], stop: &AtomicBool) -> Result<Option<Done>, Fault> {
    let read = serde_json::from_slice(body);
    let asked: Asked = read.map_err(|error| Fault::new(format!("the request cannot be read: {error}")))?;
    File::open(&asked.bridge).map_err(|error| Fault::new(format!("{}: {error}", asked.bridge.display())))?;
    let place = Temporary::new("ttb-ui-").map_err(|error| Fault::new(format!("the temporary folder: {error}")))?;
    let place = place.path();
    let mut limits = asked.limits.names.clone();
    write(place, SCENARIO, &asked.scenario)?;
    if let Some(own) = &asked.limits.own {
        write(place, OWN, own)?;
        limits.push(place.join(OWN).display().to_string());
    }
    let judged = |command: &mut Command| {
        if !limits.is_empty() {
            command.arg("--limits").arg(limits.join(","));
        }
    };
    let mut run = command("run")?;
    run.arg(place.join(SCENARIO)).arg("--bridge").arg(&asked.bridge).arg("--isolate").arg("-o").arg(place.join("out"));
    if !asked.map.trim().is_empty() {
        write(place, MAP, &asked.map)?;
        run.arg("--map").arg(place.join(MAP));
    }
    judged(&mut run);
    let Some(said) = ended(&mut run, place, stop)? else { return Ok(None) };
    let mut report = command("report")?;
    report.arg(place.join("out"));
    judged(&mut report);
    let Some(more) = ended(&mut report, place, stop)? else { return Ok(None) };
    let text = |name: &str| {
        fs::read_to_string(place.join("out").join(name)).map_err(|error| Fault::new(format!("{name}: {error}")))
    };
    let json = |name: &str| -> Result<Value, Fault> {
        serde_json::from_str(&text(name)?).map_err(|error| Fault::new(format!("{name}: {error}")))
    };
    let inputs = json("summary.json")?["inputs"].take();
    Ok(Some(Done { report: text("report.html")?, verdicts: json("verdicts.json")?, inputs, said: said + &more }))
}

/// A verb of this program, quiet.
fn command(verb: &str) -> Result<Command, Fault> {
    let program = std::env::current_exe().map_err(|error| Fault::new(format!("the path of this program: {error}")))?;
    let mut command = Command::new(program);
    command.arg(verb).arg("--quiet").stdin(Stdio::null()).stdout(Stdio::null());
    Ok(command)
}

/// What a command said to its end; nothing if it was left off.
fn ended(command: &mut Command, place: &Path, stop: &AtomicBool) -> Result<Option<String>, Fault> {
    let failed = |error: std::io::Error| Fault::new(format!("a process of the program ttb: {error}"));
    let said = place.join("said");
    let mut process = command.stderr(File::create(&said).map_err(failed)?).spawn().map_err(failed)?;
    let status = loop {
        if let Some(status) = process.try_wait().map_err(failed)? {
            break status;
        }
        if stop.load(Ordering::Relaxed) {
            // Its own FMUs end with it, and its temporary folders are looked after.
            process.kill().and_then(|()| process.wait()).map_err(failed)?;
            return Ok(None);
        }
        std::thread::sleep(PAUSE);
    };
    // Names of temporary folders say nothing to the reader.
    let text = String::from_utf8_lossy(&fs::read(&said).unwrap_or_default())
        .replace(&format!("{}{}", place.display(), std::path::MAIN_SEPARATOR), "");
    match status.success() {
        true => Ok(Some(text)),
        false if text.trim().is_empty() => Err(Fault::new(format!("ttb ended without a word: {status}"))),
        false => Err(Fault::new(text.trim())),
    }
}

fn write(place: &Path, name: &str, text: &str) -> Result<(), Fault> {
    fs::write(place.join(name), text).map_err(|error| Fault::new(format!("{name}: {error}")))
}

/// FMUs that were dropped on the page, until the program ends.
#[derive(Default)]
pub struct Dropped(Mutex<Vec<Temporary>>);

impl Dropped {
    /// Keeps a file, of which `body` has the name, a line feed and the bytes: JSON with its path.
    pub fn keep(&self, body: &[u8]) -> Vec<u8> {
        let at = body.iter().position(|byte| *byte == b'\n').unwrap_or(body.len());
        let (name, bytes) = (String::from_utf8_lossy(&body[..at]), body.get(at + 1..).unwrap_or_default());
        let kept = match Path::new(&*name).file_name().filter(|file| Path::new(file).extension().is_some()) {
            None => Err(Fault::new("the FMU must have a name, such as deck.fmu")),
            Some(file) => Temporary::new("ttb-ui-").map_err(|error| Fault::new(error.to_string())).and_then(|folder| {
                let path = folder.path().join(file);
                fs::write(&path, bytes).map_err(|error| Fault::new(error.to_string()))?;
                self.0.lock().unwrap_or_else(PoisonError::into_inner).push(folder);
                Ok(serde_json::json!({ "path": path }))
            }),
        };
        kept.map_or_else(|fault| serde_json::to_vec(&fault), |kept| serde_json::to_vec(&kept)).unwrap_or_default()
    }
}
