//! The shared library of an FMU: loaded, its functions bound once.

use super::slave::Optional;
use crate::types::*;
use libloading::os::unix::{Library, RTLD_GLOBAL, RTLD_LOCAL, RTLD_NOW};
use std::ffi::{CStr, c_char};
use std::path::{Path, PathBuf};

/// Why a shared library cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum LibraryError {
    /// No binary for this machine.
    #[error("has no {wanted}; it has binaries for: {found}")]
    NoBinary {
        /// Path of the library inside the FMU.
        wanted: String,
        /// Folders below `binaries/`.
        found: String,
    },
    /// `dlopen` failed.
    #[error("{} cannot be loaded: {message}{}", path.display(), hint(message))]
    Load {
        /// The library.
        path: PathBuf,
        /// The loader's words.
        message: String,
    },
    /// A function that co-simulation needs.
    #[error("the library has no function {0}, which FMI 2.0 co-simulation needs")]
    MissingSymbol(&'static str),
    /// Another FMI version than the description's.
    #[error("the library implements FMI {0:?}, not 2.0")]
    Version(String),
    /// Any of these, in the process of an isolated FMU.
    #[error("{0}")]
    Isolated(String),
}

/// The library of an FMU built with PythonFMU takes its Python from the process.
fn hint(message: &str) -> &'static str {
    if message.contains("undefined symbol: _Py") || message.contains("undefined symbol: Py") {
        "; it wants Python's library in the program: --preload libpython3.11.so.1.0 (of the version it was built for)"
    } else {
        ""
    }
}

/// Loads a library into the global scope for the rest of the program, for FMUs that expect its symbols there.
///
/// # Errors
/// The loader does not find or accept it.
pub fn preload(name: &Path) -> Result<(), LibraryError> {
    std::mem::forget(open(name, RTLD_NOW | RTLD_GLOBAL)?);
    Ok(())
}

fn open(path: &Path, flags: i32) -> Result<Library, LibraryError> {
    // SAFETY: loading foreign code is what an importer is for: the user chose this library and trusts it to run.
    let opened = unsafe { Library::open(Some(path), flags) };
    opened.map_err(|e| {
        let message = std::error::Error::source(&e).map_or_else(|| e.to_string(), ToString::to_string);
        let message = message.strip_prefix(&format!("{}: ", path.display())).map_or(message.clone(), str::to_string);
        LibraryError::Load { path: path.to_path_buf(), message }
    })
}

/// Declares [`Functions`] from one table: field, type, symbol.
macro_rules! functions {
    (required { $($field:ident: fn($($argument:ty),*) $(-> $result:ty)? = $symbol:literal;)* }
     optional { $($optional:ident: fn($($optional_argument:ty),*) -> $optional_result:ty = $optional_symbol:literal;)* }) => {
        /// The functions of a loaded FMU; they stay callable as long as this struct lives.
        pub(crate) struct Functions {
            $(pub $field: unsafe extern "C" fn($($argument),*) $(-> $result)?,)*
            $(pub $optional: Option<unsafe extern "C" fn($($optional_argument),*) -> $optional_result>,)*
            _library: Library,
        }
        impl Functions {
            fn bind(library: Library) -> Result<Self, LibraryError> {
                Ok(Self {
                    // SAFETY: FMI 2.0 gives the symbol exactly this type.
                    $($field: *unsafe { library.get($symbol) }.map_err(|_| LibraryError::MissingSymbol($symbol))?,)*
                    // SAFETY: as above.
                    $($optional: unsafe { library.get($optional_symbol) }.ok().map(|symbol| *symbol),)*
                    _library: library,
                })
            }
        }
    };
}

type Refs = *const fmi2ValueReference;

functions! {
required {
    get_version: fn() -> *const c_char = "fmi2GetVersion";
    instantiate: fn(fmi2String, fmi2Type, fmi2String, fmi2String, *const fmi2CallbackFunctions, fmi2Boolean, fmi2Boolean) -> fmi2Component
        = "fmi2Instantiate";
    free_instance: fn(fmi2Component) = "fmi2FreeInstance";
    setup_experiment: fn(fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real) -> fmi2Status = "fmi2SetupExperiment";
    enter_initialization: fn(fmi2Component) -> fmi2Status = "fmi2EnterInitializationMode";
    exit_initialization: fn(fmi2Component) -> fmi2Status = "fmi2ExitInitializationMode";
    terminate: fn(fmi2Component) -> fmi2Status = "fmi2Terminate";
    reset: fn(fmi2Component) -> fmi2Status = "fmi2Reset";
    get_real: fn(fmi2Component, Refs, usize, *mut fmi2Real) -> fmi2Status = "fmi2GetReal";
    set_real: fn(fmi2Component, Refs, usize, *const fmi2Real) -> fmi2Status = "fmi2SetReal";
    do_step: fn(fmi2Component, fmi2Real, fmi2Real, fmi2Boolean) -> fmi2Status = "fmi2DoStep";
}
optional {
    get_integer: fn(fmi2Component, Refs, usize, *mut fmi2Integer) -> fmi2Status = "fmi2GetInteger";
    get_boolean: fn(fmi2Component, Refs, usize, *mut fmi2Boolean) -> fmi2Status = "fmi2GetBoolean";
    get_string: fn(fmi2Component, Refs, usize, *mut fmi2String) -> fmi2Status = "fmi2GetString";
    set_integer: fn(fmi2Component, Refs, usize, *const fmi2Integer) -> fmi2Status = "fmi2SetInteger";
    set_boolean: fn(fmi2Component, Refs, usize, *const fmi2Boolean) -> fmi2Status = "fmi2SetBoolean";
    set_string: fn(fmi2Component, Refs, usize, *const fmi2String) -> fmi2Status = "fmi2SetString";
    set_input_derivatives: fn(fmi2Component, Refs, usize, *const fmi2Integer, *const fmi2Real) -> fmi2Status
        = "fmi2SetRealInputDerivatives";
    get_state: fn(fmi2Component, *mut fmi2FMUstate) -> fmi2Status = "fmi2GetFMUstate";
    set_state: fn(fmi2Component, fmi2FMUstate) -> fmi2Status = "fmi2SetFMUstate";
    free_state: fn(fmi2Component, *mut fmi2FMUstate) -> fmi2Status = "fmi2FreeFMUstate";
    serialized_size: fn(fmi2Component, fmi2FMUstate, *mut usize) -> fmi2Status = "fmi2SerializedFMUstateSize";
    serialize_state: fn(fmi2Component, fmi2FMUstate, *mut fmi2Byte, usize) -> fmi2Status = "fmi2SerializeFMUstate";
    deserialize_state: fn(fmi2Component, *const fmi2Byte, usize, *mut fmi2FMUstate) -> fmi2Status = "fmi2DeSerializeFMUstate";
    directional_derivative: fn(fmi2Component, Refs, usize, Refs, usize, *const fmi2Real, *mut fmi2Real) -> fmi2Status
        = "fmi2GetDirectionalDerivative";
}
}

impl Functions {
    /// The set of optional functions that are there, by their bits.
    pub fn optional(&self) -> u64 {
        let there = |is: bool, function: Optional| if is { function.bit() } else { 0 };
        there(self.get_integer.is_some(), Optional::GetInteger)
            | there(self.get_boolean.is_some(), Optional::GetBoolean)
            | there(self.get_string.is_some(), Optional::GetString)
            | there(self.set_integer.is_some(), Optional::SetInteger)
            | there(self.set_boolean.is_some(), Optional::SetBoolean)
            | there(self.set_string.is_some(), Optional::SetString)
            | there(self.set_input_derivatives.is_some(), Optional::SetInputDerivatives)
            | there(self.get_state.is_some(), Optional::GetState)
            | there(self.set_state.is_some(), Optional::SetState)
            | there(self.free_state.is_some(), Optional::FreeState)
            | there(self.serialized_size.is_some() && self.serialize_state.is_some(), Optional::Serialize)
            | there(self.deserialize_state.is_some(), Optional::Deserialize)
            | there(self.directional_derivative.is_some(), Optional::DirectionalDerivative)
    }

    /// Loads the library of an unpacked FMU.
    pub fn load(folder: &Path, model_identifier: &str) -> Result<Self, LibraryError> {
        let functions = Self::bind(open_library(&library_path(folder, model_identifier)?)?)?;
        // SAFETY: takes nothing, and answers with a zero-terminated constant.
        let version = unsafe { (functions.get_version)() };
        // SAFETY: as above; the null check is for FMUs that do not.
        let version = if version.is_null() { "".into() } else { unsafe { CStr::from_ptr(version) }.to_string_lossy() };
        let version = version.to_string();
        if version.starts_with('2') { Ok(functions) } else { Err(LibraryError::Version(version)) }
    }
}

/// Where the library for this machine lies in an unpacked FMU.
///
/// # Errors
/// It has none.
pub fn library_path(folder: &Path, model_identifier: &str) -> Result<PathBuf, LibraryError> {
    use ttb_model_description::package::{LIBRARY_EXTENSION, PLATFORM};
    let wanted = format!("binaries/{PLATFORM}/{model_identifier}.{LIBRARY_EXTENSION}");
    let path = folder.join(&wanted);
    if path.is_file() { Ok(path) } else { Err(LibraryError::NoBinary { wanted, found: platforms(folder) }) }
}

/// Loads it. RTLD_NOW: a symbol that is nowhere shows here, not in the middle of a run.
pub(crate) fn open_library(path: &Path) -> Result<Library, LibraryError> {
    open(path, RTLD_NOW | RTLD_LOCAL)
}

/// Platforms an unpacked FMU has binaries for.
pub fn platforms(folder: &Path) -> String {
    let entries = std::fs::read_dir(folder.join("binaries")).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries.map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    if names.is_empty() { "no platform at all".into() } else { names.join(", ") }
}
