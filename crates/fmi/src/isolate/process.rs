//! The process of an isolated FMU: started, watched, ended with all it has started itself.

use super::settings::Isolation;
use crate::output::Output;
use crate::platform::memory::Shared;
use crate::platform::process::{Group, how_it_ended};
use std::io;
use std::process::{Command, ExitStatus};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A host process. Dropping it ends it.
pub struct Process {
    group: Group,
    output: Output,
}

impl Process {
    /// Starts the host. Its standard input is the shared memory; what it prints goes through a pipe. A process group of its own
    /// keeps Ctrl-C from it: the master ends first the step, then the FMU.
    pub fn start(isolation: &Isolation, name: &str, memory: &Shared) -> io::Result<Self> {
        let (name, listener) = (name.to_string(), Arc::clone(&isolation.listener));
        let (output, writer) = Output::new(move |line| listener(&name, line))?;
        let mut command = Command::new(&isolation.program);
        command.args(&isolation.arguments);
        memory.give_to(&mut command)?;
        command.stdout(writer.try_clone()?).stderr(writer);
        Ok(Self { group: Group::start(&mut command)?, output })
    }

    /// Whether it has ended by itself. It stays a zombie until [`Process::finish`], so that its number stays taken.
    pub fn has_ended(&self) -> bool {
        self.group.has_ended()
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

    /// Ends it, unless it has ended, and what it has started, and collects it; the rest of its output is read.
    pub fn finish(&mut self) -> Option<ExitStatus> {
        let ended = self.group.end();
        self.output.finish();
        ended
    }

    /// How it came to its end, in words that follow "its process", and what it printed last.
    pub fn how_it_ended(&mut self) -> String {
        let how = self.finish().map_or_else(|| "is lost".to_string(), how_it_ended);
        how + &self.output.last_lines()
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.finish();
    }
}
