//! Processor time of this process, all threads.

/// Seconds of CPU so far.
pub use ttb_fmi::platform::cpu;
