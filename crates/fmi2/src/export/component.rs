//! An instance of the FMU: what the environment's `fmi2Component` points to.

use super::log::Log;
use super::states::SavedState;
use ttb_contract::instance::Phase;
use ttb_contract::{Instance, Kind, Model};

/// Where an instance is in its life (FMI 2.0, section 4.2.4); each is one bit, so that a call lists those it accepts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Stage {
    /// Fresh or reset.
    Instantiated = 1,
    /// In initialization mode.
    Initialization = 2,
    /// Between steps.
    Stepping = 4,
    /// A step failed: the physics may be half-way through it.
    Failed = 8,
    /// After `fmi2Terminate`.
    Terminated = 16,
    /// The code panicked: nothing in the model can be trusted.
    Panicked = 32,
}

/// FMI's three families of numeric variables; all values are stored as `f64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// `fmi2Real`.
    Real,
    /// `fmi2Integer`, enumerations included.
    Integer,
    /// `fmi2Boolean`.
    Boolean,
}

/// The course of the simulation as the environment set it; saved and restored with an FMU state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// Start time in s.
    pub start: f64,
    /// Stop time in s, where the environment defined one.
    pub stop: Option<f64>,
    /// End of the last successful step in s.
    pub time: f64,
    /// After `fmi2Terminate`.
    pub terminated: bool,
}

/// One instance.
pub struct Component<M: Model> {
    pub(super) instance: Instance<M>,
    pub(super) log: Log,
    pub(super) progress: Progress,
    pub(super) step_failed: bool,
    pub(super) panicked: bool,
    pub(super) types: Box<[Type]>,
    pub(super) guid: String,
    pub(super) states: Vec<Box<SavedState<M>>>,
}

impl<M: Model> Component<M> {
    /// A fresh instance of a loaded model.
    pub(super) fn new(model: M, guid: String, log: Log) -> Self {
        let types = model.interface().variables().iter().map(|v| match v.kind {
            Kind::Real { .. } => Type::Real,
            Kind::Integer { .. } | Kind::Enumeration(_) => Type::Integer,
            Kind::Boolean => Type::Boolean,
        });
        let types = types.collect();
        let (progress, states) = (Progress::default(), Vec::new());
        Self { instance: Instance::new(model), log, progress, step_failed: false, panicked: false, types, guid, states }
    }

    /// Where the instance is in its life.
    pub fn stage(&self) -> Stage {
        if self.panicked {
            return Stage::Panicked;
        }
        if self.step_failed {
            return Stage::Failed;
        }
        if self.progress.terminated {
            return Stage::Terminated;
        }
        match self.instance.phase() {
            Phase::Instantiated => Stage::Instantiated,
            Phase::Initialization => Stage::Initialization,
            Phase::Stepping => Stage::Stepping,
        }
    }

    /// Name of a variable for messages.
    pub(super) fn name(&self, reference: usize) -> &str {
        &self.instance.model().interface().variables()[reference].name
    }
}
