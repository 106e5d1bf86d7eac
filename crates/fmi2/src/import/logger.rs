//! The `logger` an FMU gets: a C shim formats the message, this hands it to a log target.

use crate::types::{Status, fmi2CallbackLogger};
use std::ffi::{CStr, c_char, c_int, c_void};
use std::sync::Arc;
use ttb_fmi::log::LogTarget;

/// What an instance's `componentEnvironment` leads to. The shim finds the function by its place: first.
#[repr(C)]
pub struct Environment {
    write: unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char),
    log: Arc<dyn LogTarget>,
}

unsafe extern "C" {
    /// The shim in logger.c.
    fn ttb_fmi2_logger(
        environment: *mut c_void,
        name: *const c_char,
        status: c_int,
        category: *const c_char,
        message: *const c_char,
        ...
    );
}

/// The `logger` for an FMU whose `componentEnvironment` is an [`Environment`].
pub const LOGGER: fmi2CallbackLogger = ttb_fmi2_logger;

impl Environment {
    /// Passes messages on to a log.
    pub fn new(log: Arc<dyn LogTarget>) -> Self {
        Self { write, log }
    }
}

/// Called by the shim.
///
/// # Safety
/// `environment` is the address of an [`Environment`]; the strings are null or zero-terminated.
unsafe extern "C" fn write(environment: *mut c_void, status: c_int, category: *const c_char, text: *const c_char) {
    let bytes = |pointer: *const c_char| match pointer.is_null() {
        true => &[][..],
        // SAFETY: not null, and zero-terminated by contract.
        false => unsafe { CStr::from_ptr(pointer) }.to_bytes(),
    };
    // SAFETY: an instance's environment is never freed.
    let environment = unsafe { &*environment.cast::<Environment>() };
    environment.log.write(Status::from_c(status), bytes(category), bytes(text));
}
