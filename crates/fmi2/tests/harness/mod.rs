//! Calls the exported C functions of the test model the way an importer does, and catches what they log.
#![allow(dead_code)] // each test file uses its part

#[path = "../models/oscillator.rs"]
pub mod oscillator;

use oscillator::Oscillator;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr;
use std::sync::Mutex;
use ttb_contract::Model;
use ttb_fmi2::types::*;

ttb_fmi2::export_fmu!(Oscillator, "Oscillator");

pub const OK: fmi2Status = Status::Ok as fmi2Status;
pub const WARNING: fmi2Status = Status::Warning as fmi2Status;
pub const ERROR: fmi2Status = Status::Error as fmi2Status;

/// A resources folder with a mass of 2 kg.
pub fn resources() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mass.txt"), "2.0\n").unwrap();
    folder
}

pub fn guid(resources: &Path) -> CString {
    let model = Oscillator::load(resources).unwrap();
    CString::new(ttb_model_description::guid("Oscillator", model.interface())).unwrap()
}

/// What the logger received: (status, category, text).
#[derive(Default)]
pub struct Log(pub Mutex<Vec<(fmi2Status, String, String)>>);

impl Log {
    pub fn take(&self) -> Vec<(fmi2Status, String, String)> {
        std::mem::take(&mut self.0.lock().unwrap())
    }
    pub fn text(&self) -> String {
        self.take().into_iter().map(|(_, _, text)| text).collect::<Vec<_>>().join("\n")
    }
}

/// Takes the one variable argument of "%s" as a fixed one: on the ABIs of Linux a callee finds a pointer argument in the
/// same register either way.
unsafe extern "C" fn logger(
    env: *mut c_void,
    _name: fmi2String,
    status: c_int,
    category: fmi2String,
    format: fmi2String,
    text: *const c_char,
) {
    // SAFETY: the shell passes zero-terminated strings, and the environment is a Log.
    let (log, string) = unsafe { (&*env.cast::<Log>(), |s| CStr::from_ptr(s).to_str().unwrap().to_string()) };
    assert_eq!(string(format), "%s");
    log.0.lock().unwrap().push((status, string(category), string(text)));
}

pub fn callbacks(log: &Log) -> fmi2CallbackFunctions {
    // SAFETY: see `logger`.
    let logger: fmi2CallbackLogger = unsafe { std::mem::transmute(logger as *const ()) };
    let environment = ptr::from_ref(log).cast_mut().cast();
    fmi2CallbackFunctions {
        logger: Some(logger),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        component_environment: environment,
    }
}

/// An instance with its log.
pub struct Slave {
    pub c: fmi2Component,
    pub log: Box<Log>,
}

pub fn instantiate(location: Option<&CStr>, guid: &CStr) -> (fmi2Component, Box<Log>) {
    let log = Box::new(Log::default());
    let callbacks = callbacks(&log);
    let location = location.map_or(ptr::null(), CStr::as_ptr);
    // SAFETY: valid strings; the shell copies the callbacks.
    let c = unsafe {
        fmi2::fmi2Instantiate(
            c"osc".as_ptr(),
            FMI2_CO_SIMULATION,
            guid.as_ptr(),
            location,
            &callbacks,
            FMI2_FALSE,
            FMI2_FALSE,
        )
    };
    (c, log)
}

impl Slave {
    pub fn new() -> Self {
        let resources = resources();
        let location = CString::new(format!("file://{}", resources.path().display())).unwrap();
        let (c, log) = instantiate(Some(&location), &guid(resources.path()));
        assert!(!c.is_null(), "{}", log.text());
        Self { c, log }
    }
    /// After initialization with a force of 10 N.
    pub fn stepping() -> Self {
        Self::stepping_with(|_| {})
    }
    pub fn stepping_with(set: impl FnOnce(&Self)) -> Self {
        let s = Self::new();
        set(&s);
        s.initialize(10.0);
        s
    }
    pub fn initialize(&self, force: f64) {
        assert_eq!(self.call(|c| unsafe { fmi2::fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0) }), OK);
        assert_eq!(self.call(|c| unsafe { fmi2::fmi2EnterInitializationMode(c) }), OK);
        assert_eq!(self.set(oscillator::vr::FORCE, force), OK);
        assert_eq!(self.call(|c| unsafe { fmi2::fmi2ExitInitializationMode(c) }), OK);
    }
    pub fn call(&self, call: impl FnOnce(fmi2Component) -> fmi2Status) -> fmi2Status {
        call(self.c)
    }
    pub fn set(&self, vr: u32, value: f64) -> fmi2Status {
        self.call(|c| unsafe { fmi2::fmi2SetReal(c, &vr, 1, &value) })
    }
    pub fn set_integer(&self, vr: u32, value: i32) -> fmi2Status {
        self.call(|c| unsafe { fmi2::fmi2SetInteger(c, &vr, 1, &value) })
    }
    pub fn rate(&self, order: i32, value: f64) -> fmi2Status {
        self.call(|c| unsafe { fmi2::fmi2SetRealInputDerivatives(c, &oscillator::vr::FORCE, 1, &order, &value) })
    }
    pub fn get_status(&self, vr: u32) -> (fmi2Status, f64) {
        let mut value = f64::NAN;
        (self.call(|c| unsafe { fmi2::fmi2GetReal(c, &vr, 1, &mut value) }), value)
    }
    pub fn get(&self, vr: u32) -> f64 {
        let (status, value) = self.get_status(vr);
        assert_eq!(status, OK, "{}", self.log.text());
        value
    }
    /// Displacement and velocity, as bits.
    pub fn bits(&self) -> [u64; 2] {
        [oscillator::vr::DISPLACEMENT, oscillator::vr::VELOCITY].map(|vr| self.get(vr).to_bits())
    }
    pub fn step(&self, t: f64, h: f64) -> fmi2Status {
        self.call(|c| unsafe { fmi2::fmi2DoStep(c, t, h, FMI2_FALSE) })
    }
    /// Steps of 0.01 s under a force that changes, from step `from` to step `to`.
    pub fn run(&self, from: usize, to: usize) -> Vec<[u64; 2]> {
        let step = |i: usize| {
            let force = 10.0 * (i as f64).sin();
            assert_eq!((self.set(oscillator::vr::FORCE, force), self.rate(1, 3.0 * force)), (OK, OK));
            assert_eq!(self.step(0.01 * i as f64, 0.01), OK, "{}", self.log.text());
            self.bits()
        };
        (from..to).map(step).collect()
    }
    pub fn save(&self, state: &mut fmi2FMUstate) -> fmi2Status {
        self.call(|c| unsafe { fmi2::fmi2GetFMUstate(c, state) })
    }
    pub fn restore(&self, state: fmi2FMUstate) -> fmi2Status {
        self.call(|c| unsafe { fmi2::fmi2SetFMUstate(c, state) })
    }
    pub fn reset(&self) -> fmi2Status {
        self.call(|c| unsafe { fmi2::fmi2Reset(c) })
    }
}

impl Drop for Slave {
    fn drop(&mut self) {
        // SAFETY: a live instance, not used again.
        unsafe { fmi2::fmi2FreeInstance(self.c) };
    }
}
