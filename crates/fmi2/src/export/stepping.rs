//! `fmi2DoStep` and the questions about it.

use super::component::Component;
use super::guard::{Call, DONE, guard, place, refuse};
use super::stage::{READABLE, Stage};
use crate::types::*;
use ttb_contract::Model;

/// How far, relative to max(1, stop), a step may reach past the stop time: importers add up step sizes.
const PAST_STOP: f64 = 1e-9;

/// One step from t to t + h. A step that cannot be done is an error; `fmi2Discard`, which some masters retry for ever, says
/// that the model ends the run there, and then `fmi2Terminated` is true.
///
/// # Safety
/// As [`guard`].
pub unsafe fn do_step<M: Model>(
    c: fmi2Component,
    t: fmi2Real,
    h: fmi2Real,
    _no_set_state_prior: fmi2Boolean,
) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        c.instance.check_step(t, h)?;
        if let Some(stop) = c.progress.stop
            && t + h > stop + PAST_STOP * stop.abs().max(1.0)
        {
            return refuse(format!(
                "the step from {t} s to {} s passes the stop time {stop} s given to fmi2SetupExperiment",
                t + h
            ));
        }
        c.step_failed = true; // until it is done
        match c.instance.step(t, h) {
            Err(end) if c.instance.model().has_ended() => {
                c.log.end(&format!("fmi2DoStep: {end}"));
                Ok(Status::Discard)
            }
            done => {
                done?;
                c.step_failed = false;
                DONE
            }
        }
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name: "fmi2DoStep", allowed: Stage::Stepping as u8 }, work) }
}

/// Steps are synchronous: there is never one to cancel.
///
/// # Safety
/// As [`guard`].
pub unsafe fn cancel_step<M: Model>(c: fmi2Component) -> fmi2Status {
    let call = Call { name: "fmi2CancelStep", allowed: READABLE };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, call, |_| refuse("no step is pending: fmi2DoStep returns when the step is done")) }
}

/// Answers one of the `fmi2GetXxxStatus` functions: `value` for the one kind it knows, else a refusal.
///
/// # Safety
/// As [`guard`]; `out` leads to a place for the result.
unsafe fn answer<M: Model, T>(
    c: fmi2Component,
    name: &'static str,
    kinds: (fmi2StatusKind, fmi2StatusKind),
    out: *mut T,
    value: impl FnOnce(&Component<M>) -> T,
) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        if kinds.0 != kinds.1 {
            return refuse(format!("the status kind {} is not available from this function", kinds.0));
        }
        // SAFETY: by contract.
        *unsafe { place(out) }? = value(c);
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name, allowed: READABLE }, work) }
}

/// Status of the last step.
///
/// # Safety
/// As [`guard`]; `out` leads to a place for the result.
pub unsafe fn get_status<M: Model>(c: fmi2Component, kind: fmi2StatusKind, out: *mut fmi2Status) -> fmi2Status {
    let last = |c: &Component<M>| match c.step_failed {
        false => Status::Ok as fmi2Status,
        true if has_ended(c) => Status::Discard as fmi2Status,
        true => Status::Error as fmi2Status,
    };
    // SAFETY: by contract.
    unsafe { answer(c, "fmi2GetStatus", (kind, status_kind::DO_STEP_STATUS), out, last) }
}

/// End of the last successful step in s.
///
/// # Safety
/// As [`guard`]; `out` leads to a place for the result.
pub unsafe fn get_real_status<M: Model>(c: fmi2Component, kind: fmi2StatusKind, out: *mut fmi2Real) -> fmi2Status {
    let time = |c: &Component<M>| c.instance.time();
    // SAFETY: by contract.
    unsafe { answer(c, "fmi2GetRealStatus", (kind, status_kind::LAST_SUCCESSFUL_TIME), out, time) }
}

/// Nothing can be asked here in FMI 2.0.
///
/// # Safety
/// As [`guard`].
pub unsafe fn get_integer_status<M: Model>(c: fmi2Component, kind: fmi2StatusKind) -> fmi2Status {
    let call = Call { name: "fmi2GetIntegerStatus", allowed: READABLE };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, call, |_| refuse(format!("there is no Integer status of kind {kind}"))) }
}

/// Whether the last step could not be done because the model ends the run there.
fn has_ended<M: Model>(c: &Component<M>) -> bool {
    c.step_failed && c.instance.model().has_ended()
}

/// Whether this FMU wants to end the simulation.
///
/// # Safety
/// As [`guard`]; `out` leads to a place for the result.
pub unsafe fn get_boolean_status<M: Model>(
    c: fmi2Component,
    kind: fmi2StatusKind,
    out: *mut fmi2Boolean,
) -> fmi2Status {
    // SAFETY: by contract.
    unsafe {
        answer(c, "fmi2GetBooleanStatus", (kind, status_kind::TERMINATED), out, |c: &Component<M>| {
            fmi2Boolean::from(has_ended(c))
        })
    }
}

/// Text about a pending step: always empty.
///
/// # Safety
/// As [`guard`]; `out` leads to a place for the result.
pub unsafe fn get_string_status<M: Model>(c: fmi2Component, kind: fmi2StatusKind, out: *mut fmi2String) -> fmi2Status {
    // SAFETY: by contract.
    unsafe {
        answer(c, "fmi2GetStringStatus", (kind, status_kind::PENDING_STATUS), out, |_: &Component<M>| c"".as_ptr())
    }
}

/// The model-exchange functions: exported, since one importer binds all symbols, and refused.
///
/// # Safety
/// As [`guard`].
pub unsafe fn model_exchange<M: Model>(c: fmi2Component, name: &'static str) -> fmi2Status {
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name, allowed: READABLE }, |_| refuse("this FMU is for co-simulation only")) }
}
