//! The C types of FMI 2.0 (fmi2TypesPlatform.h, fmi2FunctionTypes.h), under their names in the standard.
#![allow(non_camel_case_types)]

use std::ffi::{c_char, c_int, c_void};
pub use ttb_fmi::Status;

/// An instance, opaque to the environment.
pub type fmi2Component = *mut c_void;
/// What the environment gets back in its callbacks.
pub type fmi2ComponentEnvironment = *mut c_void;
/// A saved FMU state, opaque to the environment.
pub type fmi2FMUstate = *mut c_void;
/// Handle of a variable.
pub type fmi2ValueReference = u32;
/// Real number.
pub type fmi2Real = f64;
/// Integer and Enumeration.
pub type fmi2Integer = c_int;
/// 0 is false, anything else true.
pub type fmi2Boolean = c_int;
/// Character.
pub type fmi2Char = c_char;
/// Zero-terminated UTF-8.
pub type fmi2String = *const fmi2Char;
/// Byte of a serialized state.
pub type fmi2Byte = c_char;
/// A status as it crosses the boundary; [`Status`] on this side of it.
pub type fmi2Status = c_int;
/// Model exchange (0) or co-simulation (1).
pub type fmi2Type = c_int;
/// What `fmi2GetStatus` and its relatives are asked for; see [`status_kind`].
pub type fmi2StatusKind = c_int;

/// `fmi2True`.
pub const FMI2_TRUE: fmi2Boolean = 1;
/// `fmi2False`.
pub const FMI2_FALSE: fmi2Boolean = 0;
/// `fmi2CoSimulation`.
pub const FMI2_CO_SIMULATION: fmi2Type = 1;

/// Values of [`fmi2StatusKind`].
pub mod status_kind {
    use super::fmi2StatusKind;
    /// Status of an asynchronous step.
    pub const DO_STEP_STATUS: fmi2StatusKind = 0;
    /// Text about an asynchronous step.
    pub const PENDING_STATUS: fmi2StatusKind = 1;
    /// End of the last step that succeeded, in s.
    pub const LAST_SUCCESSFUL_TIME: fmi2StatusKind = 2;
    /// Whether the FMU wants to end the simulation.
    pub const TERMINATED: fmi2StatusKind = 3;
}

/// `fmi2CallbackLogger`: variadic like printf.
pub type fmi2CallbackLogger =
    unsafe extern "C" fn(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, message: fmi2String, ...);
/// `fmi2CallbackAllocateMemory`: zeroed memory for n objects of a size.
pub type fmi2CallbackAllocateMemory = unsafe extern "C" fn(usize, usize) -> *mut c_void;
/// `fmi2CallbackFreeMemory`.
pub type fmi2CallbackFreeMemory = unsafe extern "C" fn(*mut c_void);
/// `fmi2StepFinished`: end of an asynchronous step.
pub type fmi2StepFinished = unsafe extern "C" fn(fmi2ComponentEnvironment, fmi2Status);

/// `fmi2CallbackFunctions`; any of them may be NULL.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct fmi2CallbackFunctions {
    /// Takes messages.
    pub logger: Option<fmi2CallbackLogger>,
    /// calloc.
    pub allocate_memory: Option<fmi2CallbackAllocateMemory>,
    /// free.
    pub free_memory: Option<fmi2CallbackFreeMemory>,
    /// Only for asynchronous steps.
    pub step_finished: Option<fmi2StepFinished>,
    /// Handed back to `logger` and `step_finished`.
    pub component_environment: fmi2ComponentEnvironment,
}

/// `fmi2EventInfo` (model exchange only).
#[repr(C)]
pub struct fmi2EventInfo {
    /// Another event iteration is wanted.
    pub new_discrete_states_needed: fmi2Boolean,
    /// The model ends the simulation.
    pub terminate_simulation: fmi2Boolean,
    /// Nominal values changed.
    pub nominals_of_continuous_states_changed: fmi2Boolean,
    /// States jumped.
    pub values_of_continuous_states_changed: fmi2Boolean,
    /// Whether the next field counts.
    pub next_event_time_defined: fmi2Boolean,
    /// Time of the next event in s.
    pub next_event_time: fmi2Real,
}
