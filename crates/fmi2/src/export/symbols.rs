//! The 44 C functions of FMI 2.0.
//!
//! `export_fmu!` writes them out from one table, which reads like fmi2Functions.h: C name, arguments, and the function
//! of the shell that answers.

/// Makes a shared library an FMU: `export_fmu!(my_crate::MyModel, "MyModelIdentifier");`
///
/// The model is any [`ttb_contract::Model`]; the identifier must be the one in modelDescription.xml, since it is part of
/// the GUID. Two libraries that used this macro must never be linked into one program: they export the same symbols.
#[macro_export]
macro_rules! export_fmu {
    ($model:ty, $identifier:literal) => {
        /// The C functions of FMI 2.0.
        #[allow(non_snake_case)] // the standard's names
        pub mod fmi2 {
            #[allow(unused_imports)] // where the model's type is given without a path
            use super::*;
            use $crate::export::{instantiate, life_cycle, states, stepping, values};
            use $crate::types::*;
            use std::ffi::c_char;
            type Refs = *const fmi2ValueReference;

            $crate::export_fmu! { @functions
                fmi2GetTypesPlatform() -> *const c_char => c"default".as_ptr();
                fmi2GetVersion() -> *const c_char => c"2.0".as_ptr();
                fmi2SetDebugLogging(c: fmi2Component, on: fmi2Boolean, n: usize, categories: *const fmi2String) -> fmi2Status
                    => life_cycle::set_debug_logging::<$model>(c, on, n, categories);

                fmi2Instantiate(name: fmi2String, fmu_type: fmi2Type, guid: fmi2String, location: fmi2String,
                    functions: *const fmi2CallbackFunctions, visible: fmi2Boolean, logging_on: fmi2Boolean) -> fmi2Component
                    => instantiate::instantiate::<$model>($identifier, name, fmu_type, guid, location, functions, visible, logging_on);
                fmi2FreeInstance(c: fmi2Component) -> () => instantiate::free_instance::<$model>(c);

                fmi2SetupExperiment(c: fmi2Component, tolerance_defined: fmi2Boolean, tolerance: fmi2Real,
                    start: fmi2Real, stop_defined: fmi2Boolean, stop: fmi2Real) -> fmi2Status
                    => life_cycle::setup_experiment::<$model>(c, tolerance_defined, tolerance, start, stop_defined, stop);
                fmi2EnterInitializationMode(c: fmi2Component) -> fmi2Status => life_cycle::enter_initialization::<$model>(c);
                fmi2ExitInitializationMode(c: fmi2Component) -> fmi2Status => life_cycle::exit_initialization::<$model>(c);
                fmi2Terminate(c: fmi2Component) -> fmi2Status => life_cycle::terminate::<$model>(c);
                fmi2Reset(c: fmi2Component) -> fmi2Status => life_cycle::reset::<$model>(c);

                fmi2GetReal(c: fmi2Component, vr: Refs, n: usize, values: *mut fmi2Real) -> fmi2Status
                    => values::get_real::<$model>(c, vr, n, values);
                fmi2GetInteger(c: fmi2Component, vr: Refs, n: usize, values: *mut fmi2Integer) -> fmi2Status
                    => values::get_integer::<$model>(c, vr, n, values);
                fmi2GetBoolean(c: fmi2Component, vr: Refs, n: usize, values: *mut fmi2Boolean) -> fmi2Status
                    => values::get_boolean::<$model>(c, vr, n, values);
                fmi2GetString(c: fmi2Component, _vr: Refs, n: usize, _values: *mut fmi2String) -> fmi2Status
                    => values::string::<$model>(c, "fmi2GetString", n);
                fmi2SetReal(c: fmi2Component, vr: Refs, n: usize, values: *const fmi2Real) -> fmi2Status
                    => values::set_real::<$model>(c, vr, n, values);
                fmi2SetInteger(c: fmi2Component, vr: Refs, n: usize, values: *const fmi2Integer) -> fmi2Status
                    => values::set_integer::<$model>(c, vr, n, values);
                fmi2SetBoolean(c: fmi2Component, vr: Refs, n: usize, values: *const fmi2Boolean) -> fmi2Status
                    => values::set_boolean::<$model>(c, vr, n, values);
                fmi2SetString(c: fmi2Component, _vr: Refs, n: usize, _values: *const fmi2String) -> fmi2Status
                    => values::string::<$model>(c, "fmi2SetString", n);

                fmi2GetFMUstate(c: fmi2Component, state: *mut fmi2FMUstate) -> fmi2Status => states::get_state::<$model>(c, state);
                fmi2SetFMUstate(c: fmi2Component, state: fmi2FMUstate) -> fmi2Status => states::set_state::<$model>(c, state);
                fmi2FreeFMUstate(c: fmi2Component, state: *mut fmi2FMUstate) -> fmi2Status => states::free_state::<$model>(c, state);
                fmi2SerializedFMUstateSize(c: fmi2Component, state: fmi2FMUstate, size: *mut usize) -> fmi2Status
                    => states::serialized_size::<$model>(c, state, size);
                fmi2SerializeFMUstate(c: fmi2Component, state: fmi2FMUstate, bytes: *mut fmi2Byte, size: usize) -> fmi2Status
                    => states::serialize_state::<$model>(c, state, bytes, size);
                fmi2DeSerializeFMUstate(c: fmi2Component, bytes: *const fmi2Byte, size: usize, state: *mut fmi2FMUstate) -> fmi2Status
                    => states::deserialize_state::<$model>(c, bytes, size, state);
                fmi2GetDirectionalDerivative(c: fmi2Component, unknown: Refs, n_unknown: usize, known: Refs, n_known: usize,
                    seed: *const fmi2Real, out: *mut fmi2Real) -> fmi2Status
                    => values::directional_derivative::<$model>(c, unknown, n_unknown, known, n_known, seed, out);

                fmi2SetRealInputDerivatives(c: fmi2Component, vr: Refs, n: usize, orders: *const fmi2Integer,
                    values: *const fmi2Real) -> fmi2Status => values::set_input_derivatives::<$model>(c, vr, n, orders, values);
                fmi2GetRealOutputDerivatives(c: fmi2Component, _vr: Refs, n: usize, _orders: *const fmi2Integer,
                    _values: *mut fmi2Real) -> fmi2Status => values::get_output_derivatives::<$model>(c, n);
                fmi2DoStep(c: fmi2Component, t: fmi2Real, h: fmi2Real, no_set_state_prior: fmi2Boolean) -> fmi2Status
                    => stepping::do_step::<$model>(c, t, h, no_set_state_prior);
                fmi2CancelStep(c: fmi2Component) -> fmi2Status => stepping::cancel_step::<$model>(c);
                fmi2GetStatus(c: fmi2Component, kind: fmi2StatusKind, out: *mut fmi2Status) -> fmi2Status
                    => stepping::get_status::<$model>(c, kind, out);
                fmi2GetRealStatus(c: fmi2Component, kind: fmi2StatusKind, out: *mut fmi2Real) -> fmi2Status
                    => stepping::get_real_status::<$model>(c, kind, out);
                fmi2GetIntegerStatus(c: fmi2Component, kind: fmi2StatusKind, _out: *mut fmi2Integer) -> fmi2Status
                    => stepping::get_integer_status::<$model>(c, kind);
                fmi2GetBooleanStatus(c: fmi2Component, kind: fmi2StatusKind, out: *mut fmi2Boolean) -> fmi2Status
                    => stepping::get_boolean_status::<$model>(c, kind, out);
                fmi2GetStringStatus(c: fmi2Component, kind: fmi2StatusKind, out: *mut fmi2String) -> fmi2Status
                    => stepping::get_string_status::<$model>(c, kind, out);

                fmi2EnterEventMode(c: fmi2Component) -> fmi2Status => stepping::model_exchange::<$model>(c, "fmi2EnterEventMode");
                fmi2NewDiscreteStates(c: fmi2Component, _info: *mut fmi2EventInfo) -> fmi2Status
                    => stepping::model_exchange::<$model>(c, "fmi2NewDiscreteStates");
                fmi2EnterContinuousTimeMode(c: fmi2Component) -> fmi2Status
                    => stepping::model_exchange::<$model>(c, "fmi2EnterContinuousTimeMode");
                fmi2CompletedIntegratorStep(c: fmi2Component, _no_set_state_prior: fmi2Boolean, _enter_event_mode: *mut fmi2Boolean,
                    _terminate: *mut fmi2Boolean) -> fmi2Status => stepping::model_exchange::<$model>(c, "fmi2CompletedIntegratorStep");
                fmi2SetTime(c: fmi2Component, _time: fmi2Real) -> fmi2Status => stepping::model_exchange::<$model>(c, "fmi2SetTime");
                fmi2SetContinuousStates(c: fmi2Component, _x: *const fmi2Real, _n: usize) -> fmi2Status
                    => stepping::model_exchange::<$model>(c, "fmi2SetContinuousStates");
                fmi2GetDerivatives(c: fmi2Component, _derivatives: *mut fmi2Real, _n: usize) -> fmi2Status
                    => stepping::model_exchange::<$model>(c, "fmi2GetDerivatives");
                fmi2GetEventIndicators(c: fmi2Component, _indicators: *mut fmi2Real, _n: usize) -> fmi2Status
                    => stepping::model_exchange::<$model>(c, "fmi2GetEventIndicators");
                fmi2GetContinuousStates(c: fmi2Component, _x: *mut fmi2Real, _n: usize) -> fmi2Status
                    => stepping::model_exchange::<$model>(c, "fmi2GetContinuousStates");
                fmi2GetNominalsOfContinuousStates(c: fmi2Component, _nominals: *mut fmi2Real, _n: usize) -> fmi2Status
                    => stepping::model_exchange::<$model>(c, "fmi2GetNominalsOfContinuousStates");
            }
        }
    };

    (@functions $($name:ident($($argument:ident: $type:ty),*) -> $result:ty => $answer:expr;)*) => {$(
        #[doc = concat!("`", stringify!($name), "` of FMI 2.0.")]
        ///
        /// # Safety
        /// The arguments are as the standard prescribes.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($($argument: $type),*) -> $result {
            #[allow(unused_unsafe)] // two of them return a constant
            // SAFETY: the caller's promise is exactly what the shell asks for.
            unsafe { $answer }
        }
    )*};
}
