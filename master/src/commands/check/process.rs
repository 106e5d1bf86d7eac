//! A check in a process of its own: it may crash, hang, or end as it likes.

use std::ffi::OsString;
use std::fs::{self, File};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use super::finding::Finding;
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

/// Runs one check on an unpacked FMU; `patience` is how long a single call may take, `preload` the option
/// for libraries to load first.
pub fn run(check: &str, folder: &Path, patience: Duration, preload: &[OsString]) -> Result<Outcome, Error> {
    let place = Temporary::new("ttb-check-").map_err(Error::io(Path::new("temporary folder")))?;
    let file = |name: &str| place.path().join(name);
    let cwd = file("empty folder");
    fs::create_dir(&cwd).map_err(Error::io(&cwd))?;
    let create = |name: &str| File::create(file(name)).map_err(Error::io(&file(name)));
    let program = std::env::current_exe().map_err(Error::io(Path::new("this program")))?;
    let mut command = Command::new(program);
    command.arg("check").arg("--worker").arg(check).arg("--report").arg(file("report")).args(preload).arg(folder);
    command.current_dir(&cwd).env("TMPDIR", place.path());
    command.stdin(Stdio::null()).stdout(create("stdout")?).stderr(create("stderr")?);
    let child = command.spawn().map_err(Error::io(Path::new("a process for the check")))?;
    let status =
        wait(child, &file("report.stage"), patience).map_err(Error::io(Path::new("a process for the check")))?;

    let read = |name: &str| String::from_utf8_lossy(&fs::read(file(name)).unwrap_or_default()).trim().to_string();
    let (report, stage, printed, complained) = (read("report"), read("report.stage"), read("stdout"), read("stderr"));
    let mut findings: Vec<Finding> = report.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    let finished = report.lines().last() == Some(DONE);
    let ended = end(status, finished, patience);
    if let Some((name, what)) = &ended {
        let stage = if finished { "the end of the process" } else { &stage };
        findings.push(Finding::error(name, what.as_str()).at(stage).seen(first_line(&complained)));
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

/// The end of a process; nothing if it had to be stopped.
fn wait(mut child: Child, stage: &Path, patience: Duration) -> std::io::Result<Option<ExitStatus>> {
    let (mut seen, mut since) = (Vec::new(), Instant::now());
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        std::thread::sleep(LOOK);
        let now = fs::read(stage).unwrap_or_default();
        if now != seen {
            (seen, since) = (now, Instant::now());
        } else if since.elapsed() > patience {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
    }
}

/// Name and words for a process that did not end well.
fn end(status: Option<ExitStatus>, finished: bool, patience: Duration) -> Option<(&'static str, String)> {
    let Some(status) = status else {
        return Some(("hang", format!("a call does not return within {} s", patience.as_secs_f64())));
    };
    match (status.signal(), status.code()) {
        (None, Some(0)) if finished => None,
        (Some(6), _) => Some(("abort", "it aborts the process (SIGABRT)".into())),
        (Some(11), _) => Some(("crash", "it crashes the process (SIGSEGV)".into())),
        (Some(signal), _) => Some(("crash", format!("it crashes the process (signal {signal})"))),
        (None, code) => Some(("exit", format!("it ends the process with exit code {}", code.unwrap_or_default()))),
    }
}

fn first_line(text: &str) -> String {
    let line = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    line.chars().take(200).collect()
}
