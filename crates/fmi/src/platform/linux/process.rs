//! Processes that may be lost: watched without being collected, ended with all they have started.
//!
//! What such a process has started is found in three ways, since it may have got out of any one of them: by its group, by its
//! descent, and by a mark that it has in its environment. A host of foreign code is the parent of all orphans below it
//! (`end_with_parent`), so that descent holds as long as it lives; the mark holds longer.

use super::watch::end_with_parent;
use crate::platform::ending::Ending;
use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process, kill_process_group, waitid};
use std::collections::BTreeSet;
use std::hash::{BuildHasher, RandomState};
use std::io;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Child, Command, ExitStatus};
use std::time::Duration;

/// The mark in the environment: number of the process that has started this one, and a number that nobody else has.
const MARK: &str = "TTB_STARTED_BY";
/// Looks for processes that are left, and the pause between two of them: some of them may just be starting others.
const LOOKS: usize = 100;
const PAUSE: Duration = Duration::from_millis(2);

/// A process in a group of its own, which keeps Ctrl-C from it. Dropping it ends it with all it has started.
pub struct Group {
    child: Child,
    mark: String,
    ended: Option<ExitStatus>,
}

impl Group {
    /// Starts it.
    ///
    /// # Errors
    /// The system does not.
    pub fn start(command: &mut Command) -> io::Result<Self> {
        let mark = format!("{}-{:016x}", std::process::id(), RandomState::new().hash_one(0));
        command.env(MARK, &mark).process_group(0);
        Ok(Self { child: command.spawn()?, mark: format!("{MARK}={mark}"), ended: None })
    }

    /// Whether it has ended by itself. It stays a zombie until [`Group::end`], so that its number stays taken.
    pub fn has_ended(&self) -> bool {
        let Some(pid) = Pid::from_raw(self.child.id() as i32) else { return true };
        let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
        self.ended.is_some() || !matches!(waitid(WaitId::Pid(pid), options), Ok(None))
    }

    /// What it has started and still runs.
    pub fn started(&self) -> BTreeSet<i32> {
        let own = self.child.id() as i32;
        let mut all = below(own);
        let mark = self.mark.as_bytes();
        let marked = |pid: i32| environment(pid).split(|byte| *byte == 0).any(|entry| entry == mark);
        let others = processes();
        let ours = others.iter().filter(|p| p.runs && p.pid != own && (p.group == own || marked(p.pid)));
        all.extend(ours.map(|process| process.pid));
        all
    }

    /// Ends it and what it has started, and collects it; how it ended.
    pub fn end(&mut self) -> Option<ExitStatus> {
        if self.ended.is_none() {
            // It has to live for its orphans to stay below it; it is not to start more meanwhile.
            self.signal(Signal::STOP);
            self.end_started();
            self.signal(Signal::KILL);
            if let Some(group) = Pid::from_raw(self.child.id() as i32) {
                let _ = kill_process_group(group, Signal::KILL);
            }
            self.ended = self.child.wait().ok();
            self.end_started();
        }
        self.ended
    }

    /// A signal to it, unless it has ended.
    fn signal(&self, signal: Signal) {
        if let Some(pid) = Pid::from_raw(self.child.id() as i32)
            && !self.has_ended()
        {
            let _ = kill_process(pid, signal);
        }
    }

    fn end_started(&self) {
        end_all(|| self.started());
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        self.end();
    }
}

/// For the process that a [`Group`] has started, at its beginning: it ends, with all it has started, once who started it is
/// gone. Works also while foreign code hangs.
///
/// # Errors
/// There is no thread to be had for it.
pub fn end_with_starter() -> io::Result<()> {
    let starter = std::env::var(MARK).ok().and_then(|mark| mark.split('-').next()?.parse().ok());
    end_with_parent(starter, || {
        let own = std::process::id() as i32;
        end_all(|| below(own));
        let _ = rustix::process::kill_current_process_group(Signal::KILL);
    })
}

/// Ends what processes have started that a [`Group`] of the process `starter` was, once that is gone itself.
pub fn end_started_by(starter: u32) {
    let mark = format!("{MARK}={starter}-").into_bytes();
    let marked = |pid: i32| environment(pid).split(|byte| *byte == 0).any(|entry| entry.starts_with(&mark));
    end_all(|| processes().iter().filter(|p| p.runs && marked(p.pid)).map(|process| process.pid).collect());
}

/// The environment a process was begun with, entries with a zero byte behind each.
fn environment(pid: i32) -> Vec<u8> {
    std::fs::read(format!("/proc/{pid}/environ")).unwrap_or_default()
}

/// Kills what `left` gives until it gives nothing.
fn end_all(left: impl Fn() -> BTreeSet<i32>) {
    for _ in 0..LOOKS {
        let left = left();
        if left.is_empty() {
            return;
        }
        for pid in left.into_iter().filter_map(Pid::from_raw) {
            let _ = kill_process(pid, Signal::KILL);
        }
        std::thread::sleep(PAUSE);
    }
}

/// A process as the kernel shows it.
struct Seen {
    pid: i32,
    parent: i32,
    group: i32,
    /// It is no zombie.
    runs: bool,
}

/// All processes.
fn processes() -> Vec<Seen> {
    let numbers = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    let numbers = numbers.filter_map(|entry| entry.file_name().to_str()?.parse::<i32>().ok());
    numbers.filter_map(seen).collect()
}

/// From `/proc/PID/stat`: number, name in brackets, state, parent, group.
fn seen(pid: i32) -> Option<Seen> {
    let stat = std::fs::read(format!("/proc/{pid}/stat")).ok()?;
    let behind_name = stat.iter().rposition(|byte| *byte == b')')? + 1;
    let mut fields = std::str::from_utf8(&stat[behind_name..]).ok()?.split_ascii_whitespace();
    let runs = !matches!(fields.next()?, "Z" | "X");
    Some(Seen { pid, runs, parent: fields.next()?.parse().ok()?, group: fields.next()?.parse().ok()? })
}

/// All that runs below a process, by descent.
fn below(ancestor: i32) -> BTreeSet<i32> {
    let all = processes();
    let (mut found, mut front) = (BTreeSet::new(), vec![ancestor]);
    while let Some(parent) = front.pop() {
        for child in all.iter().filter(|process| process.parent == parent) {
            front.push(child.pid);
            if child.runs {
                found.insert(child.pid);
            }
        }
    }
    found
}

/// How a process came to its end.
pub fn ending(status: ExitStatus) -> Ending {
    match (status.signal(), status.code()) {
        (Some(6), _) => Ending::Abort("SIGABRT".into()),
        (Some(11), _) => Ending::Crash("SIGSEGV".into()),
        (Some(signal), _) => Ending::Crash(format!("signal {signal}")),
        (None, code) => Ending::Code(code.unwrap_or_default()),
    }
}

/// How a process ended, in words that follow "its process".
pub fn how_it_ended(status: ExitStatus) -> String {
    match (status.signal(), status.code()) {
        (Some(signal), _) => format!("was killed by signal {signal}{}", signal_name(signal)),
        (None, code) => format!("ended with exit code {}", code.unwrap_or_default()),
    }
}

/// The usual ones.
fn signal_name(signal: i32) -> &'static str {
    match signal {
        4 => " (SIGILL)",
        6 => " (SIGABRT)",
        7 => " (SIGBUS)",
        8 => " (SIGFPE)",
        9 => " (SIGKILL)",
        11 => " (SIGSEGV)",
        13 => " (SIGPIPE)",
        15 => " (SIGTERM)",
        24 => " (SIGXCPU)",
        25 => " (SIGXFSZ)",
        31 => " (SIGSYS)",
        _ => "",
    }
}
