//! What a version of FMI adds: how its descriptions are read, its libraries loaded, its functions called.

use crate::description::{DescriptionError, ModelDescription};
use crate::library::LibraryError;
use crate::log::LogTarget;
use crate::slave::{Call, Slave};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Loads the library of an FMU unpacked in a folder, by its model identifier.
pub type Load = fn(&Path, &str) -> Result<Arc<dyn Library>, LibraryError>;

/// A version of FMI, as [`crate::Fmu`] and [`crate::isolate::host()`] need it.
pub struct Version {
    /// Beginning of the version's names, `fmi2`.
    pub prefix: &'static str,
    /// Reads a modelDescription.xml.
    pub read: fn(&[u8]) -> Result<ModelDescription, DescriptionError>,
    /// Loads the library of an FMU unpacked in a folder, by its model identifier.
    pub load: Load,
    /// Name of a function in the standard.
    pub symbol: fn(Call) -> &'static str,
}

/// A loaded library of some version. It is never unloaded by being dropped; see [`crate::library`].
pub trait Library: Send + Sync {
    /// The set of optional functions that are there, by [`Call::bit`].
    fn optional(&self) -> u64;

    /// A new instance, and how long the call took; `folder` is where the FMU is unpacked. Nothing if the FMU gives none.
    fn instantiate(
        self: Arc<Self>,
        name: &str,
        guid: &str,
        folder: &Path,
        log: Arc<dyn LogTarget>,
        logging: bool,
    ) -> (Option<Box<dyn Slave>>, Duration);

    /// Unloads the library, so that its destructors run. Only for a process that may be lost: a thread, a timer or an exit
    /// handler of the library crashes it.
    fn unload(self: Arc<Self>);
}
