//! The end of a process that has loaded other people's FMUs.

use std::ffi::{c_int, c_void};
use std::io::Write;

unsafe extern "C" {
    fn fflush(stream: *mut c_void) -> c_int;
    fn _exit(code: c_int) -> !;
}

/// Ends the process, everything written, without the destructors of libraries: those of some FMUs crash at exit (PythonFMU
/// finalizes its interpreter through an object that is freed already) when all results are there and the exit code stands.
pub fn leave(code: u8) -> ! {
    // Nobody is left to be told of a pipe that broke.
    let _ = std::io::stdout().flush();
    let _ = std::io::stderr().flush();
    // SAFETY: a null stream asks for all of C's, which FMUs may have printed to; `_exit` takes any code and never returns.
    unsafe {
        fflush(std::ptr::null_mut());
        _exit(c_int::from(code))
    }
}
