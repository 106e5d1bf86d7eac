//! The `logger` an FMU gets: a C shim formats the message, this hands it to who listens to the instance.
//!
//! Which instance that is, the `componentEnvironment` should tell, but some FMUs hand back another one than they were given, or
//! a pointer to something of their own. So it is a number here and leads nowhere: it is looked up among those that were given. A
//! message that comes in the course of a call belongs to the instance that was called, whatever the number says.

use crate::types::{Status, fmi2CallbackLogger, fmi2ComponentEnvironment};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::sync::{Arc, Mutex, PoisonError};

/// A call of the logger.
pub struct Logged<'a> {
    /// As the FMU rates the message.
    pub status: Status,
    /// Empty where the FMU gave none.
    pub category: &'a [u8],
    /// The text, at most 4095 bytes.
    pub text: &'a [u8],
    /// What is wrong with the call: bits in the order of [`ODDITIES`].
    pub oddities: u32,
}

/// What can be wrong with a call of the logger; logger.c sets all bits but the last.
pub const ODDITIES: [&str; 5] = [
    "NULL as the name of the instance",
    "NULL as the category",
    "NULL as the message",
    "a message that is no valid printf format",
    "another componentEnvironment than it was given",
];

/// Takes what an instance logs, from whatever thread it comes.
pub trait Listener: Send + Sync {
    /// One call of the logger.
    fn hear(&self, logged: &Logged);
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
    fn ttb_fmi2_logger_to(to: unsafe extern "C" fn(*mut c_void, c_int, c_int, *const c_char, *const c_char));
}

/// The `logger` for all FMUs.
pub const LOGGER: fmi2CallbackLogger = ttb_fmi2_logger;

/// All that were given. They stay: a thread of an FMU may log at any time, also after `fmi2FreeInstance`.
static LISTENERS: Mutex<BTreeMap<usize, Arc<dyn Listener>>> = Mutex::new(BTreeMap::new());

thread_local! {
    /// The environment of the instance that is being called in this thread; 0 outside of calls.
    static CALLED: Cell<usize> = const { Cell::new(0) };
}

/// A `componentEnvironment` for an instance to which `listener` listens.
pub fn environment(listener: Arc<dyn Listener>) -> fmi2ComponentEnvironment {
    // SAFETY: only stores the function, the same one each time.
    unsafe { ttb_fmi2_logger_to(logged) };
    // An address of its own, and one that an FMU which looks there can read.
    let own: &'static u64 = Box::leak(Box::new(0));
    let environment = std::ptr::from_ref(own).cast_mut();
    listeners(|all| all.insert(environment as usize, listener));
    environment.cast()
}

/// Marks the instance that is called in this thread until the result is dropped.
pub fn calling(environment: fmi2ComponentEnvironment) -> Calling {
    Calling(CALLED.replace(environment as usize))
}

/// See [`calling`].
pub struct Calling(usize);

impl Drop for Calling {
    fn drop(&mut self) {
        CALLED.set(self.0);
    }
}

fn listeners<T>(with: impl FnOnce(&mut BTreeMap<usize, Arc<dyn Listener>>) -> T) -> T {
    // A map is never left half-changed by a panic.
    with(&mut LISTENERS.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Called by the shim.
///
/// # Safety
/// The text is zero-terminated; the category is so, or null.
unsafe extern "C" fn logged(
    environment: *mut c_void,
    status: c_int,
    oddities: c_int,
    category: *const c_char,
    text: *const c_char,
) {
    let bytes = |pointer: *const c_char| match pointer.is_null() {
        true => &[][..],
        // SAFETY: not null, and zero-terminated by contract.
        false => unsafe { CStr::from_ptr(pointer) }.to_bytes(),
    };
    let (given, called) = (environment as usize, CALLED.get());
    let belongs = if called == 0 { given } else { called };
    let (listener, known) = listeners(|all| {
        let only = || all.values().next().filter(|_| all.len() == 1);
        (all.get(&belongs).or_else(only).cloned(), all.contains_key(&given))
    });
    let Some(listener) = listener else { return };
    let another = !known || (called != 0 && given != called);
    let oddities = oddities as u32 | u32::from(another) << (ODDITIES.len() - 1);
    listener.hear(&Logged { status: Status::from_c(status), category: bytes(category), text: bytes(text), oddities });
}
