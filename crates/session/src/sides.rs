//! Both sides of a case as models of this process, and a run over them.

use ttb_contract::names::mean_force;
use ttb_contract::{InProcess, Model, ModelError, Pair};
use ttb_coupling::Coupling;

use crate::case::Case;
use crate::coupled::Coupled;
use crate::drive::{Ended, Plan, drive};
use crate::error::RunError;
use crate::observe::Observer;

/// Two models in initialization mode, and their coupling.
pub struct Sides<T: Model, B: Model> {
    /// Train and track.
    pub train_track: InProcess<T>,
    /// The bridge.
    pub bridge: InProcess<B>,
    /// The iteration.
    pub coupling: Coupling,
}

impl<T: Model, B: Model> Sides<T, B> {
    /// Connects two models by the names of their ports.
    ///
    /// # Errors
    /// A model cannot be initialized, or one lacks what the other's ports need.
    pub fn new(train_track: T, bridge: B, case: &Case) -> Result<Self, ModelError> {
        let sent = |force: &str| if case.settings.mean_forces { mean_force(force) } else { force.to_string() };
        let Pair { train_track, bridge, ports } = Pair::new(train_track, bridge, case.axle_load, sent)?;
        Ok(Self { train_track, bridge, coupling: Coupling::new(ports, case.settings) })
    }

    /// Takes all steps of the case, without trial steps before.
    ///
    /// # Errors
    /// As [`drive()`].
    pub fn run(&mut self, plan: &Plan, observers: &mut [&mut dyn Observer]) -> Result<Ended, RunError> {
        let mut coupled = Coupled::new(&mut self.train_track, &mut self.bridge, &mut self.coupling);
        drive(&mut coupled, plan, observers)
    }
}
