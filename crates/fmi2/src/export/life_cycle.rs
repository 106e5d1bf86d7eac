//! From instantiation to termination: the calls that move an instance through its life.

use super::component::Component;
use super::guard::{Call, DONE, guard, refuse, slice};
use super::saved::Progress;
use super::stage::{ALWAYS, READABLE, Stage};
use crate::types::*;
use std::ffi::CStr;
use ttb_contract::Model;

const SET_DEBUG_LOGGING: Call = Call { name: "fmi2SetDebugLogging", allowed: READABLE };
const SETUP_EXPERIMENT: Call = Call { name: "fmi2SetupExperiment", allowed: Stage::Instantiated as u8 };
const ENTER_INITIALIZATION: Call = Call { name: "fmi2EnterInitializationMode", allowed: Stage::Instantiated as u8 };
const EXIT_INITIALIZATION: Call = Call { name: "fmi2ExitInitializationMode", allowed: Stage::Initialization as u8 };
const TERMINATE: Call = Call { name: "fmi2Terminate", allowed: READABLE };
const RESET: Call = Call { name: "fmi2Reset", allowed: ALWAYS };

/// Switches debug logging for the listed categories, for all when none is listed.
///
/// # Safety
/// As [`guard`]; `categories` leads to `n` strings.
pub unsafe fn set_debug_logging<M: Model>(
    c: fmi2Component,
    on: fmi2Boolean,
    n: usize,
    categories: *const fmi2String,
) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        // SAFETY: by contract.
        let pointers = unsafe { slice(categories, n) }?;
        let named = pointers.iter().filter(|p| !p.is_null());
        // SAFETY: not null, and zero-terminated by contract.
        let names: Vec<&str> = named.map(|p| unsafe { CStr::from_ptr(*p) }.to_str().unwrap_or("?")).collect();
        let Some(unknown) = c.log.configure(on != FMI2_FALSE, &names) else { return DONE };
        c.log.warning(&format!("there is no log category {unknown}; modelDescription.xml lists those there are"));
        Ok(Status::Warning)
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, SET_DEBUG_LOGGING, work) }
}

/// Start and stop time.
///
/// # Safety
/// As [`guard`].
pub unsafe fn setup_experiment<M: Model>(
    c: fmi2Component,
    _tolerance_defined: fmi2Boolean,
    _tolerance: fmi2Real,
    start: fmi2Real,
    stop_defined: fmi2Boolean,
    stop: fmi2Real,
) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        let stop = (stop_defined != FMI2_FALSE).then_some(stop);
        if !start.is_finite() || stop.is_some_and(|stop| stop.is_nan() || stop < start) {
            return refuse(format!("an experiment from {start} s to {stop:?} s is impossible"));
        }
        c.progress = Progress { start, stop, terminated: false };
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, SETUP_EXPERIMENT, work) }
}

/// Builds the model for the parameters set so far.
///
/// # Safety
/// As [`guard`].
pub unsafe fn enter_initialization<M: Model>(c: fmi2Component) -> fmi2Status {
    // SAFETY: by contract.
    unsafe {
        guard::<M>(c, ENTER_INITIALIZATION, |c| c.instance.enter_initialization(c.progress.start).map(|()| Status::Ok))
    }
}

/// Static equilibrium becomes the state the first step starts from.
///
/// # Safety
/// As [`guard`].
pub unsafe fn exit_initialization<M: Model>(c: fmi2Component) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        c.instance.exit_initialization()?;
        c.log.event(&format!("initialized at t = {} s", c.progress.start));
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, EXIT_INITIALIZATION, work) }
}

/// Ends the simulation; results stay readable. Tolerant: from any stage, and twice.
///
/// # Safety
/// As [`guard`].
pub unsafe fn terminate<M: Model>(c: fmi2Component) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        c.progress.terminated = true;
        c.log.event(&format!("terminated at t = {} s", c.instance.time()));
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, TERMINATE, work) }
}

/// Back to the moment after instantiation, from any stage.
///
/// # Safety
/// As [`guard`].
pub unsafe fn reset<M: Model>(c: fmi2Component) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        c.instance.reset();
        c.progress = Progress::default();
        (c.step_failed, c.panicked) = (false, false);
        c.log.event("reset");
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, RESET, work) }
}
