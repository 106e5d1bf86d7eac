//! Both sides of a case as models of this process, and a run over them.

use ttb_contract::names::mean_force;
use ttb_contract::{InProcess, Model, ModelError, Pair, Subsystem};
use ttb_coupling::{Coupling, StepInfo};

use crate::case::Case;
use crate::column::Column;
use crate::coupled::Coupled;
use crate::drive::drive;
use crate::error::RunError;
use crate::observe::Observer;
use crate::stepping::{Ended, Plan, Stepping};

/// Two models in initialization mode, and their coupling.
pub struct Sides<T: Model, B: Model> {
    /// Train and track.
    pub train_track: InProcess<T>,
    /// The bridge.
    pub bridge: InProcess<B>,
    /// The iteration.
    pub coupling: Coupling,
    /// How many columns are the train–track side's.
    of_train_track: usize,
}

impl<T: Model, B: Model> Sides<T, B> {
    /// Connects two models by the names of their ports.
    ///
    /// # Errors
    /// A model cannot be initialized, or one lacks what the other's ports need.
    pub fn new(train_track: T, bridge: B, case: &Case) -> Result<Self, ModelError> {
        let sent = |force: &str| if case.settings.mean_forces { mean_force(force) } else { force.to_string() };
        let Pair { train_track, bridge, ports } = Pair::new(train_track, bridge, case.axle_load, sent)?;
        Ok(Self { train_track, bridge, coupling: Coupling::new(ports, case.settings), of_train_track: 0 })
    }

    /// Takes all steps of the case, without trial steps before.
    ///
    /// # Errors
    /// As [`drive()`].
    pub fn run(&mut self, plan: &Plan, observers: &mut [&mut dyn Observer]) -> Result<Ended, RunError> {
        drive(self, plan, observers)
    }

    fn coupled(&mut self) -> Coupled<'_> {
        Coupled::again(&mut self.train_track, &mut self.bridge, &mut self.coupling, self.of_train_track)
    }
}

impl<T: Model, B: Model> Stepping for Sides<T, B> {
    fn columns(&mut self, wanted: &dyn Fn(&Column) -> bool) -> Vec<Column> {
        let mut coupled = self.coupled();
        let columns = coupled.columns(wanted);
        self.of_train_track = coupled.of_train_track();
        columns
    }
    fn start(&mut self) -> Result<(), RunError> {
        self.coupled().start()
    }
    fn step(&mut self, t: f64, h: f64) -> Result<StepInfo, RunError> {
        self.coupled().step(t, h)
    }
    fn read(&mut self, row: &mut [f64]) -> Result<(), RunError> {
        self.coupled().read(row)
    }
    fn inside(&self) -> [f64; 2] {
        [self.train_track.seconds(), self.bridge.seconds()]
    }
}
