//! What depends on the operating system, in one place: `unix` or `windows`, which offer the same. What is beyond that,
//! shared memory and processes that may be lost ([`crate::isolate::AVAILABLE`]), is there on Linux and on Windows. A port adds
//! modules beside these and nothing elsewhere.

#[cfg(feature = "import")]
pub mod ending;
#[cfg(feature = "import")]
pub mod image;
#[cfg(all(feature = "import", target_os = "linux"))]
mod linux;
#[cfg(all(feature = "import", any(target_os = "linux", windows)))]
pub mod mapping;
#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

#[cfg(all(feature = "import", target_os = "linux"))]
pub use linux::{memory, process, word};
#[cfg(unix)]
pub use unix::*;
#[cfg(windows)]
pub use windows::*;

#[cfg(all(feature = "import", target_os = "linux"))]
pub(crate) use linux::read_until_parent_is_gone;
