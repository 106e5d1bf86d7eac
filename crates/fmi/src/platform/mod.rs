//! What depends on the operating system, in one place. A port adds modules beside these and nothing elsewhere; where there
//! is no shared memory with [`memory`]'s promises, FMUs cannot be isolated ([`crate::isolate::AVAILABLE`]).

#[cfg(feature = "import")]
pub mod image;
#[cfg(all(feature = "import", target_os = "linux"))]
pub mod memory;
#[cfg(all(feature = "import", target_os = "linux"))]
pub mod process;
mod unix;
#[cfg(all(feature = "import", target_os = "linux"))]
pub mod watch;
#[cfg(all(feature = "import", target_os = "linux"))]
pub mod word;

pub use unix::*;
#[cfg(all(feature = "import", target_os = "linux"))]
pub(crate) use watch::read_until_parent_is_gone;
