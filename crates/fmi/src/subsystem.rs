//! An FMU as one side of the coupling.

use crate::description::{ScalarVariable, VariableType};
use crate::error::FmuError;
use crate::instance::{FmuInstance, StateSlot};
use crate::transform::{Linear, Transform};
use ttb_contract::names::WORK;
use ttb_contract::{Failure, Signal, Subsystem};

/// Makes an instance like a coupled one, coupled alike and in initialization mode.
pub type Another = Box<dyn Fn() -> Result<FmuSubsystem, FmuError> + Send>;

/// An instance with the value references of its coupled variables, in the order of the connections. Everything the
/// iteration needs is allocated here, once.
pub struct FmuSubsystem {
    instance: FmuInstance,
    inputs: Vec<u32>,
    orders: Vec<i32>,
    outputs: Vec<u32>,
    work: Option<u32>,
    slot: StateSlot,
    transform: Option<Transform>,
    roll_back: bool,
    another: Option<Another>,
    /// The outputs that are recorded.
    recorded: Vec<u32>,
}

impl FmuSubsystem {
    /// Couples Reals by name.
    ///
    /// # Errors
    /// A variable that does not exist, is no Real, or is no input or output: all of them in one message.
    pub fn new<S: AsRef<str>>(mut instance: FmuInstance, inputs: &[S], outputs: &[S]) -> Result<Self, FmuError> {
        let mut problems = Vec::new();
        let mut find = |names: &[S], causality: &str| -> Vec<u32> {
            let checked = names.iter().map(AsRef::as_ref).map(|name| match instance.description().variable(name) {
                None => Err(format!("it has no variable {name}")),
                Some(v) if v.kind != VariableType::Real => Err(format!("{name} is no Real")),
                Some(v) if v.causality != causality => Err(format!("{name} is no {causality} but a {}", v.causality)),
                Some(v) => Ok(v.value_reference),
            });
            checked.filter_map(|found| found.map_err(|problem| problems.push(problem)).ok()).collect()
        };
        let (inputs, outputs) = (find(inputs, "input"), find(outputs, "output"));
        if !problems.is_empty() {
            return Err(instance.impossible(problems.join("; ")));
        }
        let work = instance.description().variable(WORK);
        let work = work.filter(|v| v.kind == VariableType::Real && v.causality == "output").map(|v| v.value_reference);
        let slot = instance.new_slot();
        let roll_back = instance.can_restore();
        let (orders, transform, another) = (vec![1; inputs.len()], None, None);
        Ok(Self { orders, inputs, outputs, work, slot, instance, transform, roll_back, another, recorded: Vec::new() })
    }

    /// Never saves or restores, whatever the FMU promises; `another` makes instances to be tried and thrown away in its
    /// place, if there may be more than one.
    #[must_use]
    pub fn without_roll_back(mut self, another: Option<Another>) -> Self {
        (self.roll_back, self.another) = (false, another);
        self
    }

    /// Lets inputs and outputs pass through lines, in the order of the connections.
    #[must_use]
    pub fn transformed(mut self, inputs: &[Linear], outputs: &[Linear]) -> Self {
        debug_assert_eq!((inputs.len(), outputs.len()), (self.inputs.len(), self.outputs.len()));
        self.transform = Transform::new(inputs, outputs);
        self
    }

    /// The instance, e.g. for its tally, its messages, or to set parameters.
    pub fn instance(&mut self) -> &mut FmuInstance {
        &mut self.instance
    }

    /// The message without the instance's name, which a [`Failure`] carries itself.
    #[cold]
    fn failure(&self, error: &FmuError) -> Failure {
        let subsystem = self.instance.name().to_string();
        let message = error.to_string();
        let message = message.strip_prefix(&format!("{subsystem}: ")).map_or(message.clone(), str::to_string);
        let ended = matches!(error, FmuError::Call { status: crate::Status::Ended, .. });
        Failure { subsystem, message, ended }
    }
}

impl Subsystem for FmuSubsystem {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        let values = self.transform.as_mut().map_or(values, |transform| transform.values(values));
        let set = self.instance.set_real(&self.inputs, values);
        let set = match rates {
            Some(rates) => set.and_then(|()| {
                let rates = self.transform.as_mut().map_or(rates, |transform| transform.rates(rates));
                self.instance.set_input_derivatives(&self.inputs, &self.orders, rates)
            }),
            None => set,
        };
        set.map_err(|e| self.failure(&e))
    }

    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        self.instance.get_real(&self.outputs, outputs).map_err(|e| self.failure(&e))?;
        self.transform.iter().for_each(|transform| transform.outputs(outputs));
        Ok(())
    }

    fn output_name(&self, index: usize) -> String {
        let reference = self.outputs[index];
        let is_it = |v: &&ScalarVariable| v.value_reference == reference && v.causality == "output";
        let variable = self.instance.description().variables.iter().find(is_it);
        variable.map_or_else(|| format!("#{reference}"), |v| v.name.clone())
    }

    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.instance.exit_initialization().map_err(|e| self.failure(&e))
    }

    fn step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), Failure> {
        self.instance.do_step(t, h, may_restore).map_err(|e| self.failure(&e))
    }

    fn save(&mut self) -> Result<(), Failure> {
        self.instance.save(&self.slot).map_err(|e| self.failure(&e))
    }

    fn restore(&mut self) -> Result<(), Failure> {
        self.instance.restore(&self.slot).map_err(|e| self.failure(&e))
    }

    fn work(&mut self) -> Result<Option<f64>, Failure> {
        let Some(reference) = self.work else { return Ok(None) };
        let mut work = [0.0];
        self.instance.get_real(&[reference], &mut work).map_err(|e| self.failure(&e))?;
        Ok(Some(work[0]))
    }

    fn can_interpolate(&self) -> bool {
        self.instance.can_interpolate()
    }

    fn can_roll_back(&self) -> bool {
        self.roll_back
    }

    fn trial_instance(&mut self, inputs: &[f64]) -> Result<Option<Box<dyn Subsystem>>, Failure> {
        let Some(another) = &self.another else { return Ok(None) };
        let mut trial_instance = another().map_err(|e| self.failure(&e))?;
        trial_instance.set_inputs(inputs, None)?;
        trial_instance.exit_initialization()?;
        Ok(Some(Box::new(trial_instance)))
    }

    fn can_derive(&self) -> bool {
        self.instance.can_derive()
    }

    fn derivative(&mut self, seed: &[f64], change: &mut [f64]) -> Result<(), Failure> {
        let seed = self.transform.as_mut().map_or(seed, |transform| transform.rates(seed));
        let derived = self.instance.directional_derivative(&self.outputs, &self.inputs, seed, change);
        derived.map_err(|e| self.failure(&e))?;
        self.transform.iter().for_each(|transform| transform.changes(change));
        Ok(())
    }

    fn record(&mut self, wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        let outputs = self.instance.description().with_causality("output").filter(|v| v.kind == VariableType::Real);
        let signal = |v: &ScalarVariable| {
            (v.value_reference, Signal { name: v.name.clone(), unit: v.unit.clone().unwrap_or_default() })
        };
        let (references, signals) = outputs.map(signal).filter(|(_, signal)| wanted(signal)).unzip();
        self.recorded = references;
        signals
    }

    /// They may be NaN.
    fn read(&mut self, row: &mut [f64]) -> Result<(), Failure> {
        self.instance.get_real(&self.recorded, row).map_err(|e| self.failure(&e))
    }

    fn name(&self) -> &str {
        self.instance.name()
    }

    fn seconds(&self) -> f64 {
        self.instance.tally().time.as_secs_f64()
    }
}
