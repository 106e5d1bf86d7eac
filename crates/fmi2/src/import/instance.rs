//! One instance of an FMU: its life, its steps, and what they cost.

use super::description::ModelDescription;
use super::error::FmuError;
use super::fmu::{Loaded, file_uri};
use super::library::Functions;
use super::messages::{LOGGER, Message, Sink};
use crate::types::*;
use std::ffi::{CString, c_void};
use std::ptr;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What an instance has done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Wall time spent inside the FMU.
    pub time: Duration,
    /// `fmi2DoStep` calls.
    pub steps: u64,
    /// `fmi2GetFMUstate` calls.
    pub saves: u64,
    /// `fmi2SetFMUstate` calls.
    pub restores: u64,
    /// Calls that answered fmi2Warning.
    pub warnings: u64,
}

/// How an instance may still be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Health {
    /// Well.
    Sound,
    /// Answered fmi2Error: only a restored state, a reset or the end may follow.
    Broken,
    /// Answered fmi2Fatal: FMI 2.0 forbids any further call, even freeing.
    Lost,
}

/// An instance of an FMU. Dropping it frees its states, then the instance, then, with the last one, the library.
pub struct FmuInstance {
    pub(super) name: String,
    pub(super) description: Arc<ModelDescription>,
    pub(super) component: fmi2Component,
    pub(super) health: Health,
    pub(super) tally: Tally,
    pub(super) states: Vec<fmi2FMUstate>,
    initialized: bool,
    sink: Box<Sink>,
    /// FMUs may keep the pointer they were given, so the struct stays where it is.
    _callbacks: Box<fmi2CallbackFunctions>,
    /// Last, so that the library goes last.
    pub(super) loaded: Arc<Loaded>,
}

// SAFETY: an instance may be used from any thread, by one at a time (FMI 2.0, section 2.1.1): `&mut self` sees to the
// latter. The sink is behind a mutex, the callbacks struct is never written.
unsafe impl Send for FmuInstance {}

unsafe extern "C" {
    fn calloc(count: usize, size: usize) -> *mut c_void;
    fn free(memory: *mut c_void);
}

impl FmuInstance {
    pub(super) fn new(
        name: &str,
        description: Arc<ModelDescription>,
        loaded: Arc<Loaded>,
        logging: bool,
    ) -> Result<Self, FmuError> {
        let sink = Sink::new();
        let callbacks = Box::new(fmi2CallbackFunctions {
            logger: Some(LOGGER),
            allocate_memory: Some(calloc),
            free_memory: Some(free),
            step_finished: None,
            component_environment: ptr::from_ref::<Sink>(&sink).cast_mut().cast(),
        });
        let c_name = CString::new(name).unwrap_or_default();
        let guid = CString::new(description.guid.as_str()).unwrap_or_default();
        let resources = CString::new(file_uri(&loaded.folder.path().join("resources"))).unwrap_or_default();
        let begin = Instant::now();
        // SAFETY: the strings and, behind the pointer, the callbacks are valid; the latter and the sink outlive the instance.
        let component = unsafe {
            (loaded.functions.instantiate)(
                c_name.as_ptr(),
                FMI2_CO_SIMULATION,
                guid.as_ptr(),
                resources.as_ptr(),
                &raw const *callbacks,
                FMI2_FALSE,
                fmi2Boolean::from(logging),
            )
        };
        let name = name.to_string();
        if component.is_null() {
            return Err(FmuError::NoInstance { instance: name, messages: sink.take() });
        }
        let tally = Tally { time: begin.elapsed(), ..Tally::default() };
        let (health, states, initialized) = (Health::Sound, Vec::new(), false);
        Ok(Self {
            name,
            description,
            component,
            health,
            tally,
            states,
            initialized,
            sink,
            _callbacks: callbacks,
            loaded,
        })
    }

    /// The name it was given.
    pub fn name(&self) -> &str {
        &self.name
    }
    /// What its FMU says of itself.
    pub fn description(&self) -> &ModelDescription {
        &self.description
    }
    /// What it has done so far.
    pub fn tally(&self) -> Tally {
        self.tally
    }
    /// Takes the messages logged so far (the latest 200).
    pub fn take_messages(&mut self) -> Vec<Message> {
        self.sink.take()
    }

    /// Start time and, if given, stop time in s.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn setup_experiment(&mut self, start: f64, stop: Option<f64>) -> Result<(), FmuError> {
        let (defined, stop) = (fmi2Boolean::from(stop.is_some()), stop.unwrap_or(0.0));
        // SAFETY: a live instance.
        self.run("fmi2SetupExperiment", |f, c| unsafe {
            (f.setup_experiment)(c, FMI2_FALSE, 0.0, start, defined, stop)
        })
    }

    /// Begins initialization.
    ///
    /// # Errors
    /// The FMU refuses, e.g. an impossible parameter.
    pub fn enter_initialization(&mut self) -> Result<(), FmuError> {
        // SAFETY: a live instance.
        self.run("fmi2EnterInitializationMode", |f, c| unsafe { (f.enter_initialization)(c) })
    }

    /// Ends initialization.
    ///
    /// # Errors
    /// The FMU cannot start.
    pub fn exit_initialization(&mut self) -> Result<(), FmuError> {
        // SAFETY: a live instance.
        self.run("fmi2ExitInitializationMode", |f, c| unsafe { (f.exit_initialization)(c) })?;
        self.initialized = true;
        Ok(())
    }

    /// One step from t to t + h (s); `may_restore` tells the FMU that a state from before t may still come back.
    ///
    /// # Errors
    /// The step was not done; the error names t and h.
    pub fn do_step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), FmuError> {
        self.tally.steps += 1;
        let no_restore = fmi2Boolean::from(!may_restore);
        // SAFETY: a live instance.
        let done = self.run("fmi2DoStep", |f, c| unsafe { (f.do_step)(c, t, h, no_restore) });
        done.map_err(|mut error| {
            if let FmuError::Call { call, .. } = &mut error {
                *call = format!("fmi2DoStep from t = {t} s by {h} s");
            }
            error
        })
    }

    /// Ends the simulation; values stay readable.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn terminate(&mut self) -> Result<(), FmuError> {
        self.initialized = false;
        // SAFETY: a live instance.
        self.run("fmi2Terminate", |f, c| unsafe { (f.terminate)(c) })
    }

    /// Back to the moment after instantiation, also after an error.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn reset(&mut self) -> Result<(), FmuError> {
        self.initialized = false;
        self.mend();
        // SAFETY: a live instance.
        self.run("fmi2Reset", |f, c| unsafe { (f.reset)(c) })
    }

    /// Before a call that is allowed after an error and heals it; should it fail, the instance is broken again.
    pub(super) fn mend(&mut self) {
        if self.health == Health::Broken {
            self.health = Health::Sound;
        }
    }

    /// Makes a call: checks that it is allowed, takes the time, turns the answer into a result.
    pub(super) fn run(
        &mut self,
        call: &'static str,
        work: impl FnOnce(&Functions, fmi2Component) -> fmi2Status,
    ) -> Result<(), FmuError> {
        if self.health != Health::Sound {
            return Err(self.unusable(call));
        }
        let mark = self.sink.received();
        let begin = Instant::now();
        let status = work(&self.loaded.functions, self.component);
        self.tally.time += begin.elapsed();
        if status == Status::Ok as fmi2Status { Ok(()) } else { self.not_ok(call, Status::from_c(status), mark) }
    }

    #[cold]
    fn not_ok(&mut self, call: &str, status: Status, mark: u64) -> Result<(), FmuError> {
        match status {
            Status::Ok => return Ok(()),
            Status::Warning => {
                self.tally.warnings += 1;
                return Ok(());
            }
            Status::Fatal => self.health = Health::Lost,
            Status::Discard | Status::Error | Status::Pending => self.health = Health::Broken,
        }
        Err(FmuError::Call {
            instance: self.name.clone(),
            call: call.to_string(),
            status,
            messages: self.sink.since(mark),
        })
    }

    #[cold]
    fn unusable(&self, call: &str) -> FmuError {
        let why = match self.health {
            Health::Lost => "the FMU answered fmi2Fatal before and must not be called any more",
            _ => "an earlier call failed; restore a state or reset the instance first",
        };
        self.impossible(format!("{call} was not made: {why}"))
    }

    /// An error about this instance.
    #[cold]
    pub(super) fn impossible(&self, what: impl Into<String>) -> FmuError {
        FmuError::Impossible { instance: self.name.clone(), what: what.into() }
    }
}

impl Drop for FmuInstance {
    fn drop(&mut self) {
        if self.health == Health::Lost {
            return; // better a leak than a call that FMI forbids
        }
        let functions = &self.loaded.functions;
        if self.initialized && self.health == Health::Sound {
            // SAFETY: a live instance; what it answers no longer matters.
            unsafe { (functions.terminate)(self.component) };
        }
        for state in self.states.iter_mut().filter(|state| !state.is_null()) {
            if let Some(free_state) = functions.free_state {
                // SAFETY: a state of this instance, freed once.
                unsafe { free_state(self.component, state) };
            }
        }
        // SAFETY: a live instance, never used again; library, callbacks and sink are still there.
        unsafe { (functions.free_instance)(self.component) };
    }
}
