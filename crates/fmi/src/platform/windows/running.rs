//! This process, and what asks it to end.

use super::api;
use std::ffi::c_int;
use std::io::{self, Read};
use std::os::windows::process::CommandExt;
use std::process::Command;
use std::sync::OnceLock;

unsafe extern "C" {
    fn ttb_exit_now(code: c_int) -> !;
}

/// Seconds of CPU that this process has taken so far, all threads.
pub fn cpu() -> f64 {
    let mut times = [0_u64; 4];
    let [creation, exit, kernel, user] = &mut times;
    // SAFETY: four places for four times (FILETIME: 64 bits in units of 100 ns).
    unsafe { api::GetProcessTimes(api::GetCurrentProcess(), creation, exit, kernel, user) };
    1e-7 * (*kernel + *user) as f64
}

/// Memory of this process, kB.
pub fn resident() -> f64 {
    let mut counters = api::MemoryCounters { size: size_of::<api::MemoryCounters>() as u32, ..Default::default() };
    let size = counters.size;
    // SAFETY: a structure of the size that it says.
    unsafe { api::K32GetProcessMemoryInfo(api::GetCurrentProcess(), &raw mut counters, size) };
    counters.working_set as f64 / 1024.0
}

/// Keeps Ctrl-C from a process: it has no console.
pub(crate) fn in_own_group(command: &mut Command) {
    command.creation_flags(api::DETACHED);
}

/// All that the parent process, whose number is `parent`, writes into standard input until it is gone. Nobody else has the
/// writing end; should foreign code close it, the parent itself is waited for.
pub(crate) fn read_until_parent_is_gone(parent: Option<u32>) -> io::Result<Vec<u8>> {
    // SAFETY: opens the process, or none.
    let watched = parent.and_then(|id| api::Owned::new(unsafe { api::OpenProcess(api::SYNCHRONIZE, 0, id) }).ok());
    let mut read = Vec::new();
    // A pipe that breaks has ended.
    let _ = io::stdin().read_to_end(&mut read);
    if let Some(parent) = watched {
        // SAFETY: an open handle.
        unsafe { api::WaitForSingleObject(parent.0, api::INFINITE) };
    }
    Ok(read)
}

/// Ends the process without telling its libraries; what C code has printed is written first.
pub(crate) fn exit_now(code: u8) -> ! {
    // SAFETY: takes any code and never returns.
    unsafe { ttb_exit_now(c_int::from(code)) }
}

/// A descriptor that nothing needs; here none.
pub(crate) fn sentinel() -> c_int {
    -1
}

/// Makes this process deaf to Ctrl-C.
pub(crate) fn ignore_requests_to_end() {
    // SAFETY: no handler: Ctrl-C is ignored.
    unsafe { api::SetConsoleCtrlHandler(None, 1) };
}

type Hear = Box<dyn Fn(i32) + Send + Sync>;
static HEARS: OnceLock<Hear> = OnceLock::new();

/// Calls `hear` with the number that a request to end has on Unix: Ctrl-C 2, Ctrl-Break 15, a console that closes 1.
///
/// Another program cannot send these to one process alone, and not without a console. It sets the event `Local\ttb-end-ID`
/// instead, where ID is the number of this process: that is Ctrl-C.
///
/// # Errors
/// The system takes no handler, has no event, or no thread.
pub fn watch_requests_to_end(hear: impl Fn(i32) + Send + Sync + 'static) -> io::Result<()> {
    let _ = HEARS.set(Box::new(hear));
    // SAFETY: a function that is there as long as the program.
    if unsafe { api::SetConsoleCtrlHandler(Some(heard), 1) } == 0 {
        return Err(io::Error::last_os_error());
    }
    let name = api::wide(&format!(r"Local\ttb-end-{}", std::process::id()));
    // SAFETY: a name that ends with 0; the event resets itself, each setting of it is one request.
    let event = api::Owned::new(unsafe { api::CreateEventW(std::ptr::null(), 0, 0, name.as_ptr()) })?;
    let wait = move || {
        let event = event;
        // SAFETY: an open handle.
        while unsafe { api::WaitForSingleObject(event.0, api::INFINITE) } == 0 {
            tell(2);
        }
    };
    std::thread::Builder::new().name("requests to end".into()).spawn(wait)?;
    Ok(())
}

fn tell(number: i32) {
    if let Some(hear) = HEARS.get() {
        hear(number);
    }
}

unsafe extern "system" fn heard(request: u32) -> i32 {
    let number = match request {
        0 => 2,
        1 => 15,
        _ => 1,
    };
    tell(number);
    // The program is ended once a handler comes back from the close of its console: it has some seconds for its step.
    if number == 1 {
        std::thread::sleep(std::time::Duration::from_secs(30));
    }
    1
}
