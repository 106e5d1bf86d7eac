//! An [`Instance`] coupled without an FMU: the library run.

use crate::instance::Instance;
use crate::interface::Kind;
use crate::model::{Model, ModelError};
use crate::names::WORK;
use crate::snapshot::Snapshot;
use crate::subsystem::{Failure, Signal, Subsystem};

/// A model inside this process, with the value references of its coupled variables.
pub struct InProcess<M: Model> {
    name: String,
    instance: Instance<M>,
    inputs: Vec<u32>,
    outputs: Vec<u32>,
    work: Option<u32>,
    recorded: Vec<u32>,
    slot: Option<Snapshot<M>>,
}

impl<M: Model> InProcess<M> {
    /// Wraps an instance; `inputs` and `outputs` are coupled, in the order of the ports.
    pub fn new(name: &str, instance: Instance<M>, inputs: Vec<u32>, outputs: Vec<u32>) -> Self {
        let work = instance.model().interface().find(WORK).map(|reference| reference as u32);
        Self { name: name.to_string(), instance, inputs, outputs, work, recorded: Vec::new(), slot: None }
    }
    /// The instance.
    pub fn instance(&mut self) -> &mut Instance<M> {
        &mut self.instance
    }
    fn failure(&self, error: &ModelError) -> Failure {
        Failure::new(&self.name, &error.0)
    }
}

impl<M: Model> Subsystem for InProcess<M> {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        let set = self.instance.set(&self.inputs, values);
        let set = match rates {
            Some(rates) => set.and_then(|()| self.instance.set_rates(&self.inputs, rates)),
            None => set,
        };
        set.map_err(|e| self.failure(&e))
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        self.instance.get(&self.outputs, outputs).map_err(|e| self.failure(&e))
    }
    fn output_name(&self, index: usize) -> String {
        self.instance.model().interface().variables()[self.outputs[index] as usize].name.clone()
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.instance.exit_initialization().map_err(|e| self.failure(&e))
    }
    fn step(&mut self, t: f64, h: f64, _may_restore: bool) -> Result<(), Failure> {
        self.instance.step(t, h).map_err(|e| Failure { ended: self.instance.model().has_ended(), ..self.failure(&e) })
    }
    fn save(&mut self) -> Result<(), Failure> {
        match &mut self.slot {
            Some(slot) => self.instance.save_into(slot),
            slot => *slot = Some(self.instance.save()),
        }
        Ok(())
    }
    fn restore(&mut self) -> Result<(), Failure> {
        let Some(slot) = &self.slot else {
            return Err(self.failure(&ModelError("restore without a saved state".into())));
        };
        self.instance.restore(slot).map_err(|e| Failure::new(&self.name, e.0))
    }
    fn work(&mut self) -> Result<Option<f64>, Failure> {
        let Some(reference) = self.work else { return Ok(None) };
        let mut work = [0.0];
        self.instance.get(&[reference], &mut work).map_err(|e| self.failure(&e))?;
        Ok(Some(work[0]))
    }
    fn can_interpolate(&self) -> bool {
        true
    }
    fn can_derive(&self) -> bool {
        M::DIRECTIONAL_DERIVATIVES
    }
    fn derivative(&mut self, seed: &[f64], change: &mut [f64]) -> Result<(), Failure> {
        let derived = self.instance.directional_derivative(&self.outputs, &self.inputs, seed, change);
        derived.map_err(|e| self.failure(&e))
    }
    fn record(&mut self, wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        let interface = self.instance.model().interface();
        let signal = |reference: usize| {
            let variable = &interface.variables()[reference];
            let unit = if let Kind::Real { unit } = variable.kind { unit } else { "" };
            Signal { name: variable.name.clone(), unit: unit.into() }
        };
        let chosen = interface.outputs().map(|r| (r as u32, signal(r))).filter(|(_, signal)| wanted(signal));
        let (references, signals) = chosen.unzip();
        self.recorded = references;
        signals
    }
    fn read(&mut self, row: &mut [f64]) -> Result<(), Failure> {
        self.instance.get(&self.recorded, row).map_err(|e| self.failure(&e))
    }
    fn name(&self) -> &str {
        &self.name
    }
}
