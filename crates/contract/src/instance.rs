//! A model with the life cycle of an FMI 2.0 co-simulation slave: the FMU shell and the in-process run share it, so that
//! both take exactly the same path through the physics.

use crate::finite::not_finite;
use crate::instant;
use crate::interface::Causality;
use crate::model::{Model, ModelError};
use crate::values::Values;

/// Life cycle of an instance (FMI 2.0, section 4.2.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Parameters may be set.
    Instantiated,
    /// Inputs and parameters may be set; outputs answer with static equilibrium.
    Initialization,
    /// Steps are taken.
    Stepping,
}

/// One instance of a model.
pub struct Instance<M: Model> {
    pub(crate) model: M,
    pub(crate) values: Values,
    pub(crate) phase: Phase,
    pub(crate) start: f64,
    /// End of the last step, or the start time, s.
    pub(crate) time: f64,
    /// The parameters the model was last built with; `None` before the first build.
    pub(crate) built: Option<(f64, Vec<f64>)>,
    /// Inputs or parameters changed since the last equilibrium.
    pub(crate) stale: bool,
}

impl<M: Model> Instance<M> {
    /// A fresh instance with start values.
    pub fn new(model: M) -> Self {
        let values = Values::start(model.interface());
        Self { model, values, phase: Phase::Instantiated, start: 0.0, time: 0.0, built: None, stale: true }
    }
    /// The physics.
    pub fn model(&self) -> &M {
        &self.model
    }
    /// The model, for what changes none of its answers, such as work done ahead.
    pub fn model_mut(&mut self) -> &mut M {
        &mut self.model
    }
    /// Where the instance is in its life.
    pub fn phase(&self) -> Phase {
        self.phase
    }
    /// End of the last step, before the first one the start time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Sets variables by value reference; parameters only before the first step.
    ///
    /// # Errors
    /// Unknown reference, an output, a parameter too late, a value outside its kind or not finite.
    pub fn set(&mut self, references: &[u32], values: &[f64]) -> Result<(), ModelError> {
        let inputs = self.model.interface().inputs().len();
        for (&reference, &value) in references.iter().zip(values) {
            let reference = reference as usize;
            if reference >= inputs {
                self.check_parameter(reference, value)?;
            } else if !value.is_finite() {
                let name = &self.model.interface().variables()[reference].name;
                return Err(ModelError(format!("input {name} was set to {value}; it must be finite")));
            }
            self.values.all[reference] = value;
        }
        self.stale = true;
        Ok(())
    }

    fn check_parameter(&self, reference: usize, value: f64) -> Result<(), ModelError> {
        let Some(variable) = self.model.interface().variables().get(reference) else {
            return Err(ModelError(format!("value reference {reference} does not exist")));
        };
        let name = &variable.name;
        if variable.causality == Causality::Output {
            return Err(ModelError(format!("{name} is an output and cannot be set")));
        }
        if self.phase == Phase::Stepping {
            return Err(ModelError(format!("parameter {name} can only be set before the end of initialization")));
        }
        if variable.kind.allows(value) {
            Ok(())
        } else {
            Err(ModelError(format!("parameter {name} cannot be {value}")))
        }
    }

    /// Sets first time derivatives of inputs for the coming step.
    ///
    /// # Errors
    /// A reference that is no input, a value that is not finite.
    pub fn set_rates(&mut self, references: &[u32], rates: &[f64]) -> Result<(), ModelError> {
        if !self.values.has_rates {
            self.values.rates.fill(0.0);
        }
        for (&reference, &rate) in references.iter().zip(rates) {
            let Some(slot) = self.values.rates.get_mut(reference as usize) else {
                return Err(ModelError(format!(
                    "value reference {reference} is no input: it has no derivative to set"
                )));
            };
            if !rate.is_finite() {
                return Err(ModelError(format!("the derivative of input {reference} was set to {rate}")));
            }
            *slot = rate;
        }
        self.values.has_rates = true;
        Ok(())
    }

    /// Reads variables by value reference; in initialization mode outputs are brought to static equilibrium first.
    ///
    /// # Errors
    /// Unknown reference, or the equilibrium fails.
    pub fn get(&mut self, references: &[u32], out: &mut [f64]) -> Result<(), ModelError> {
        if self.phase == Phase::Initialization {
            self.refresh()?;
        }
        for (&reference, out) in references.iter().zip(out) {
            let Some(value) = self.values.all.get(reference as usize) else {
                return Err(ModelError(format!("value reference {reference} does not exist")));
            };
            *out = *value;
        }
        Ok(())
    }

    /// Whether the model was last built for these parameters and this start.
    pub(crate) fn is_built_for(&self, values: &Values, start: f64) -> bool {
        let parameters = &values.all[self.model.interface().parameters()];
        self.built.as_ref().is_some_and(|(of, built)| *of == start && built == parameters)
    }

    pub(crate) fn build(&mut self) -> Result<(), ModelError> {
        if !self.is_built_for(&self.values, self.start) {
            let parameters = self.values.all[self.model.interface().parameters()].to_vec();
            // A build that fails leaves a half-built model behind: the next one must not take it for whole.
            self.built = None;
            self.model.build(&self.values, self.start)?;
            self.built = Some((self.start, parameters));
        }
        Ok(())
    }

    fn refresh(&mut self) -> Result<(), ModelError> {
        if self.stale {
            self.build()?;
            self.model.equilibrium(&mut self.values)?;
            self.stale = false;
        }
        Ok(())
    }

    /// Enters initialization at `start` (s).
    ///
    /// # Errors
    /// An impossible parameter.
    pub fn enter_initialization(&mut self, start: f64) -> Result<(), ModelError> {
        (self.start, self.time) = (start, start);
        self.build()?;
        self.phase = Phase::Initialization;
        self.stale = true;
        Ok(())
    }

    /// Leaves initialization.
    ///
    /// # Errors
    /// The start state cannot be found.
    pub fn exit_initialization(&mut self) -> Result<(), ModelError> {
        self.refresh()?;
        self.model.start(&mut self.values)?;
        self.phase = Phase::Stepping;
        Ok(())
    }

    /// Whether a step from t to t + h (s) can be asked for at all; nothing changes.
    ///
    /// # Errors
    /// It is negative or not finite, or begins at another time than the end of the last step.
    pub fn check_step(&self, t: f64, h: f64) -> Result<(), ModelError> {
        if !t.is_finite() || !h.is_finite() || h < 0.0 {
            return Err(ModelError(format!("a step of {h} s from t = {t} s is impossible")));
        }
        if !instant::follows(self.time, t, h) {
            return Err(ModelError(format!(
                "a step from t = {t} s is impossible: the simulation has reached {} s; a step begins where the last one has \
                 ended, or at the start time, or at the time of a restored state",
                self.time
            )));
        }
        Ok(())
    }

    /// One macro step from t, the end of the last one, to t + h (s).
    ///
    /// # Errors
    /// A step that [`Instance::check_step`] refuses, that the model cannot do, or that leads to an output that is no finite
    /// number.
    pub fn step(&mut self, t: f64, h: f64) -> Result<(), ModelError> {
        self.check_step(t, h)?;
        if !instant::is_nothing(t, h) {
            self.model.step(&mut self.values, t, h)?;
            self.check_outputs(t + h)?;
        }
        self.time = t + h;
        // Derivatives were for this step only.
        self.values.had_rates = std::mem::take(&mut self.values.has_rates);
        Ok(())
    }

    /// No output is NaN or infinite.
    fn check_outputs(&self, t: f64) -> Result<(), ModelError> {
        let outputs = self.model.interface().outputs();
        let Some(at) = not_finite(&self.values.all[outputs.clone()]) else { return Ok(()) };
        let reference = outputs.start + at;
        let (name, value) = (&self.model.interface().variables()[reference].name, self.values.all[reference]);
        Err(ModelError(format!("output {name} is {value} at t = {t} s")))
    }

    /// Back to the state after instantiation; the parameters return to their start values.
    pub fn reset(&mut self) {
        self.values = Values::start(self.model.interface());
        self.phase = Phase::Instantiated;
        (self.start, self.time) = (0.0, 0.0);
        self.stale = true;
        // Built data are kept: the next build compares parameters and does nothing when they are the same.
    }

    /// Derivative of outputs with respect to inputs over a step of the size in use, along `seed`.
    ///
    /// # Errors
    /// A reference of the wrong kind, or a model without derivatives.
    pub fn directional_derivative(
        &mut self,
        unknown: &[u32],
        known: &[u32],
        seed: &[f64],
        out: &mut [f64],
    ) -> Result<(), ModelError> {
        let (inputs, outputs) = (self.model.interface().inputs(), self.model.interface().outputs());
        if let Some(bad) = known.iter().find(|r| !inputs.contains(&(**r as usize))) {
            return Err(ModelError(format!("value reference {bad} is no input")));
        }
        if let Some(bad) = unknown.iter().find(|r| !outputs.contains(&(**r as usize))) {
            return Err(ModelError(format!("value reference {bad} is no output")));
        }
        self.build()?;
        let mut full = vec![0.0; inputs.len()];
        known.iter().zip(seed).for_each(|(&r, &s)| full[r as usize] = s);
        let mut all = vec![0.0; outputs.len()];
        let interpolated = self.values.has_rates || self.values.had_rates;
        self.model.directional_derivative(interpolated, &full, &mut all)?;
        unknown.iter().zip(out).for_each(|(&r, o)| *o = all[r as usize - outputs.start]);
        Ok(())
    }
}
