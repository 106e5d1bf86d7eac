//! Other people's FMUs (and ours, which get no favours).
//!
//! [`Fmu::open`] unpacks an archive, reads its description tolerantly and loads its library; [`Fmu::instantiate`] gives
//! an [`FmuInstance`], whose safe methods are the calls of FMI 2.0 co-simulation; [`FmuSubsystem`] couples it.
//! Every failed call becomes an [`FmuError`] that names FMU, call and status and carries what the FMU logged meanwhile.
//! On the way where all is well nothing is allocated, formatted or looked up: a call costs its own time and a clock read.

mod access;
mod decode;
pub mod description;
pub(crate) mod error;
pub(crate) mod fmu;
mod instance;
mod leave;
pub(crate) mod library;
pub(crate) mod local;
pub(crate) mod messages;
mod reader;
pub(crate) mod slave;
mod state;
mod subsystem;
mod transform;
mod unpack;

pub use description::{Capabilities, ModelDescription, ScalarVariable, Unit, VariableType};
pub use error::FmuError;
pub use fmu::Fmu;
pub use fmu::file_uri;
pub use instance::{FmuInstance, Tally};
pub use leave::leave;
pub(crate) use library::{Functions, open_library};
pub use library::{LibraryError, library_path, platforms, preload};
pub use messages::Message;
pub use reader::{DescriptionError, read_description};
pub use state::StateSlot;
pub use subsystem::{Another, FmuSubsystem};
pub use transform::Linear;
pub use unpack::{Limits, UnpackError, unpack, unpack_within};
