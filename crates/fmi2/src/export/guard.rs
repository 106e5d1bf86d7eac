//! What stands between the environment and the model at every call.

use super::component::Component;
use super::stage::Stage;
use crate::types::{Status, fmi2Component, fmi2Status};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use ttb_contract::{Model, ModelError};

/// A C function and the stages it is allowed in.
#[derive(Clone, Copy)]
pub struct Call {
    /// Name in the standard.
    pub name: &'static str,
    /// Bits of [`Stage`].
    pub allowed: u8,
}

/// What a call hands back: a status, or why it was refused.
pub type Answer = Result<Status, ModelError>;

/// `Ok(Status::Ok)`.
pub const DONE: Answer = Ok(Status::Ok);

/// A refusal.
pub fn refuse(message: impl Into<String>) -> Answer {
    Err(ModelError(message.into()))
}

/// Runs `work` on an instance: never on a null one, never in the wrong stage, and never letting a panic out.
///
/// # Safety
/// `component` is null or came from [`instantiate`](super::instantiate::instantiate) for the same `M`, was not freed, and
/// no other call on it is under way (FMI 2.0 forbids the environment anything else).
pub unsafe fn guard<M: Model>(
    component: fmi2Component,
    call: Call,
    work: impl FnOnce(&mut Component<M>) -> Answer,
) -> fmi2Status {
    // SAFETY: by the contract above the pointer is null or an exclusive one to a live component.
    let Some(component) = (unsafe { component.cast::<Component<M>>().as_mut() }) else {
        return Status::Error as fmi2Status;
    };
    let stage = component.stage();
    if stage as u8 & call.allowed == 0 {
        component.log.error(&format!("{} is not possible {}", call.name, why_not(stage)));
        return Status::Error as fmi2Status;
    }
    // Unwind safety: after a panic the instance only accepts calls that overwrite everything the panic may have broken.
    let status = match catch_unwind(AssertUnwindSafe(|| work(component))) {
        Ok(Ok(status)) => status,
        Ok(Err(refusal)) => {
            component.log.error(&format!("{}: {refusal}", call.name));
            Status::Error
        }
        Err(panic) => {
            component.panicked = true;
            let text = panic_text(&*panic);
            component.log.error(&format!("{} met a bug in this FMU ({text}); {}", call.name, RECOVER));
            Status::Error
        }
    };
    status as fmi2Status
}

const RECOVER: &str = "restore an FMU state, reset or free the instance";

fn why_not(stage: Stage) -> String {
    match stage {
        Stage::Instantiated => {
            "before initialization: call fmi2EnterInitializationMode and fmi2ExitInitializationMode first".into()
        }
        Stage::Initialization => "in initialization mode: call fmi2ExitInitializationMode first".into(),
        Stage::Stepping => "after initialization: call fmi2Reset to begin anew".into(),
        Stage::Failed => format!("after a failed step: {RECOVER}"),
        Stage::Terminated => format!("after fmi2Terminate: {RECOVER}"),
        Stage::Panicked => format!("after a panic: {RECOVER}"),
    }
}

/// What a panic said.
pub fn panic_text(panic: &(dyn Any + Send)) -> &str {
    let literal = panic.downcast_ref::<&str>().copied();
    literal.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("a panic without text")
}

/// The `n` values at `pointer`; FMI allows a null pointer where `n` is 0.
///
/// # Safety
/// A non-null `pointer` leads to `n` initialized values that nobody changes while the slice lives.
pub unsafe fn slice<'a, T>(pointer: *const T, n: usize) -> Result<&'a [T], ModelError> {
    match (n, pointer.is_null()) {
        (0, _) => Ok(&[]),
        (_, true) => Err(null()),
        // SAFETY: not null, and n values by contract.
        (_, false) => Ok(unsafe { std::slice::from_raw_parts(pointer, n) }),
    }
}

/// As [`slice()`], for writing.
///
/// # Safety
/// A non-null `pointer` leads to `n` values that nobody else uses while the slice lives.
pub unsafe fn slice_mut<'a, T>(pointer: *mut T, n: usize) -> Result<&'a mut [T], ModelError> {
    match (n, pointer.is_null()) {
        (0, _) => Ok(&mut []),
        (_, true) => Err(null()),
        // SAFETY: not null, and n values by contract.
        (_, false) => Ok(unsafe { std::slice::from_raw_parts_mut(pointer, n) }),
    }
}

/// The place a result goes to.
///
/// # Safety
/// As [`slice_mut`], for one value.
pub unsafe fn place<'a, T>(pointer: *mut T) -> Result<&'a mut T, ModelError> {
    // SAFETY: by contract.
    unsafe { pointer.as_mut() }.ok_or_else(null)
}

fn null() -> ModelError {
    ModelError("a null pointer was passed where FMI 2.0 wants an array or a place for the result".into())
}
