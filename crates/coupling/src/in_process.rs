//! An [`Instance`] coupled without an FMU: the library run.

use crate::dense::not_finite;
use crate::instance::{Instance, Snapshot};
use crate::model::{Model, ModelError};
use crate::subsystem::{Failure, Subsystem};
use crate::work::WORK;

/// A model inside this process, with the value references of its coupled variables.
pub struct InProcess<M: Model> {
    name: String,
    instance: Instance<M>,
    inputs: Vec<u32>,
    outputs: Vec<u32>,
    work: Option<u32>,
    slot: Option<Snapshot<M>>,
}

impl<M: Model> InProcess<M> {
    /// Wraps an instance; `inputs` and `outputs` are coupled in the order of the connections.
    pub fn new(name: &str, instance: Instance<M>, inputs: Vec<u32>, outputs: Vec<u32>) -> Self {
        let work = instance.model().interface().find(WORK).map(|reference| reference as u32);
        Self { name: name.to_string(), instance, inputs, outputs, work, slot: None }
    }
    /// The instance, for reading results.
    pub fn instance(&mut self) -> &mut Instance<M> {
        &mut self.instance
    }
    fn failure(&self, error: &ModelError) -> Failure {
        Failure { subsystem: self.name.clone(), message: error.0.clone() }
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
        self.instance.get(&self.outputs, outputs).map_err(|e| self.failure(&e))?;
        let Some(index) = not_finite(outputs) else { return Ok(()) };
        let name = &self.instance.model().interface().variables()[self.outputs[index] as usize].name;
        Err(self.failure(&ModelError(format!("output {name} is {}", outputs[index]))))
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.instance.exit_initialization().map_err(|e| self.failure(&e))
    }
    fn step(&mut self, t: f64, h: f64, _may_restore: bool) -> Result<(), Failure> {
        self.instance.step(t, h).map_err(|e| self.failure(&e))
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
        self.instance.restore(slot).map_err(|e| Failure { subsystem: self.name.clone(), message: e.0 })
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
}
