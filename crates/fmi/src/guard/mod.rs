//! Calls into foreign code in this process, and what such code may do to all of it.
//!
//! ```text
//!  rounding, traps, flush to zero      as before after every call
//!  a trap that it has asked for        is not taken: it goes on
//!  exit(), _exit(), pthread_exit()     the call comes to an end instead, and no foreign code is called any more
//!  fork() that comes back twice        the copy ends
//!  folder, umask, signals, limits      put back after calls that are rare, and now and then after steps
//! ```
//!
//! The first and the copy hold always, the others once [`arm`] was called: a program whose process may be lost, like the one of an isolated
//! FMU, does without. `exit` is noticed by a handler of it, `_exit` where foreign code finds its functions in the program. The
//! call is left by `longjmp`, over frames that hold nothing to be dropped. What foreign code leaves behind, a half-changed heap
//! for instance, nobody can mend; so it is called no more, and the program ends by [`crate::leave()`].

use std::ffi::{CString, c_char, c_int, c_void};
use std::mem::MaybeUninit;

unsafe extern "C" {
    fn ttb_guarded(work: unsafe extern "C" fn(*mut c_void), with: *mut c_void) -> c_int;
    fn ttb_guard_arm() -> c_int;
    fn ttb_guard_ended(code: *mut c_int) -> c_int;
    fn ttb_surroundings_keep(folder: *const c_char, sentinel: c_int);
    fn ttb_surroundings_restore() -> c_int;
}

/// What may have changed, in the order of guard.c's bits.
const CHANGES: [&str; 7] = [
    "the current folder",
    "the mask of file permissions (umask)",
    "handlers of signals",
    "blocked signals",
    "limits (ulimit)",
    "the floating-point environment",
    "open files (closed some)",
];

struct Work<F, T> {
    work: Option<F>,
    result: MaybeUninit<T>,
}

unsafe extern "C" fn run<F: FnOnce() -> T, T>(with: *mut c_void) {
    // SAFETY: `call` passes a living Work of these types, which nobody else uses meanwhile.
    let with = unsafe { &mut *with.cast::<Work<F, T>>() };
    if let Some(work) = with.work.take() {
        with.result.write(work());
    }
}

/// Makes a call into foreign code; nothing if that ended the process. The closure must own nothing that has to be dropped, and
/// does nothing but the call.
pub fn call<T: Copy, F: FnOnce() -> T>(work: F) -> Option<T> {
    let mut with = Work { work: Some(work), result: MaybeUninit::uninit() };
    // SAFETY: `run` is of the Work's types, and the Work outlives the call.
    let left = unsafe { ttb_guarded(run::<F, T>, (&raw mut with).cast()) };
    // SAFETY: the call has come back, so that its result is written.
    (left == 0).then(|| unsafe { with.result.assume_init() })
}

/// From now on foreign code in this process does not end it, and what it changes is put back by [`put_back`]. For a program
/// that itself ends by [`crate::leave()`] alone.
pub fn arm() {
    // SAFETY: installs handlers that are there as long as the program. Without them an end is not noticed, as before.
    let _ = unsafe { ttb_guard_arm() };
    keep();
}

/// Remembers how the process is now. For its beginning, before there are other threads that use foreign code.
pub fn keep() {
    let folder = std::env::current_dir().unwrap_or_default().into_os_string().into_encoded_bytes();
    let folder = CString::new(folder).unwrap_or_default();
    // SAFETY: a zero-terminated path, which is copied; the descriptor is only looked at.
    unsafe { ttb_surroundings_keep(folder.as_ptr(), crate::platform::sentinel()) };
}

/// Puts back what foreign code has changed since [`keep`], and says what that was.
pub fn put_back() -> Vec<&'static str> {
    // SAFETY: uses what `keep` has stored.
    let changed = unsafe { ttb_surroundings_restore() };
    (0..CHANGES.len()).filter(|bit| changed >> bit & 1 == 1).map(|bit| CHANGES[bit]).collect()
}

/// Whether foreign code has ended the process.
pub fn has_ended() -> bool {
    let mut code = 0;
    // SAFETY: writes one number.
    unsafe { ttb_guard_ended(&raw mut code) != 0 }
}

/// Whether foreign code has ended the process, in words that follow its name.
pub fn ended() -> Option<String> {
    let mut code = 0;
    // SAFETY: writes one number.
    let ended = unsafe { ttb_guard_ended(&raw mut code) } != 0;
    ended.then(|| format!("it ended the whole program, by exit({code}), and is not called any more"))
}
