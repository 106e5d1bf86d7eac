//! `fmi2Instantiate` and `fmi2FreeInstance`: the begin and the end of an instance.

use super::component::Component;
use super::guard::panic_text;
use super::log::Log;
use crate::types::*;
use std::ffi::{CStr, CString};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr;
use ttb_contract::{Model, ModelError};
use ttb_fmi::resources::resource_folder;
use ttb_model_description::guid;

/// Loads the model, compares GUIDs, makes an instance; null and a logged message when that fails.
///
/// # Safety
/// Strings are null or zero-terminated; `functions` is null or leads to callbacks that stay callable as long as the
/// instance lives.
pub unsafe fn instantiate<M: Model>(
    identifier: &str,
    name: fmi2String,
    fmu_type: fmi2Type,
    fmu_guid: fmi2String,
    location: fmi2String,
    functions: *const fmi2CallbackFunctions,
    _visible: fmi2Boolean,
    logging_on: fmi2Boolean,
) -> fmi2Component {
    // SAFETY: by contract.
    let (functions, name, fmu_guid, location) =
        unsafe { (functions.as_ref(), text(name), text(fmu_guid), text(location)) };
    let unnamed = CString::new(identifier).unwrap_or_default();
    let log = Log::new(functions, name.filter(|n| !n.is_empty()).unwrap_or(&unnamed), logging_on != FMI2_FALSE);
    // Unwind safety: what a panic leaves behind is dropped unseen.
    let born = catch_unwind(AssertUnwindSafe(|| load::<M>(identifier, fmu_type, fmu_guid, location)));
    let (model, guid) = match born {
        Ok(Ok(loaded)) => loaded,
        Ok(Err(refusal)) => {
            log.error(&format!("fmi2Instantiate: {refusal}"));
            return ptr::null_mut();
        }
        Err(panic) => {
            log.error(&format!("fmi2Instantiate met a bug in this FMU: {}", panic_text(&*panic)));
            return ptr::null_mut();
        }
    };
    let interface = model.interface();
    let (inputs, outputs) = (interface.inputs().len(), interface.outputs().len());
    log.event(&format!(
        "instantiated with {inputs} inputs, {outputs} outputs, {} parameters",
        interface.parameters().len()
    ));
    Box::into_raw(Box::new(Component::new(model, guid, log))).cast()
}

fn load<M: Model>(
    identifier: &str,
    fmu_type: fmi2Type,
    wanted: Option<&CStr>,
    location: Option<&CStr>,
) -> Result<(M, String), ModelError> {
    if fmu_type != FMI2_CO_SIMULATION {
        return Err(ModelError("this FMU is for co-simulation only; instantiate it with fmi2CoSimulation".into()));
    }
    let folder = resource_folder(location, instantiate::<M> as *const () as usize);
    let model = M::load(&folder)?;
    let computed = guid(identifier, model.interface());
    let wanted = wanted.map_or("NULL".into(), |w| w.to_string_lossy());
    if wanted != computed {
        return Err(ModelError(format!(
            "the GUID passed is {wanted}, that of this library with the resources in {} is {computed}; \
             modelDescription.xml belongs to another build or other resources: pack the FMU anew with `ttb build`",
            folder.display()
        )));
    }
    Ok((model, computed))
}

/// The string at a pointer that may be null.
///
/// # Safety
/// Null or zero-terminated, unchanged while the result lives.
unsafe fn text<'a>(pointer: fmi2String) -> Option<&'a CStr> {
    // SAFETY: not null, and zero-terminated by contract.
    (!pointer.is_null()).then(|| unsafe { CStr::from_ptr(pointer) })
}

/// Ends an instance in whatever stage it is; its saved states go with it.
///
/// # Safety
/// `component` is null or came from [`instantiate`] for the same `M` and is never used again.
pub unsafe fn free_instance<M: Model>(component: fmi2Component) {
    if component.is_null() {
        return;
    }
    // SAFETY: made by Box::into_raw in `instantiate`, and given back only once.
    let component = unsafe { Box::from_raw(component.cast::<Component<M>>()) };
    // Unwind safety: nothing of the instance is left to be seen. A panic while dropping leaks what it did not reach.
    let _ = catch_unwind(AssertUnwindSafe(|| drop(component)));
}
