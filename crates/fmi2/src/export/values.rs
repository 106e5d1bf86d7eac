//! `fmi2GetXxx`, `fmi2SetXxx`, input derivatives and directional derivatives.
//!
//! Reals are the hot path: one pass over the types, one copy, no allocation.

use super::component::{Component, Type};
use super::guard::{Answer, Call, DONE, guard, refuse, slice, slice_mut};
use super::stage::{READABLE, Stage, USABLE};
use crate::types::*;
use ttb_contract::{Model, ModelError};

impl<M: Model> Component<M> {
    /// All references exist and are of the type of the call.
    fn check_types(&self, references: &[u32], wanted: Type) -> Result<(), ModelError> {
        let mut references = references.iter().map(|r| *r as usize);
        let Some(reference) = references.find(|r| self.types.get(*r) != Some(&wanted)) else { return Ok(()) };
        Err(ModelError(match self.types.get(reference) {
            Some(Type::Real) => format!("{} is a Real; use the Real function", self.name(reference)),
            Some(Type::Integer) => {
                format!("{} is an Integer or Enumeration; use the Integer function", self.name(reference))
            }
            Some(Type::Boolean) => format!("{} is a Boolean; use the Boolean function", self.name(reference)),
            None => format!(
                "there is no value reference {reference}; they run from 0 to {}",
                self.types.len().saturating_sub(1)
            ),
        }))
    }

    fn get(&mut self, references: &[u32], wanted: Type, out: &mut [f64]) -> Answer {
        self.check_types(references, wanted)?;
        self.instance.get(references, out)?;
        DONE
    }

    fn set(&mut self, references: &[u32], wanted: Type, values: &[f64]) -> Answer {
        self.check_types(references, wanted)?;
        self.instance.set(references, values)?;
        DONE
    }
}

/// Reads Reals.
///
/// # Safety
/// As [`guard`]; the arrays hold `n` items.
pub unsafe fn get_real<M: Model>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    n: usize,
    values: *mut fmi2Real,
) -> fmi2Status {
    let call = Call { name: "fmi2GetReal", allowed: READABLE };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, call, |c| c.get(slice(vr, n)?, Type::Real, slice_mut(values, n)?)) }
}

/// Sets Reals.
///
/// # Safety
/// As [`guard`]; the arrays hold `n` items.
pub unsafe fn set_real<M: Model>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    n: usize,
    values: *const fmi2Real,
) -> fmi2Status {
    let call = Call { name: "fmi2SetReal", allowed: USABLE };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, call, |c| c.set(slice(vr, n)?, Type::Real, slice(values, n)?)) }
}

/// Reads Integers, enumerations and Booleans alike: C has one type for them.
unsafe fn get_whole<M: Model>(
    c: fmi2Component,
    call: Call,
    wanted: Type,
    vr: *const u32,
    n: usize,
    values: *mut i32,
) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        // SAFETY: by the contract of the callers.
        let (vr, values) = unsafe { (slice(vr, n)?, slice_mut(values, n)?) };
        let mut reals = vec![0.0; n];
        c.get(vr, wanted, &mut reals)?;
        values.iter_mut().zip(reals).for_each(|(value, real)| *value = real as i32);
        DONE
    };
    // SAFETY: by the contract of the callers.
    unsafe { guard::<M>(c, call, work) }
}

unsafe fn set_whole<M: Model>(
    c: fmi2Component,
    call: Call,
    wanted: Type,
    vr: *const u32,
    n: usize,
    values: *const i32,
    real: impl Fn(i32) -> f64,
) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        // SAFETY: by the contract of the callers.
        let (vr, values) = unsafe { (slice(vr, n)?, slice(values, n)?) };
        let reals: Vec<f64> = values.iter().map(|v| real(*v)).collect();
        c.set(vr, wanted, &reals)
    };
    // SAFETY: by the contract of the callers.
    unsafe { guard::<M>(c, call, work) }
}

/// Reads Integers and enumerations.
///
/// # Safety
/// As [`guard`]; the arrays hold `n` items.
pub unsafe fn get_integer<M: Model>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    n: usize,
    values: *mut fmi2Integer,
) -> fmi2Status {
    // SAFETY: by contract.
    unsafe { get_whole::<M>(c, Call { name: "fmi2GetInteger", allowed: READABLE }, Type::Integer, vr, n, values) }
}

/// Reads Booleans.
///
/// # Safety
/// As [`guard`]; the arrays hold `n` items.
pub unsafe fn get_boolean<M: Model>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    n: usize,
    values: *mut fmi2Boolean,
) -> fmi2Status {
    // SAFETY: by contract.
    unsafe { get_whole::<M>(c, Call { name: "fmi2GetBoolean", allowed: READABLE }, Type::Boolean, vr, n, values) }
}

/// Sets Integers and enumerations.
///
/// # Safety
/// As [`guard`]; the arrays hold `n` items.
pub unsafe fn set_integer<M: Model>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    n: usize,
    values: *const fmi2Integer,
) -> fmi2Status {
    // SAFETY: by contract.
    unsafe {
        set_whole::<M>(c, Call { name: "fmi2SetInteger", allowed: USABLE }, Type::Integer, vr, n, values, f64::from)
    }
}

/// Sets Booleans; anything but 0 is true.
///
/// # Safety
/// As [`guard`]; the arrays hold `n` items.
pub unsafe fn set_boolean<M: Model>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    n: usize,
    values: *const fmi2Boolean,
) -> fmi2Status {
    let truth = |value: i32| f64::from(u8::from(value != FMI2_FALSE));
    // SAFETY: by contract.
    unsafe { set_whole::<M>(c, Call { name: "fmi2SetBoolean", allowed: USABLE }, Type::Boolean, vr, n, values, truth) }
}

/// There are no strings to read or set; asking for none is fine.
///
/// # Safety
/// As [`guard`].
pub unsafe fn string<M: Model>(c: fmi2Component, name: &'static str, n: usize) -> fmi2Status {
    let work = |_: &mut Component<M>| if n == 0 { DONE } else { refuse("this FMU has no String variables") };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name, allowed: READABLE }, work) }
}

/// First derivatives of inputs for the coming step.
///
/// # Safety
/// As [`guard`]; the arrays hold `n` items.
pub unsafe fn set_input_derivatives<M: Model>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    n: usize,
    orders: *const fmi2Integer,
    values: *const fmi2Real,
) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        // SAFETY: by contract.
        let (vr, orders, values) = unsafe { (slice(vr, n)?, slice(orders, n)?, slice(values, n)?) };
        if let Some(order) = orders.iter().find(|order| **order != 1) {
            return refuse(format!("only derivatives of order 1 can be set, not of order {order}"));
        }
        c.check_types(vr, Type::Real)?;
        if n > 0 {
            c.instance.set_rates(vr, values)?;
        }
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name: "fmi2SetRealInputDerivatives", allowed: USABLE }, work) }
}

/// Not provided (`maxOutputDerivativeOrder` is 0); asking for none is fine.
///
/// # Safety
/// As [`guard`].
pub unsafe fn get_output_derivatives<M: Model>(c: fmi2Component, n: usize) -> fmi2Status {
    let work = |_: &mut Component<M>| {
        if n == 0 { DONE } else { refuse("derivatives of outputs are not provided (maxOutputDerivativeOrder is 0)") }
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name: "fmi2GetRealOutputDerivatives", allowed: READABLE }, work) }
}

/// Derivatives of outputs at the end of a step with respect to inputs, along a direction.
///
/// # Safety
/// As [`guard`]; the arrays hold the stated numbers of items.
pub unsafe fn directional_derivative<M: Model>(
    c: fmi2Component,
    unknown: *const fmi2ValueReference,
    n_unknown: usize,
    known: *const fmi2ValueReference,
    n_known: usize,
    seed: *const fmi2Real,
    out: *mut fmi2Real,
) -> fmi2Status {
    let allowed = USABLE & !(Stage::Instantiated as u8);
    let work = |c: &mut Component<M>| {
        // SAFETY: by contract.
        let (unknown, known) = unsafe { (slice(unknown, n_unknown)?, slice(known, n_known)?) };
        // SAFETY: by contract.
        let (seed, out) = unsafe { (slice(seed, n_known)?, slice_mut(out, n_unknown)?) };
        c.instance.directional_derivative(unknown, known, seed, out)?;
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name: "fmi2GetDirectionalDerivative", allowed }, work) }
}
