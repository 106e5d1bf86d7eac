//! Processes that may be lost: watched without being collected, ended with all they have started. A job object holds them all, and
//! ends them when its handle is closed: also when this process is gone.

use super::api::{self, Owned};
use crate::platform::ending::Ending;
use std::collections::BTreeSet;
use std::io;
use std::os::windows::io::AsRawHandle;
use std::os::windows::process::CommandExt;
use std::process::{Child, Command, ExitStatus};

/// A process in a job of its own, without a console, which keeps Ctrl-C from it. Dropping it ends it with all it has started.
pub struct Group {
    child: Child,
    job: Owned,
    ended: Option<ExitStatus>,
}

impl Group {
    /// Starts it.
    ///
    /// # Errors
    /// The system does not.
    pub fn start(command: &mut Command) -> io::Result<Self> {
        // SAFETY: a job without a name.
        let job = Owned::new(unsafe { api::CreateJobObjectW(std::ptr::null(), std::ptr::null()) })?;
        let limits = api::JobLimits { flags: api::KILL_ON_CLOSE, ..Default::default() };
        let (class, size) = (api::JOB_EXTENDED_LIMITS, size_of::<api::JobLimits>() as u32);
        // SAFETY: a structure of the size that is said.
        if unsafe { api::SetInformationJobObject(job.0, class, (&raw const limits).cast(), size) } == 0 {
            return Err(io::Error::last_os_error());
        }
        let mut child = command.creation_flags(api::NO_WINDOW).spawn()?;
        // It loads its FMU only when it is told to, so that nothing of the FMU has been started outside of the job.
        // SAFETY: open handles.
        if unsafe { api::AssignProcessToJobObject(job.0, child.as_raw_handle()) } == 0 {
            let error = io::Error::last_os_error();
            let _ = child.kill();
            let _ = child.wait();
            return Err(error);
        }
        Ok(Self { child, job, ended: None })
    }

    /// Whether it has ended by itself.
    pub fn has_ended(&self) -> bool {
        // SAFETY: the handle is open as long as `child` lives.
        self.ended.is_some() || unsafe { api::WaitForSingleObject(self.child.as_raw_handle(), 0) } == 0
    }

    /// What it has started and still runs; the process that serves its console does not count.
    pub fn started(&self) -> BTreeSet<i32> {
        let mut found = api::JobProcesses { assigned: 0, listed: 0, ids: [0; 256] };
        let (class, size) = (api::JOB_BASIC_PROCESS_ID_LIST, size_of::<api::JobProcesses>() as u32);
        // SAFETY: a structure of the size that is said.
        unsafe {
            api::QueryInformationJobObject(self.job.0, class, (&raw mut found).cast(), size, std::ptr::null_mut())
        };
        let ids = found.ids.iter().take(found.listed as usize).map(|id| *id as u32);
        ids.filter(|id| *id != self.child.id() && !serves_a_console(*id)).map(|id| id as i32).collect()
    }

    /// Ends it and what it has started, and collects it; how it ended.
    pub fn end(&mut self) -> Option<ExitStatus> {
        if self.ended.is_none() {
            // SAFETY: our job.
            unsafe { api::TerminateJobObject(self.job.0, KILLED) };
            self.ended = self.child.wait().ok();
        }
        self.ended
    }
}

/// Whether a process is the one that Windows itself starts for a console, even one without a window. It ends a little later than
/// the programs in it.
fn serves_a_console(id: u32) -> bool {
    // SAFETY: opens the process, or none.
    let Ok(process) = Owned::new(unsafe { api::OpenProcess(api::QUERY_LIMITED, 0, id) }) else { return false };
    let mut name = [0_u16; 1024];
    let mut length = name.len() as u32;
    // SAFETY: an open process, and room for as many letters as said.
    let known = unsafe { api::QueryFullProcessImageNameW(process.0, 0, name.as_mut_ptr(), &raw mut length) } != 0;
    known && String::from_utf16_lossy(&name[..length as usize]).to_lowercase().ends_with("\\conhost.exe")
}

/// Exit code of what was ended from outside.
const KILLED: u32 = 0x4000_4B1D;

impl Drop for Group {
    fn drop(&mut self) {
        self.end();
    }
}

/// For the process that a [`Group`] has started: its job ends it once who started it is gone.
///
/// # Errors
/// None here.
pub fn end_with_starter() -> io::Result<()> {
    Ok(())
}

/// Jobs leave nothing.
pub fn end_started_by(_starter: u32) {}

/// How a process came to its end.
pub fn ending(status: ExitStatus) -> Ending {
    match status.code().unwrap_or_default() as u32 {
        0xC000_0005 => Ending::Crash("access violation".into()),
        0xC000_0094 => Ending::Crash("integer division by zero".into()),
        0xC000_00FD => Ending::Crash("stack overflow".into()),
        0xC000_0409 | 0x4000_0015 => Ending::Abort("fast fail".into()),
        0xC000_0374 => Ending::Crash("heap corruption".into()),
        code @ 0x8000_0000.. => Ending::Crash(format!("exception 0x{code:08X}")),
        code => Ending::Code(code as i32),
    }
}

/// How a process ended, in words that follow "its process".
pub fn how_it_ended(status: ExitStatus) -> String {
    match ending(status) {
        Ending::Code(code) if code as u32 == KILLED => "was ended".into(),
        Ending::Code(code) => format!("ended with exit code {code}"),
        Ending::Abort(how) | Ending::Crash(how) => format!("crashed ({how})"),
    }
}
