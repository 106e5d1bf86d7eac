//! An instance in this process: every verb is the call of a C function.

use super::functions::Functions;
use crate::logger::{LOGGER, Listener, Logged, calling, environment};
use crate::types::*;
use std::ffi::{CStr, CString, c_void};
use std::path::Path;
use std::ptr;
use std::sync::Arc;
use std::time::{Duration, Instant};
use ttb_fmi::guard;
use ttb_fmi::log::LogTarget;
use ttb_fmi::slave::{Answer, Call, Handle, Slave};

/// A living instance. [`Slave::free_instance`] frees it; without that it leaks, which fmi2Fatal demands.
pub struct Local {
    component: fmi2Component,
    functions: Arc<Functions>,
    /// Also says whose call it is that is being made.
    environment: fmi2ComponentEnvironment,
    steps: u32,
}

/// Messages of an instance on their way to its log; what is odd about them `ttb check` tells.
struct Heard(Arc<dyn LogTarget>);

impl Listener for Heard {
    fn hear(&self, logged: &Logged) {
        self.0.write(logged.status, logged.category, logged.text);
    }
}

/// Steps after which is looked at what the FMU has changed in the process: that takes some µs.
const TIDY: u32 = 64;
/// More than this no FMU hands out at once; what asks for more has lost its mind.
const LARGEST: usize = 1 << 32;

// SAFETY: an instance may be used from any thread, by one at a time (FMI 2.0, section 2.1.1): `&mut self` sees to the
// latter.
unsafe impl Send for Local {}

unsafe extern "C" {
    fn calloc(count: usize, size: usize) -> *mut c_void;
    fn free(memory: *mut c_void);
}

impl Local {
    /// `fmi2Instantiate`, and how long it took; nothing if the FMU gives no instance.
    ///
    /// The callbacks, some ten bytes, are never freed: a thread of the FMU may log at any time, also after `fmi2FreeInstance`,
    /// and the more so after fmi2Fatal.
    pub fn new(
        name: &str,
        guid: &str,
        folder: &Path,
        functions: Arc<Functions>,
        log: Arc<dyn LogTarget>,
        logging: bool,
    ) -> (Option<Self>, Duration) {
        let environment = environment(Arc::new(Heard(log)));
        let callbacks: &'static fmi2CallbackFunctions = Box::leak(Box::new(fmi2CallbackFunctions {
            logger: Some(LOGGER),
            allocate_memory: Some(calloc),
            free_memory: Some(free),
            step_finished: None,
            component_environment: environment,
        }));
        let name = CString::new(name).unwrap_or_default();
        let guid = CString::new(guid).unwrap_or_default();
        let resources = CString::new(ttb_fmi::file_uri(&folder.join("resources"))).unwrap_or_default();
        let begin = Instant::now();
        let instance = calling(environment);
        // SAFETY: the strings are valid; the callbacks and what they lead to are so for ever.
        let component = guard::call(|| unsafe {
            (functions.instantiate)(
                name.as_ptr(),
                FMI2_CO_SIMULATION,
                guid.as_ptr(),
                resources.as_ptr(),
                callbacks,
                FMI2_FALSE,
                fmi2Boolean::from(logging),
            )
        });
        drop(instance);
        let time = begin.elapsed();
        guard::put_back();
        let component = component.filter(|component| !component.is_null());
        (component.map(|component| Self { component, functions, environment, steps: 0 }), time)
    }

    /// Makes a call and takes its time.
    fn call(&self, work: impl FnOnce(&Functions, fmi2Component) -> fmi2Status) -> Answer {
        if guard::has_ended() {
            return GONE;
        }
        let instance = calling(self.environment);
        let begin = Instant::now();
        let status = guard::call(|| work(&self.functions, self.component));
        let time = begin.elapsed();
        drop(instance);
        status.map_or(GONE, |status| Answer { status, time, warnings: 0 })
    }

    /// Whether the FMU ends the simulation of its own accord, as it may after a step that was discarded.
    fn wants_end(&self) -> bool {
        let Some(get) = self.functions.boolean_status else { return false };
        let mut ends = FMI2_FALSE;
        // SAFETY: a live instance and room for one value.
        let asked = self.call(|_, c| unsafe { get(c, status_kind::TERMINATED, &raw mut ends) });
        asked.status <= Status::Warning as i32 && ends != FMI2_FALSE
    }

    /// A call that is rare, after which is looked at what it has changed in the process.
    fn rare(&self, work: impl FnOnce(&Functions, fmi2Component) -> fmi2Status) -> Answer {
        let answer = self.call(work);
        guard::put_back();
        answer
    }
}

/// What a call answers that does not come back.
const GONE: Answer = Answer { status: Status::Fatal as fmi2Status, time: Duration::ZERO, warnings: 0 };

/// An optional function of an instance's library; without it the answer is an error.
macro_rules! function {
    ($self:ident.$field:ident) => {
        match $self.functions.$field {
            Some(function) => function,
            None => return Answer::NOTHING,
        }
    };
}

impl Slave for Local {
    fn has(&self, function: Call) -> bool {
        self.functions.optional & function.bit() != 0
    }

    fn setup_experiment(&mut self, start: f64, stop: Option<f64>) -> Answer {
        let (defined, stop) = (fmi2Boolean::from(stop.is_some()), stop.unwrap_or(0.0));
        // SAFETY: a live instance.
        self.rare(|f, c| unsafe { (f.setup_experiment)(c, FMI2_FALSE, 0.0, start, defined, stop) })
    }
    fn enter_initialization(&mut self) -> Answer {
        // SAFETY: a live instance.
        self.rare(|f, c| unsafe { (f.enter_initialization)(c) })
    }
    fn exit_initialization(&mut self) -> Answer {
        // SAFETY: a live instance.
        self.rare(|f, c| unsafe { (f.exit_initialization)(c) })
    }
    fn do_step(&mut self, t: f64, h: f64, may_restore: bool) -> Answer {
        let no_restore = fmi2Boolean::from(!may_restore);
        self.steps = self.steps.wrapping_add(1);
        // SAFETY: a live instance.
        let mut answer = self.call(|f, c| unsafe { (f.do_step)(c, t, h, no_restore) });
        if answer.status == Status::Discard as i32 && self.wants_end() {
            answer.status = Status::Ended as i32;
        } else if answer.status == Status::Ended as i32 {
            answer.status = Status::Fatal as i32; // no value of the standard
        }
        if self.steps.is_multiple_of(TIDY) {
            guard::put_back();
        }
        answer
    }
    fn terminate(&mut self) -> Answer {
        // SAFETY: a live instance.
        self.rare(|f, c| unsafe { (f.terminate)(c) })
    }
    fn reset(&mut self) -> Answer {
        // SAFETY: a live instance.
        self.rare(|f, c| unsafe { (f.reset)(c) })
    }
    fn free_instance(&mut self) {
        self.rare(|f, c| {
            // SAFETY: a live instance, by contract never used again; library and callbacks are still there.
            unsafe { (f.free_instance)(c) };
            Status::Ok as fmi2Status
        });
    }

    fn get_real(&mut self, references: &[u32], values: &mut [f64]) -> Answer {
        let (vr, n, out) = (references.as_ptr(), references.len(), values.as_mut_ptr());
        // SAFETY: a live instance and two arrays of n items.
        self.call(|f, c| unsafe { (f.get_real)(c, vr, n, out) })
    }
    fn set_real(&mut self, references: &[u32], values: &[f64]) -> Answer {
        let (vr, n, values) = (references.as_ptr(), references.len(), values.as_ptr());
        // SAFETY: a live instance and two arrays of n items.
        self.call(|f, c| unsafe { (f.set_real)(c, vr, n, values) })
    }
    fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Answer {
        let set = function!(self.set_input_derivatives);
        let (vr, n, orders, values) = (references.as_ptr(), references.len(), orders.as_ptr(), values.as_ptr());
        // SAFETY: a live instance and three arrays of n items at least.
        self.call(|_, c| unsafe { set(c, vr, n, orders, values) })
    }
    fn directional_derivative(&mut self, unknown: &[u32], known: &[u32], seed: &[f64], out: &mut [f64]) -> Answer {
        let derive = function!(self.directional_derivative);
        let (vr, n, out) = (unknown.as_ptr(), unknown.len(), out.as_mut_ptr());
        let (known, m, seed) = (known.as_ptr(), known.len(), seed.as_ptr());
        // SAFETY: a live instance, two arrays of n items and two of m.
        self.call(|_, c| unsafe { derive(c, vr, n, known, m, seed, out) })
    }
    fn get_integer(&mut self, reference: u32, value: &mut i32) -> Answer {
        let get = function!(self.get_integer);
        // SAFETY: a live instance and arrays of one item.
        self.call(|_, c| unsafe { get(c, &reference, 1, value) })
    }
    fn get_boolean(&mut self, reference: u32, value: &mut bool) -> Answer {
        let get = function!(self.get_boolean);
        let mut answer = FMI2_FALSE;
        let out = &raw mut answer;
        // SAFETY: a live instance and arrays of one item.
        let done = self.call(|_, c| unsafe { get(c, &reference, 1, out) });
        *value = answer != FMI2_FALSE;
        done
    }
    fn get_string(&mut self, reference: u32, value: &mut String) -> Answer {
        let get = function!(self.get_string);
        let mut text: fmi2String = ptr::null();
        let out = &raw mut text;
        // SAFETY: a live instance and arrays of one item.
        let done = self.call(|_, c| unsafe { get(c, &reference, 1, out) });
        value.clear();
        if done.status <= Status::Warning as fmi2Status && !text.is_null() {
            // SAFETY: FMI 2.0 keeps the string until the next call; it is copied here.
            value.push_str(&unsafe { CStr::from_ptr(text) }.to_string_lossy());
        }
        done
    }
    fn set_integer(&mut self, reference: u32, value: i32) -> Answer {
        let set = function!(self.set_integer);
        // SAFETY: a live instance and arrays of one item.
        self.call(|_, c| unsafe { set(c, &reference, 1, &value) })
    }
    fn set_boolean(&mut self, reference: u32, value: bool) -> Answer {
        let set = function!(self.set_boolean);
        let value = fmi2Boolean::from(value);
        // SAFETY: a live instance and arrays of one item.
        self.call(|_, c| unsafe { set(c, &reference, 1, &value) })
    }
    fn set_string(&mut self, reference: u32, value: &str) -> Answer {
        let set = function!(self.set_string);
        let value = CString::new(value).unwrap_or_default();
        // SAFETY: a live instance and arrays of one item.
        self.call(|_, c| unsafe { set(c, &reference, 1, &value.as_ptr()) })
    }

    fn get_state(&mut self, handle: &mut Handle) -> Answer {
        let get = function!(self.get_state);
        let mut state = *handle as fmi2FMUstate;
        let place = &raw mut state;
        // SAFETY: a live instance; the handle is null or of this instance.
        let done = self.call(|_, c| unsafe { get(c, place) });
        *handle = state as Handle;
        done
    }
    fn set_state(&mut self, handle: Handle) -> Answer {
        let set = function!(self.set_state);
        // SAFETY: a live instance and a state of it.
        self.call(|_, c| unsafe { set(c, handle as fmi2FMUstate) })
    }
    fn free_state(&mut self, handle: &mut Handle) -> Answer {
        let free = function!(self.free_state);
        let mut state = std::mem::take(handle) as fmi2FMUstate;
        let place = &raw mut state;
        // SAFETY: a live instance and a state of it, freed once.
        self.call(|_, c| unsafe { free(c, place) })
    }
    fn serialize(&mut self, handle: Handle, bytes: &mut Vec<u8>) -> Answer {
        let (size_of, serialize) = (function!(self.serialized_size), function!(self.serialize_state));
        let mut size = 0;
        let place = &raw mut size;
        // SAFETY: a live instance and a state of it.
        let sized = self.call(|_, c| unsafe { size_of(c, handle as fmi2FMUstate, place) });
        if sized.status > Status::Warning as fmi2Status {
            return sized;
        }
        bytes.clear();
        if size > LARGEST || bytes.try_reserve_exact(size).is_err() {
            return Answer::NOTHING;
        }
        bytes.resize(size, 0);
        let out = bytes.as_mut_ptr().cast();
        // SAFETY: a live instance, a state of it, and room for what it says it needs.
        self.call(|_, c| unsafe { serialize(c, handle as fmi2FMUstate, out, size) })
    }
    fn deserialize(&mut self, bytes: &[u8], handle: &mut Handle) -> Answer {
        let deserialize = function!(self.deserialize_state);
        let mut state = *handle as fmi2FMUstate;
        let place = &raw mut state;
        // SAFETY: a live instance, the bytes, and a handle that is null or of this instance.
        let done = self.call(|_, c| unsafe { deserialize(c, bytes.as_ptr().cast(), bytes.len(), place) });
        *handle = state as Handle;
        done
    }

    fn ended(&self) -> Option<String> {
        guard::ended()
    }
}
