//! An instance of the FMU: what the environment's `fmi2Component` points to.

use super::log::Log;
use super::saved::{Progress, SavedState};
use super::stage::Stage;
use ttb_contract::instance::Phase;
use ttb_contract::{Instance, Kind, Model};

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
