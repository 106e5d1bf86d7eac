//! The process of an isolated FMU: started, watched, ended with all it has started itself.

use super::output::Output;
use super::settings::Isolation;
use crate::platform;
use std::io;
use std::os::fd::OwnedFd;
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
        command.args(&isolation.arguments);
        platform::in_own_group(&mut command);
        command.stdin(Stdio::from(memory)).stdout(writer.try_clone()?).stderr(writer);
        Ok(Self { child: command.spawn()?, output, ended: None })
    }

    /// Whether it has ended by itself. It stays a zombie until [`Process::finish`], so that its number stays taken.
    pub fn has_ended(&self) -> bool {
        self.ended.is_some() || platform::process::has_ended(&self.child)
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
            self.ended = platform::process::end(&mut self.child);
            self.output.finish();
        }
        self.ended
    }

    /// How it came to its end, in words that follow "its process", and what it printed last.
    pub fn how_it_ended(&mut self) -> String {
        let how = self.finish().map_or_else(|| "is lost".to_string(), platform::process::how_it_ended);
        how + &self.output.last_lines()
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.finish();
    }
}
