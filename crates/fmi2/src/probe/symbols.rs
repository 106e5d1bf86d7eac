//! Which of FMI 2.0's functions a library has.

use crate::import::library_path;
use std::ffi::c_void;
use std::path::Path;
use ttb_fmi::library::{self, LibraryError};

/// Functions no co-simulation master can do without.
const REQUIRED: [&str; 11] = [
    "fmi2GetVersion",
    "fmi2Instantiate",
    "fmi2FreeInstance",
    "fmi2SetupExperiment",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2Terminate",
    "fmi2Reset",
    "fmi2GetReal",
    "fmi2SetReal",
    "fmi2DoStep",
];

/// The others the standard demands of a co-simulation FMU, whatever its capabilities: some importers bind them all.
const DEMANDED: [&str; 23] = [
    "fmi2GetTypesPlatform",
    "fmi2SetDebugLogging",
    "fmi2GetInteger",
    "fmi2GetBoolean",
    "fmi2GetString",
    "fmi2SetInteger",
    "fmi2SetBoolean",
    "fmi2SetString",
    "fmi2GetFMUstate",
    "fmi2SetFMUstate",
    "fmi2FreeFMUstate",
    "fmi2SerializedFMUstateSize",
    "fmi2SerializeFMUstate",
    "fmi2DeSerializeFMUstate",
    "fmi2GetDirectionalDerivative",
    "fmi2SetRealInputDerivatives",
    "fmi2GetRealOutputDerivatives",
    "fmi2CancelStep",
    "fmi2GetStatus",
    "fmi2GetRealStatus",
    "fmi2GetIntegerStatus",
    "fmi2GetBooleanStatus",
    "fmi2GetStringStatus",
];

/// What is missing, in the order of the standard's function list.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Symbols {
    /// Functions nothing goes without.
    pub required: Vec<&'static str>,
    /// Functions the standard demands all the same.
    pub demanded: Vec<&'static str>,
    /// Libraries that are needed, lie beside it, and are not looked for there by the loader.
    pub beside: Vec<String>,
}

/// Loads the library of an unpacked FMU and looks for all functions.
///
/// # Errors
/// There is no library, or it cannot be loaded.
pub fn symbols(folder: &Path, model_identifier: &str) -> Result<Symbols, LibraryError> {
    let (library, beside) = library::open_with(&library_path(folder, model_identifier)?)?;
    // SAFETY: the address is only looked at, never called.
    let missing = |name: &&&'static str| unsafe { library.get::<*const c_void>(**name) }.is_err();
    let all = |names: &'static [&'static str]| names.iter().filter(missing).copied().collect::<Vec<_>>();
    Ok(Symbols { required: all(&REQUIRED), demanded: all(&DEMANDED), beside })
}
