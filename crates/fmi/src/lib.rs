//! What all versions of FMI have in common.
//!
//! ```text
//!  file.fmu → archive → description → fmu ── version::Version: how this version reads, loads, names
//!                                      │
//!            instance ◄── slave::Slave ┤ in this process: functions of the version's library
//!               │                      └ isolate: the same in a process of its own
//!           subsystem: one side of the coupling
//! ```
//!
//! A crate for one version of FMI (`ttb-fmi2`) implements [`slave::Slave`] and [`version::Library`] over the C functions of
//! that version and gives a [`version::Version`]; nothing here knows a function of FMI by its type. [`resources`] serves
//! the export side, [`temporary`] and [`leave()`] the end of the program, [`guard`] keeps foreign calls
//! from what is not theirs, [`platform`] gathers what depends on the
//! operating system.

#[cfg(feature = "import")]
pub mod archive;
#[cfg(feature = "import")]
pub mod description;
#[cfg(feature = "import")]
mod error;
#[cfg(feature = "import")]
mod fmu;
#[cfg(feature = "import")]
pub mod guard;
#[cfg(feature = "import")]
mod instance;
#[cfg(feature = "import")]
pub mod isolate;
#[cfg(feature = "import")]
mod leave;
#[cfg(feature = "import")]
pub mod library;
#[cfg(feature = "import")]
pub mod log;
#[cfg(feature = "import")]
pub mod output;
pub mod platform;
pub mod resources;
#[cfg(feature = "import")]
pub mod slave;
mod status;
#[cfg(feature = "import")]
mod subsystem;
#[cfg(feature = "import")]
pub mod temporary;
#[cfg(feature = "import")]
pub mod text;
#[cfg(feature = "import")]
mod transform;
#[cfg(feature = "import")]
pub mod version;

#[cfg(feature = "import")]
pub use error::FmuError;
#[cfg(feature = "import")]
pub use fmu::{Fmu, file_uri};
#[cfg(feature = "import")]
pub use instance::{FmuInstance, StateSlot, Tally};
#[cfg(feature = "import")]
pub use leave::leave;
pub use status::Status;
#[cfg(feature = "import")]
pub use subsystem::{Another, FmuSubsystem};
#[cfg(feature = "import")]
pub use transform::Linear;
