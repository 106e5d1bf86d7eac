//! One instance of an FMU: its life, its steps, and what they cost.

use super::description::ModelDescription;
use super::error::FmuError;
use super::fmu::Loaded;
use super::local::Local;
use super::messages::{Message, Sink};
use super::slave::{Answer, Handle, Optional, Slave};
use crate::types::*;
use std::sync::Arc;
use std::time::Duration;

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
    /// Its process has ended.
    Gone,
}

/// A state slot's content: the FMU's handle and the time it was saved at.
#[derive(Clone, Copy, Default)]
pub(super) struct Saved {
    pub handle: Handle,
    pub time: f64,
}

/// An instance of an FMU. Dropping it frees its states, then the instance, then, with the last one, the library.
pub struct FmuInstance {
    pub(super) name: String,
    pub(super) description: Arc<ModelDescription>,
    pub(super) slave: Box<dyn Slave>,
    pub(super) health: Health,
    pub(super) tally: Tally,
    pub(super) states: Vec<Saved>,
    /// Where the FMU is in time, s; for messages.
    pub(super) time: f64,
    initialized: bool,
    sink: Arc<Sink>,
}

impl FmuInstance {
    /// In this process.
    pub(super) fn local(
        name: &str,
        description: Arc<ModelDescription>,
        loaded: Arc<Loaded>,
        logging: bool,
    ) -> Result<Self, FmuError> {
        let sink = Sink::new();
        let (slave, time) = Local::new(name, &description.guid, loaded, Arc::clone(&sink), logging);
        match slave {
            Some(slave) => Ok(Self::new(name, description, Box::new(slave), time, sink)),
            None => Err(FmuError::NoInstance { instance: name.to_string(), messages: sink.take() }),
        }
    }

    /// Around a slave that took `time` to come alive.
    pub(super) fn new(
        name: &str,
        description: Arc<ModelDescription>,
        slave: Box<dyn Slave>,
        time: Duration,
        sink: Arc<Sink>,
    ) -> Self {
        let tally = Tally { time, ..Tally::default() };
        let (name, health, states) = (name.to_string(), Health::Sound, Vec::new());
        Self { name, description, slave, health, tally, states, time: 0.0, initialized: false, sink }
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
        self.time = start;
        self.run("fmi2SetupExperiment", |slave| slave.setup_experiment(start, stop))
    }

    /// Begins initialization.
    ///
    /// # Errors
    /// The FMU refuses, e.g. an impossible parameter.
    pub fn enter_initialization(&mut self) -> Result<(), FmuError> {
        self.run("fmi2EnterInitializationMode", |slave| slave.enter_initialization())
    }

    /// Ends initialization.
    ///
    /// # Errors
    /// The FMU cannot start.
    pub fn exit_initialization(&mut self) -> Result<(), FmuError> {
        self.run("fmi2ExitInitializationMode", |slave| slave.exit_initialization())?;
        self.initialized = true;
        Ok(())
    }

    /// One step from t to t + h (s); `may_restore` tells the FMU that a state from before t may still come back.
    ///
    /// # Errors
    /// The step was not done; the error names t and h.
    pub fn do_step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), FmuError> {
        self.tally.steps += 1;
        self.time = t;
        match self.run("fmi2DoStep", |slave| slave.do_step(t, h, may_restore)) {
            Ok(()) => self.time = t + h,
            Err(FmuError::Call { instance, call, status, messages }) if call == "fmi2DoStep" => {
                let call = format!("fmi2DoStep from t = {t} s by {h} s");
                return Err(FmuError::Call { instance, call, status, messages });
            }
            Err(FmuError::Gone { instance, call, how, messages }) if call.starts_with("fmi2DoStep") => {
                let call = format!("fmi2DoStep from t = {t} s by {h} s");
                return Err(FmuError::Gone { instance, call, how, messages });
            }
            Err(other) => return Err(other),
        }
        Ok(())
    }

    /// Ends the simulation; values stay readable.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn terminate(&mut self) -> Result<(), FmuError> {
        self.initialized = false;
        self.run("fmi2Terminate", |slave| slave.terminate())
    }

    /// Back to the moment after instantiation, also after an error.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn reset(&mut self) -> Result<(), FmuError> {
        self.initialized = false;
        self.mend();
        self.run("fmi2Reset", |slave| slave.reset())
    }

    /// Before a call that is allowed after an error and heals it; should it fail, the instance is broken again.
    pub(super) fn mend(&mut self) {
        if self.health == Health::Broken {
            self.health = Health::Sound;
        }
    }

    /// Makes a call: checks that it is allowed, counts the time, turns the answer into a result.
    pub(super) fn run(
        &mut self,
        call: &'static str,
        work: impl FnOnce(&mut dyn Slave) -> Answer,
    ) -> Result<(), FmuError> {
        if self.health != Health::Sound {
            return Err(self.unusable(call));
        }
        let mark = self.sink.received();
        let answer = work(&mut *self.slave);
        self.slave.collect(&self.sink);
        self.tally.time += answer.time;
        self.tally.warnings += u64::from(answer.warnings);
        if answer.status == Status::Ok as fmi2Status {
            return Ok(());
        }
        self.not_ok(call, Status::from_c(answer.status), mark)
    }

    /// That the library has a function.
    pub(super) fn needs(&self, function: Optional) -> Result<(), FmuError> {
        if self.slave.has(function) { Ok(()) } else { Err(self.missing(function)) }
    }

    #[cold]
    fn missing(&self, function: Optional) -> FmuError {
        self.impossible(format!("its library has no {}", function.symbol()))
    }

    #[cold]
    fn not_ok(&mut self, call: &'static str, status: Status, mark: u64) -> Result<(), FmuError> {
        let call = self.slave.blame().unwrap_or(call);
        if let Some(how) = self.slave.death() {
            self.health = Health::Gone;
            let (instance, how, messages) = (self.name.clone(), how.to_string(), self.sink.since(mark));
            return Err(FmuError::Gone { instance, call: format!("{call} at t = {} s", self.time), how, messages });
        }
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
            Health::Gone => "the FMU's process is gone",
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
        if matches!(self.health, Health::Lost | Health::Gone) {
            return; // better a leak than a call that FMI forbids
        }
        let mut call = "fmi2Terminate";
        if self.initialized && self.health == Health::Sound {
            self.slave.terminate(); // what it answers no longer matters
        }
        if self.slave.death().is_none() && self.slave.has(Optional::FreeState) {
            call = "fmi2FreeFMUstate";
            for state in self.states.iter_mut().filter(|state| state.handle != 0) {
                self.slave.free_state(&mut state.handle);
            }
        }
        if self.slave.death().is_none() {
            call = "fmi2FreeInstance";
            self.slave.free_instance();
        }
        if let Some(how) = self.slave.death() {
            self.slave.report(&format!("{call}: its process {how}"));
        }
    }
}
