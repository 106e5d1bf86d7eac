//! Linux: shared memory, processes that may be lost, waiting for other processes.

pub mod memory;
pub mod process;
mod watch;
pub mod word;

pub(crate) use watch::read_until_parent_is_gone;
