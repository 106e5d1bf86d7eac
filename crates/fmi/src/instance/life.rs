//! The life of an instance, its steps, and what they cost.

use crate::description::ModelDescription;
use crate::error::FmuError;
use crate::log::{Message, Sink};
use crate::slave::{Answer, Call, Handle, Slave};
use crate::status::Status;
use crate::temporary::Temporary;
use crate::version::Version;
use std::sync::Arc;
use std::time::Duration;

/// What an instance has done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Wall time spent inside the FMU.
    pub time: Duration,
    /// Steps that were asked for.
    pub steps: u64,
    /// States saved.
    pub saves: u64,
    /// States restored.
    pub restores: u64,
    /// Calls that answered with a warning.
    pub warnings: u64,
}

/// How an instance may still be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Health {
    /// Well.
    Sound,
    /// Answered with an error: only a restored state, a reset or the end may follow.
    Broken,
    /// Answered with a fatal error: FMI forbids any further call, even freeing.
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

/// An instance of an FMU. Dropping it frees its states, then the instance; with the last one the folder goes.
pub struct FmuInstance {
    pub(super) name: String,
    pub(super) version: &'static Version,
    pub(super) description: Arc<ModelDescription>,
    pub(super) slave: Box<dyn Slave>,
    pub(super) health: Health,
    pub(super) tally: Tally,
    pub(super) states: Vec<Saved>,
    /// Where the FMU is in time, s; for messages.
    pub(super) time: f64,
    initialized: bool,
    sink: Arc<Sink>,
    /// Last, so that the folder goes after all that uses it.
    folder: Arc<Temporary>,
}

impl FmuInstance {
    /// Around a slave that took `time` to be made.
    pub(crate) fn new(
        name: &str,
        version: &'static Version,
        description: Arc<ModelDescription>,
        slave: Box<dyn Slave>,
        time: Duration,
        sink: Arc<Sink>,
        folder: Arc<Temporary>,
    ) -> Self {
        let tally = Tally { time, ..Tally::default() };
        let (name, health, states) = (name.to_string(), Health::Sound, Vec::new());
        let (time, initialized) = (0.0, false);
        Self { name, version, description, slave, health, tally, states, time, initialized, sink, folder }
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
        self.run(Call::SetupExperiment, |slave| slave.setup_experiment(start, stop))
    }

    /// Begins initialization.
    ///
    /// # Errors
    /// The FMU refuses, e.g. an impossible parameter.
    pub fn enter_initialization(&mut self) -> Result<(), FmuError> {
        self.run(Call::EnterInitialization, |slave| slave.enter_initialization())
    }

    /// Ends initialization.
    ///
    /// # Errors
    /// The FMU cannot start.
    pub fn exit_initialization(&mut self) -> Result<(), FmuError> {
        self.run(Call::ExitInitialization, |slave| slave.exit_initialization())?;
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
        match self.run(Call::DoStep, |slave| slave.do_step(t, h, may_restore)) {
            Ok(()) => {
                self.time = t + h;
                Ok(())
            }
            Err(error) => Err(self.with_step(error, t, h)),
        }
    }

    /// An error of a step says which step it was.
    #[cold]
    fn with_step(&self, error: FmuError, t: f64, h: f64) -> FmuError {
        let step = (self.version.symbol)(Call::DoStep);
        let which = || format!("{step} from t = {t} s by {h} s");
        match error {
            FmuError::Call { instance, call, prefix, status, messages } if call == step => {
                FmuError::Call { instance, call: which(), prefix, status, messages }
            }
            FmuError::Gone { instance, call, how, messages } if call.starts_with(step) => {
                FmuError::Gone { instance, call: which(), how, messages }
            }
            other => other,
        }
    }

    /// Ends the simulation; values stay readable.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn terminate(&mut self) -> Result<(), FmuError> {
        self.initialized = false;
        self.run(Call::Terminate, |slave| slave.terminate())
    }

    /// Back to the moment after instantiation, also after an error.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn reset(&mut self) -> Result<(), FmuError> {
        self.initialized = false;
        self.mend();
        self.run(Call::Reset, |slave| slave.reset())
    }

    /// Before a call that is allowed after an error and heals it; should it fail, the instance is broken again.
    pub(super) fn mend(&mut self) {
        if self.health == Health::Broken {
            self.health = Health::Sound;
        }
    }

    /// Makes a call: checks that it is allowed, counts the time, turns the answer into a result.
    pub(super) fn run(&mut self, call: Call, work: impl FnOnce(&mut dyn Slave) -> Answer) -> Result<(), FmuError> {
        if self.health != Health::Sound {
            return Err(self.unusable(call));
        }
        let mark = self.sink.received();
        let answer = work(&mut *self.slave);
        self.slave.collect(&self.sink);
        self.tally.time += answer.time;
        self.tally.warnings += u64::from(answer.warnings);
        if answer.status == Status::Ok as i32 {
            return Ok(());
        }
        self.not_ok(call, Status::of_answer(answer.status), mark)
    }

    /// That the library has a function.
    pub(super) fn needs(&self, function: Call) -> Result<(), FmuError> {
        if self.slave.has(function) { Ok(()) } else { Err(self.missing(function)) }
    }

    #[cold]
    fn missing(&self, function: Call) -> FmuError {
        self.impossible(format!("its library has no {}", (self.version.symbol)(function)))
    }

    #[cold]
    fn not_ok(&mut self, call: Call, status: Status, mark: u64) -> Result<(), FmuError> {
        let call = (self.version.symbol)(self.slave.earlier_failure().unwrap_or(call));
        let instance = self.name.clone();
        if let Some(how) = self.slave.ended() {
            self.health = Health::Gone;
            let messages = self.sink.since(mark);
            return Err(FmuError::Gone { instance, call: format!("{call} at t = {} s", self.time), how, messages });
        }
        match status {
            Status::Ok => return Ok(()),
            Status::Warning => {
                self.tally.warnings += 1;
                return Ok(());
            }
            Status::Fatal => self.health = Health::Lost,
            Status::Discard | Status::Ended | Status::Error | Status::Pending => self.health = Health::Broken,
        }
        let (prefix, messages) = (self.version.prefix, self.sink.since(mark));
        Err(FmuError::Call { instance, call: call.to_string(), prefix, status, messages })
    }

    #[cold]
    fn unusable(&self, call: Call) -> FmuError {
        let why = match self.health {
            Health::Gone => "the FMU's process is gone".to_string(),
            Health::Lost => {
                format!("the FMU answered {}Fatal before and must not be called any more", self.version.prefix)
            }
            _ => "an earlier call failed; restore a state or reset the instance first".to_string(),
        };
        self.impossible(format!("{} was not made: {why}", (self.version.symbol)(call)))
    }

    /// An error about this instance.
    #[cold]
    pub(crate) fn impossible(&self, what: impl Into<String>) -> FmuError {
        FmuError::Impossible { instance: self.name.clone(), what: what.into() }
    }
}

impl Drop for FmuInstance {
    fn drop(&mut self) {
        match self.health {
            Health::Gone => return,
            Health::Lost => {
                // Nothing of it may be called, not even to free it, but its threads may still run: what they use stays,
                // the folder until the program ends.
                std::mem::forget(Arc::clone(&self.folder));
                return;
            }
            Health::Sound | Health::Broken => {}
        }
        let mut call = Call::Terminate;
        if self.initialized && self.health == Health::Sound {
            self.slave.terminate(); // what it answers no longer matters
        }
        if self.slave.ended().is_none() && self.slave.has(Call::FreeState) {
            call = Call::FreeState;
            for state in self.states.iter_mut().filter(|state| state.handle != 0) {
                self.slave.free_state(&mut state.handle);
            }
        }
        if self.slave.ended().is_none() {
            call = Call::FreeInstance;
            self.slave.free_instance();
        }
        if let Some(how) = self.slave.ended() {
            self.slave.report(&format!("{}: {how}", (self.version.symbol)(call)));
        }
    }
}
