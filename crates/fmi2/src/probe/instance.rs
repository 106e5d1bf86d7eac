//! A probed instance: each method is one call, its answer the status as it came.

use super::Probe;
use super::log::{Log, LogEntry};
use crate::logger::{LOGGER, calling, environment};
use crate::types::*;
use std::ffi::{CString, c_void};
use std::ptr;
use std::sync::Arc;

/// What an instance is made with.
#[derive(Clone, Debug)]
pub struct Instantiation<'a> {
    /// Its name.
    pub name: &'a str,
    /// The GUID it is to compare with its own.
    pub guid: &'a str,
    /// URI of the resources folder.
    pub resources: &'a str,
    /// Whether it is to log everything.
    pub logging: bool,
}

/// An instance. Dropping it does nothing: [`Probed::free`] frees it, at any moment.
pub struct Probed<'a> {
    probe: &'a Probe,
    component: fmi2Component,
    log: Arc<Log>,
    /// Says whose call it is that is being made.
    environment: fmi2ComponentEnvironment,
}

/// A saved state, as the FMU names it.
#[derive(Debug)]
pub struct State(fmi2FMUstate);

unsafe extern "C" {
    fn calloc(count: usize, size: usize) -> *mut c_void;
    fn free(memory: *mut c_void);
}

/// Bytes before which a serializing FMU must stop.
const GUARD: usize = 256;
const GUARD_BYTE: u8 = 0xA5;
/// More than this no FMU can mean.
const LARGEST: usize = 1 << 32;

impl Probe {
    /// `fmi2Instantiate`; nothing and what was logged if it gave NULL.
    ///
    /// # Errors
    /// No instance.
    pub fn instantiate(&self, wanted: &Instantiation) -> Result<Probed<'_>, Vec<LogEntry>> {
        (self.announce)(&format!("fmi2Instantiate{} with the resources {}", self.situation(), wanted.resources));
        let log = Arc::new(Log::default());
        let listener = Arc::clone(&log);
        let environment = environment(listener);
        let callbacks: &'static _ = Box::leak(Box::new(fmi2CallbackFunctions {
            logger: Some(LOGGER),
            allocate_memory: Some(calloc),
            free_memory: Some(free),
            step_finished: None,
            component_environment: environment,
        }));
        let text = |text: &str| CString::new(text).unwrap_or_default();
        let (name, guid, resources) = (text(wanted.name), text(wanted.guid), text(wanted.resources));
        let called = calling(environment);
        // SAFETY: all pointers are valid; the callbacks are so for ever, since a faulty FMU may use them after its end.
        let component = unsafe {
            (self.functions.instantiate)(
                name.as_ptr(),
                FMI2_CO_SIMULATION,
                guid.as_ptr(),
                resources.as_ptr(),
                callbacks,
                FMI2_FALSE,
                fmi2Boolean::from(wanted.logging),
            )
        };
        drop(called);
        if component.is_null() {
            return Err(log.take());
        }
        self.made.set(self.made.get() + 1);
        Ok(Probed { probe: self, component, log, environment })
    }
}

/// A method that makes one call with the component and some arguments.
macro_rules! calls {
    ($($(#[$doc:meta])* $name:ident($($argument:ident: $kind:ty),*) = $field:ident $symbol:literal ($($given:expr),*);)*) => {
        impl Probed<'_> {
            $($(#[$doc])*
            pub fn $name(&mut self $(, $argument: $kind)*) -> Status {
                (self.probe.announce)($symbol);
                let _called = calling(self.environment);
                // SAFETY: a live instance; slices are passed with their length, which a master never gets wrong either.
                Status::from_c(unsafe { (self.probe.functions.$field)(self.component, $($given),*) })
            })*
        }
    };
}

calls! {
    /// Start and, if given, stop time in s.
    setup_experiment(start: f64, stop: Option<f64>) = setup_experiment "fmi2SetupExperiment"
        (FMI2_FALSE, 0.0, start, fmi2Boolean::from(stop.is_some()), stop.unwrap_or(0.0));
    /// Into initialization mode.
    enter_initialization() = enter_initialization "fmi2EnterInitializationMode" ();
    /// Out of it.
    exit_initialization() = exit_initialization "fmi2ExitInitializationMode" ();
    /// The end of a run.
    terminate() = terminate "fmi2Terminate" ();
    /// Back to the moment after instantiation.
    reset() = reset "fmi2Reset" ();
    /// Reads as many Reals as there are references; `values` has room for them.
    get_real(references: &[u32], values: &mut [f64]) = get_real "fmi2GetReal"
        (references.as_ptr(), references.len().min(values.len()), values.as_mut_ptr());
    /// Sets Reals.
    set_real(references: &[u32], values: &[f64]) = set_real "fmi2SetReal"
        (references.as_ptr(), references.len().min(values.len()), values.as_ptr());
}

impl Probed<'_> {
    /// `fmi2DoStep`; a state from before t may still come back.
    pub fn step(&mut self, t: f64, h: f64) -> Status {
        (self.probe.announce)(&format!("fmi2DoStep from t = {t} s by {h} s"));
        let _called = calling(self.environment);
        // SAFETY: a live instance.
        Status::from_c(unsafe { (self.probe.functions.do_step)(self.component, t, h, FMI2_FALSE) })
    }

    /// First derivatives of inputs for the coming step.
    pub fn set_rates(&mut self, references: &[u32], rates: &[f64]) -> Status {
        let _called = calling(self.environment);
        let call = "fmi2SetRealInputDerivatives";
        let Some(set) = self.announced(call, self.probe.functions.set_input_derivatives) else { return Status::Error };
        let orders = vec![1; references.len()];
        let n = references.len().min(rates.len());
        // SAFETY: a live instance and three arrays of n items at least.
        Status::from_c(unsafe { set(self.component, references.as_ptr(), n, orders.as_ptr(), rates.as_ptr()) })
    }

    /// Derivatives of `unknown` along a change of one known variable.
    pub fn derivatives(&mut self, unknown: &[u32], known: u32, out: &mut [f64]) -> Status {
        let _called = calling(self.environment);
        let call = "fmi2GetDirectionalDerivative";
        let Some(get) = self.announced(call, self.probe.functions.directional_derivative) else { return Status::Error };
        let n = unknown.len().min(out.len());
        // SAFETY: a live instance, two arrays of n items and two of one.
        Status::from_c(unsafe { get(self.component, unknown.as_ptr(), n, &known, 1, &1.0, out.as_mut_ptr()) })
    }

    /// Saves, into `over` if there is one.
    pub fn get_state(&mut self, over: Option<State>) -> (Status, State) {
        let _called = calling(self.environment);
        let mut state = over.map_or(ptr::null_mut(), |state| state.0);
        let Some(get) = self.announced("fmi2GetFMUstate", self.probe.functions.get_state) else {
            return (Status::Error, State(state));
        };
        // SAFETY: a live instance; the handle is null or of this instance.
        let status = Status::from_c(unsafe { get(self.component, &raw mut state) });
        (status, State(state))
    }

    /// Restores.
    pub fn set_state(&mut self, state: &State) -> Status {
        let _called = calling(self.environment);
        let Some(set) = self.announced("fmi2SetFMUstate", self.probe.functions.set_state) else { return Status::Error };
        // SAFETY: a live instance and a state of it.
        Status::from_c(unsafe { set(self.component, state.0) })
    }

    /// Frees a state; also whether the handle came back as NULL, which the standard promises.
    pub fn free_state(&mut self, mut state: State) -> (Status, bool) {
        let _called = calling(self.environment);
        let Some(free) = self.announced("fmi2FreeFMUstate", self.probe.functions.free_state) else {
            return (Status::Error, true);
        };
        // SAFETY: a live instance and a state of it, freed once.
        let status = Status::from_c(unsafe { free(self.component, &raw mut state.0) });
        (status, state.0.is_null())
    }

    /// A state as bytes, between guards.
    ///
    /// # Errors
    /// A refusal, or bytes written behind the end, in words.
    pub fn serialize(&mut self, state: &State) -> Result<Vec<u8>, String> {
        let _called = calling(self.environment);
        let f = &self.probe.functions;
        let (Some(size_of), Some(serialize)) = (f.serialized_size, f.serialize_state) else {
            return Err("fmi2SerializeFMUstate is missing".into());
        };
        let mut size = 0;
        (self.probe.announce)("fmi2SerializedFMUstateSize");
        // SAFETY: a live instance and a state of it.
        let status = Status::from_c(unsafe { size_of(self.component, state.0, &raw mut size) });
        if status > Status::Warning {
            return Err(format!("fmi2SerializedFMUstateSize answered fmi2{status}"));
        }
        let mut bytes = Vec::new();
        if size > LARGEST || bytes.try_reserve_exact(size + GUARD).is_err() {
            return Err(format!("fmi2SerializedFMUstateSize asks for {size} bytes"));
        }
        bytes.resize(size, 0_u8);
        bytes.resize(size + GUARD, GUARD_BYTE);
        (self.probe.announce)("fmi2SerializeFMUstate");
        // SAFETY: a live instance, a state of it, room for what it says it needs, and some more.
        let status = Status::from_c(unsafe { serialize(self.component, state.0, bytes.as_mut_ptr().cast(), size) });
        if status > Status::Warning {
            return Err(format!(
                "fmi2SerializeFMUstate answered fmi2{status} for a buffer of the {size} bytes it asked for"
            ));
        }
        if let Some(over) = bytes[size..].iter().rposition(|byte| *byte != GUARD_BYTE) {
            return Err(format!("fmi2SerializeFMUstate wrote {} bytes, {size} were asked for", size + over + 1));
        }
        bytes.truncate(size);
        Ok(bytes)
    }

    /// A state from bytes.
    pub fn deserialize(&mut self, bytes: &[u8]) -> (Status, State) {
        let _called = calling(self.environment);
        let mut state = ptr::null_mut();
        let call = "fmi2DeSerializeFMUstate";
        let Some(deserialize) = self.announced(call, self.probe.functions.deserialize_state) else {
            return (Status::Error, State(state));
        };
        // SAFETY: a live instance, the bytes, and a null handle.
        let status = unsafe { deserialize(self.component, bytes.as_ptr().cast(), bytes.len(), &raw mut state) };
        (Status::from_c(status), State(state))
    }

    /// Whether the FMU ends the simulation of its own accord, as it may after a step that was discarded.
    pub fn wants_end(&mut self) -> bool {
        let _called = calling(self.environment);
        let Some(get) = self.announced("fmi2GetBooleanStatus", self.probe.functions.boolean_status) else {
            return false;
        };
        let mut ends = FMI2_FALSE;
        // SAFETY: a live instance and room for one value.
        let status = Status::from_c(unsafe { get(self.component, status_kind::TERMINATED, &raw mut ends) });
        status <= Status::Warning && ends != FMI2_FALSE
    }

    /// Takes what was logged.
    pub fn take_log(&mut self) -> Vec<LogEntry> {
        self.log.take()
    }

    /// `fmi2FreeInstance`, whatever went before.
    pub fn free(self) {
        (self.probe.announce)("fmi2FreeInstance");
        let _called = calling(self.environment);
        self.probe.freed.set(self.probe.freed.get() + 1);
        // SAFETY: a live instance, never used again.
        unsafe { (self.probe.functions.free_instance)(self.component) };
    }

    /// An optional function, announced.
    fn announced<F>(&self, call: &str, function: Option<F>) -> Option<F> {
        (self.probe.announce)(call);
        function
    }
}

impl State {
    /// Whether the FMU left it NULL.
    pub fn is_null(&self) -> bool {
        self.0.is_null()
    }
}
