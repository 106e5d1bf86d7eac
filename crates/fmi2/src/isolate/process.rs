//! The process of an isolated FMU: started, watched, ended with all it has started itself.

use super::Isolation;
use super::output::Output;
use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process_group, waitid};
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// A host process. Dropping it ends it.
pub struct Process {
    child: Child,
    output: Output,
    ended: Option<ExitStatus>,
}

impl Process {
    /// Starts the host. Its standard input is the shared memory; what it prints goes through a pipe, whose closing tells it
    /// that the master is gone. A process group of its own keeps Ctrl-C from it: the master ends first the step, then
    /// the FMU.
    pub fn start(isolation: &Isolation, name: &str, memory: OwnedFd) -> io::Result<Self> {
        let (output, writer) = Output::new(name, isolation.listener.clone())?;
        let mut command = Command::new(&isolation.program);
        command.args(&isolation.arguments).process_group(0);
        command.stdin(Stdio::from(memory)).stdout(writer.try_clone()?).stderr(writer);
        Ok(Self { child: command.spawn()?, output, ended: None })
    }

    fn pid(&self) -> Option<Pid> {
        Pid::from_raw(self.child.id() as i32)
    }

    /// Whether it has ended by itself. It stays a zombie until [`Process::finish`], so that its number stays taken.
    pub fn has_ended(&self) -> bool {
        let Some(pid) = self.pid() else { return true };
        let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
        self.ended.is_some() || !matches!(waitid(WaitId::Pid(pid), options), Ok(None))
    }

    /// Waits for its end.
    pub fn ends_within(&self, limit: Duration) -> bool {
        let (begin, mut pause) = (Instant::now(), Duration::from_micros(200));
        while !self.has_ended() {
            if begin.elapsed() > limit {
                return false;
            }
            std::thread::sleep(pause);
            pause = (2 * pause).min(Duration::from_millis(20));
        }
        true
    }

    /// Ends it and what it has started, unless it has ended, and collects it; the rest of its output is read.
    pub fn finish(&mut self) -> Option<ExitStatus> {
        if self.ended.is_none() {
            if let Some(group) = self.pid() {
                let _ = kill_process_group(group, Signal::KILL);
            }
            let _ = self.child.kill(); // should it have left its group
            self.ended = self.child.wait().ok();
            self.output.finish();
        }
        self.ended
    }

    /// How it came to its end, in words that follow "its process", and what it printed last.
    pub fn epitaph(&mut self) -> String {
        let how = match self.finish() {
            None => "is lost".to_string(),
            Some(status) => match (status.signal(), status.code()) {
                (Some(signal), _) => format!("was killed by signal {signal}{}", signal_name(signal)),
                (None, code) => format!("ended with exit code {}", code.unwrap_or_default()),
            },
        };
        how + &self.output.last_words()
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.finish();
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
        31 => " (SIGSYS)",
        _ => "",
    }
}
