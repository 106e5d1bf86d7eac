//! The end of a process that has loaded other people's FMUs.

use crate::{platform, temporary};

/// Ends the process without the destructors of libraries: those of some FMUs crash at exit (PythonFMU finalizes its
/// interpreter through an object that is freed already) when all results are there and the exit code stands. The
/// folders of unpacked FMUs are removed. What the FMUs printed is written; what this program holds back is its own affair.
/// Any thread may call it at any time.
pub fn leave(code: u8) -> ! {
    temporary::remove_all();
    platform::exit_now(code)
}
