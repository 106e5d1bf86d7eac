//! The end of a process that has loaded other people's FMUs.

use std::ffi::{c_int, c_void};

unsafe extern "C" {
    fn fflush(stream: *mut c_void) -> c_int;
    fn _exit(code: c_int) -> !;
}

/// Ends the process without the destructors of libraries: those of some FMUs crash at exit (PythonFMU finalizes its
/// interpreter through an object that is freed already) when all results are there and the exit code stands. What the FMUs
/// printed is written; what this program holds back is its own affair.
pub fn leave(code: u8) -> ! {
    // SAFETY: a null stream asks for all of C's, which FMUs may have printed to; `_exit` takes any code and never returns.
    unsafe {
        fflush(std::ptr::null_mut());
        _exit(c_int::from(code))
    }
}
