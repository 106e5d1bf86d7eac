//! A check in a process of its own: it may crash, hang, or end as it likes.

use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::finding::Finding;
use ttb_fmi::output::Output;
use ttb_fmi::platform::TEMPORARY_VARIABLES;
use ttb_fmi::platform::ending::Ending;
use ttb_fmi::platform::process::{Group, ending};
use ttb_fmi::temporary::Temporary;

use crate::error::Error;

/// What a worker left behind.
pub struct Outcome {
    /// What it found, and how it ended if not well.
    pub findings: Vec<Finding>,
    /// Whether it came to its end.
    pub finished: bool,
}

/// The last line of a worker's report.
pub const DONE: &str = "done";

/// Time between two looks at a worker.
const LOOK: Duration = Duration::from_millis(5);
/// Looks that a process which a worker has started may take to end after it.
const ENDING: usize = 60;
/// Bytes that are kept of what a worker prints.
const PRINTED: usize = 4096;
/// How a probe announces the second instance in its process.
const SECOND: &str = ", a second instance in its process";

/// Runs one check on an unpacked FMU; `patience` is how long a single call may take, `preload` the option
/// for libraries to load first.
pub fn run(check: &str, folder: &Path, patience: Duration, preload: &[OsString]) -> Result<Outcome, Error> {
    let place = Temporary::new("ttb-check-").map_err(Error::io(Path::new("temporary folder")))?;
    let file = |name: &str| place.path().join(name);
    let cwd = file("empty folder");
    fs::create_dir(&cwd).map_err(Error::io(&cwd))?;
    let program = std::env::current_exe().map_err(Error::io(Path::new("this program")))?;
    let mut command = Command::new(program);
    command.arg("check").arg("--worker").arg(check).arg("--report").arg(file("report")).args(preload).arg(folder);
    command.current_dir(&cwd).stdin(Stdio::null());
    command.envs(TEMPORARY_VARIABLES.iter().map(|name| (name, place.path())));
    let started = Error::io(Path::new("a process for the check"));
    let (status, left, [printed, complained]) =
        watched(&mut command, &file("report.stage"), patience).map_err(started)?;

    let read = |name: &str| String::from_utf8_lossy(&fs::read(file(name)).unwrap_or_default()).trim().to_string();
    let (report, stage) = (read("report"), read("report.stage"));
    let mut findings: Vec<Finding> = report.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    let finished = report.lines().last() == Some(DONE);
    let ended = end(status, finished, patience);
    if let Some((name, what)) = &ended {
        let stage = if finished { "the end of the process, when its library is unloaded" } else { &stage };
        // An FMU that does well alone says nothing wrong at its first instance.
        let second = stage.contains(SECOND);
        let what = if second { format!("a second instance in the same process: {what}") } else { what.clone() };
        let finding = Finding::error(name, what).at(stage).seen(first_line(&complained));
        let clause = if second { "FMI 2.0, 2.1.5".into() } else { String::new() };
        findings.push(finding.with_clause(clause));
    }
    if left > 0 {
        let what = "processes that it has started still run after its end";
        findings.push(Finding::warning("leaves-processes", what).seen(format!("{left} of them")));
    }
    for (stream, text) in [("stdout", &printed), ("stderr", &complained)] {
        let told = stream == "stderr" && ended.is_some();
        if !text.is_empty() && !told {
            findings.push(Finding::warning("prints", format!("it writes to {stream}")).seen(first_line(text)));
        }
    }
    let mut written = fs::read_dir(&cwd).into_iter().flatten().flatten();
    if let Some(entry) = written.next() {
        let name = entry.file_name().to_string_lossy().into_owned();
        findings.push(Finding::warning("writes-files", "it writes into the current folder").seen(name));
    }
    // Temporary folders say nothing to the reader.
    let plain = |text: &str| {
        let text = text.replace(&format!("{}/", folder.display()), "/FMU/");
        text.replace(&place.path().display().to_string(), "/TMP")
    };
    for finding in &mut findings {
        for text in [&mut finding.what, &mut finding.at, &mut finding.evidence] {
            *text = plain(text);
        }
    }
    Ok(Outcome { findings, finished: finished && ended.is_none() })
}

/// Runs a worker to its end: its status, nothing if it had to be stopped; how many processes it left, which are ended; what it
/// wrote to stdout and stderr.
fn watched(
    command: &mut Command,
    stage: &Path,
    patience: Duration,
) -> std::io::Result<(Option<ExitStatus>, usize, [String; 2])> {
    let texts = [(); 2].map(|()| Arc::new(Mutex::new(String::new())));
    let listen = |text: &Arc<Mutex<String>>| {
        let text = Arc::clone(text);
        Output::new(move |line| {
            let mut text = text.lock().unwrap_or_else(PoisonError::into_inner);
            // The beginning tells enough; an FMU may print without end.
            if text.len() < PRINTED {
                *text += line;
                text.push('\n');
            }
        })
    };
    let ((mut out, to_out), (mut err, to_err)) = (listen(&texts[0])?, listen(&texts[1])?);
    let mut group = Group::start(command.stdout(to_out).stderr(to_err))?;
    // It holds the writing ends, which must close with the process.
    *command = Command::new("");
    let stopped = !ends(&group, stage, patience);
    let left = left_by(&group, stopped);
    let status = group.end();
    out.finish();
    err.finish();
    let texts = texts.map(|text| std::mem::take(&mut *text.lock().unwrap_or_else(PoisonError::into_inner)));
    Ok((status.filter(|_| !stopped), left, texts))
}

/// Whether a worker ends by itself, no call of it taking longer than `patience`.
fn ends(group: &Group, stage: &Path, patience: Duration) -> bool {
    let (mut seen, mut since) = (Vec::new(), Instant::now());
    while !group.has_ended() {
        std::thread::sleep(LOOK);
        let now = fs::read(stage).unwrap_or_default();
        if now != seen {
            (seen, since) = (now, Instant::now());
        } else if since.elapsed() > patience {
            return false;
        }
    }
    true
}

/// How many processes a worker that has ended by itself has left; those that are just ending do not count.
fn left_by(group: &Group, stopped: bool) -> usize {
    let mut left = if stopped { 0 } else { group.started().len() };
    for _ in 0..ENDING {
        if left == 0 {
            break;
        }
        std::thread::sleep(LOOK);
        left = group.started().len();
    }
    left
}

/// Name and words for a process that did not end well.
fn end(status: Option<ExitStatus>, finished: bool, patience: Duration) -> Option<(&'static str, String)> {
    let Some(status) = status else {
        return Some(("hang", format!("a call does not return within {} s", patience.as_secs_f64())));
    };
    match ending(status) {
        Ending::Code(0) if finished => None,
        Ending::Code(code) => Some(("exit", format!("it ends the process with exit code {code}"))),
        Ending::Abort(how) => Some(("abort", format!("it aborts the process ({how})"))),
        Ending::Crash(how) => Some(("crash", format!("it crashes the process ({how})"))),
    }
}

fn first_line(text: &str) -> String {
    let line = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    line.chars().take(200).collect()
}
