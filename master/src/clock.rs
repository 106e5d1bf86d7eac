//! Processor time of this process, all threads.

use rustix::time::{ClockId, clock_gettime};

/// Seconds of CPU so far.
pub fn cpu() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}
