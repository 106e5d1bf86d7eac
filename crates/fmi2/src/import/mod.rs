//! FMUs of FMI 2.0, other people's and ours, which are treated alike.
//!
//! [`VERSION`] is what `ttb_fmi` needs of this version: `read_description` reads its descriptions, `functions` binds its
//! libraries, `local` calls them. `open` gives an [`Fmu`](ttb_fmi::Fmu), [`ttb_fmi::Fmu::instantiate`] an
//! [`FmuInstance`](ttb_fmi::FmuInstance), whose safe methods are the calls of co-simulation;
//! [`FmuSubsystem`](ttb_fmi::FmuSubsystem) couples it. Every failed call becomes an error that names FMU, call and status and
//! carries what the FMU logged meanwhile. While all is well nothing is allocated, formatted or looked up: a call costs its
//! own time and a clock read.

pub(crate) mod functions;
mod local;
mod reader;
mod version;

pub use functions::library_path;
pub use reader::read_description;
pub use version::{VERSION, host, open, open_isolated};
