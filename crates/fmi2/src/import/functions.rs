//! The functions of a loaded library of FMI 2.0, bound once.

use crate::types::*;
use std::ffi::{CStr, c_char};
use std::mem::ManuallyDrop;
use std::path::{Path, PathBuf};
use ttb_fmi::guard;
use ttb_fmi::library::{self, LibraryError};
use ttb_fmi::platform::Library;
use ttb_fmi::slave::Call;

/// Declares [`Functions`] from one table: field, type, symbol.
macro_rules! functions {
    (required { $($field:ident: fn($($argument:ty),*) $(-> $result:ty)? = $symbol:literal;)* }
     optional { $($optional:ident: fn($($optional_argument:ty),*) -> $optional_result:ty = $optional_symbol:literal;)* }) => {
        /// The functions of a loaded FMU. They stay callable: dropping this leaves the library where it is, since a thread of
        /// it may still run ([`ttb_fmi::library`]).
        pub(crate) struct Functions {
            $(pub $field: unsafe extern "C" fn($($argument),*) $(-> $result)?,)*
            $(pub $optional: Option<unsafe extern "C" fn($($optional_argument),*) -> $optional_result>,)*
            /// The optional functions that are there, by their bits.
            pub optional: u64,
            library: ManuallyDrop<Library>,
        }
        impl Functions {
            fn bind(library: Library) -> Result<Self, LibraryError> {
                let mut functions = Self {
                    // SAFETY: FMI 2.0 gives the symbol exactly this type.
                    $($field: *unsafe { library.get($symbol) }.map_err(|_| LibraryError::MissingSymbol { symbol: $symbol, version: VERSION })?,)*
                    // SAFETY: as above.
                    $($optional: unsafe { library.get($optional_symbol) }.ok().map(|symbol| *symbol),)*
                    optional: 0,
                    library: ManuallyDrop::new(library),
                };
                functions.optional = functions.find_optional();
                Ok(functions)
            }
        }
    };
}

/// In messages.
const VERSION: &str = "2.0";

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
    boolean_status: fn(fmi2Component, fmi2StatusKind, *mut fmi2Boolean) -> fmi2Status = "fmi2GetBooleanStatus";
}
}

impl Functions {
    fn find_optional(&self) -> u64 {
        let there = |is: bool, function: Call| if is { function.bit() } else { 0 };
        there(self.get_integer.is_some(), Call::GetInteger)
            | there(self.get_boolean.is_some(), Call::GetBoolean)
            | there(self.get_string.is_some(), Call::GetString)
            | there(self.set_integer.is_some(), Call::SetInteger)
            | there(self.set_boolean.is_some(), Call::SetBoolean)
            | there(self.set_string.is_some(), Call::SetString)
            | there(self.set_input_derivatives.is_some(), Call::SetInputDerivatives)
            | there(self.get_state.is_some(), Call::GetState)
            | there(self.set_state.is_some(), Call::SetState)
            | there(self.free_state.is_some(), Call::FreeState)
            | there(self.serialized_size.is_some() && self.serialize_state.is_some(), Call::Serialize)
            | there(self.deserialize_state.is_some(), Call::Deserialize)
            | there(self.directional_derivative.is_some(), Call::DirectionalDerivative)
    }

    /// Loads the library of an unpacked FMU.
    pub fn load(folder: &Path, model_identifier: &str) -> Result<Self, LibraryError> {
        let functions = Self::bind(library::open(&library_path(folder, model_identifier)?)?)?;
        // SAFETY: takes nothing, and answers with a zero-terminated constant.
        let version = guard::call(|| unsafe { (functions.get_version)() }).unwrap_or(std::ptr::null());
        // SAFETY: as above; the null check is for FMUs that do not.
        let found = if version.is_null() { "".into() } else { unsafe { CStr::from_ptr(version) }.to_string_lossy() };
        let found = found.to_string();
        if found.starts_with('2') { Ok(functions) } else { Err(LibraryError::Version { found, wanted: VERSION }) }
    }

    /// Unloads the library, whatever it has left running; for a process that may be lost.
    ///
    /// # Safety
    /// Called once, and no function is called afterwards.
    pub unsafe fn unload(&mut self) {
        // SAFETY: by contract.
        unsafe { ManuallyDrop::drop(&mut self.library) };
    }
}

/// Where the library for this machine lies in an unpacked FMU.
///
/// # Errors
/// It has none.
pub fn library_path(folder: &Path, model_identifier: &str) -> Result<PathBuf, LibraryError> {
    use ttb_model_description::package::{LIBRARY_EXTENSION, PLATFORM};
    library::find(folder, format!("binaries/{PLATFORM}/{model_identifier}.{LIBRARY_EXTENSION}"))
}
