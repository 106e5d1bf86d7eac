//! A model with the life cycle of an FMI 2.0 co-simulation slave: the FMU shell and the in-process run share it, so that
//! both take exactly the same path through the physics.

use crate::interface::{Causality, Kind, Values};
use crate::model::{Model, ModelError};

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

/// A saved instance: values, phase and, once built, the dynamic state.
pub struct Snapshot<M: Model> {
    values: Values,
    phase: Phase,
    start: f64,
    stale: bool,
    state: Option<M::State>,
}

impl<M: Model> Clone for Snapshot<M> {
    fn clone(&self) -> Self {
        Self {
            values: self.values.clone(),
            phase: self.phase,
            start: self.start,
            stale: self.stale,
            state: self.state.clone(),
        }
    }
}

/// One instance of a model.
pub struct Instance<M: Model> {
    model: M,
    values: Values,
    phase: Phase,
    start: f64,
    /// The parameters the model was last built with; `None` before the first build.
    built: Option<(f64, Vec<f64>)>,
    /// Inputs or parameters changed since the last equilibrium.
    stale: bool,
}

/// Steps shorter than this, relative to max(1, t), succeed and do nothing (some importers end on one).
const TINY_STEP: f64 = 1e-12;
const MAGIC: &[u8; 8] = b"ttbstat1";

impl<M: Model> Instance<M> {
    /// A fresh instance with start values.
    pub fn new(model: M) -> Self {
        let values = Values::start(model.interface());
        Self { model, values, phase: Phase::Instantiated, start: 0.0, built: None, stale: true }
    }
    /// The physics.
    pub fn model(&self) -> &M {
        &self.model
    }
    /// Where the instance is in its life.
    pub fn phase(&self) -> Phase {
        self.phase
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
        let allowed = match &variable.kind {
            Kind::Real { .. } => value.is_finite(),
            Kind::Boolean => value == 0.0 || value == 1.0,
            Kind::Integer { min, max } => (f64::from(*min)..=f64::from(*max)).contains(&value),
            Kind::Enumeration(items) => (1.0..=items.len() as f64).contains(&value),
        };
        if allowed { Ok(()) } else { Err(ModelError(format!("parameter {name} cannot be {value}"))) }
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

    fn build(&mut self) -> Result<(), ModelError> {
        let parameters = &self.values.all[self.model.interface().parameters()];
        if self.built.as_ref().is_none_or(|(start, built)| *start != self.start || built != parameters) {
            let parameters = parameters.to_vec();
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
        self.start = start;
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

    /// One macro step.
    ///
    /// # Errors
    /// A step that is negative or not finite, or that the model cannot do.
    pub fn step(&mut self, t: f64, h: f64) -> Result<(), ModelError> {
        if !t.is_finite() || !h.is_finite() || h < 0.0 {
            return Err(ModelError(format!("a step of {h} s from t = {t} s is impossible")));
        }
        if h >= TINY_STEP * t.abs().max(1.0) {
            self.model.step(&mut self.values, t, h)?;
        }
        // Derivatives were for this step only.
        self.values.had_rates = std::mem::take(&mut self.values.has_rates);
        Ok(())
    }

    /// Back to the state after instantiation; the parameters return to their start values.
    pub fn reset(&mut self) {
        self.values = Values::start(self.model.interface());
        self.phase = Phase::Instantiated;
        self.start = 0.0;
        self.stale = true;
        // Built data are kept: the next build compares parameters and does nothing when they are the same.
    }

    /// Saves the instance.
    pub fn save(&self) -> Snapshot<M> {
        let state = self.built.is_some().then(|| self.model.save());
        Snapshot { values: self.values.clone(), phase: self.phase, start: self.start, stale: self.stale, state }
    }

    /// Saves into an existing snapshot without allocating.
    pub fn save_into(&self, snapshot: &mut Snapshot<M>) {
        snapshot.values.all.clone_from(&self.values.all);
        snapshot.values.rates.clone_from(&self.values.rates);
        (snapshot.values.has_rates, snapshot.values.had_rates) = (self.values.has_rates, self.values.had_rates);
        (snapshot.phase, snapshot.start, snapshot.stale) = (self.phase, self.start, self.stale);
        snapshot.state = self.built.is_some().then(|| self.model.save());
    }

    /// Restores a snapshot of this or of another instance of the same model.
    ///
    /// # Errors
    /// The snapshot carries parameters the model cannot be built with.
    pub fn restore(&mut self, snapshot: &Snapshot<M>) -> Result<(), ModelError> {
        self.values.all.clone_from(&snapshot.values.all);
        self.values.rates.clone_from(&snapshot.values.rates);
        (self.values.has_rates, self.values.had_rates) = (snapshot.values.has_rates, snapshot.values.had_rates);
        (self.phase, self.start, self.stale) = (snapshot.phase, snapshot.start, snapshot.stale);
        if let Some(state) = &snapshot.state {
            self.build()?;
            self.model.restore(state);
        }
        Ok(())
    }

    /// A snapshot as bytes: magic with version, phase, values, then the model's state.
    pub fn to_bytes(&self, snapshot: &Snapshot<M>) -> Vec<u8> {
        let values = &snapshot.values;
        let mut bytes = MAGIC.to_vec();
        let flags = [values.has_rates, values.had_rates, snapshot.stale, snapshot.state.is_some()];
        bytes.push(snapshot.phase as u8);
        bytes.extend(flags.map(u8::from));
        for x in std::iter::once(&snapshot.start).chain(&values.all).chain(&values.rates) {
            bytes.extend(x.to_le_bytes());
        }
        if let Some(state) = &snapshot.state {
            self.model.write_state(state, &mut bytes);
        }
        bytes
    }

    /// The snapshot that [`Instance::to_bytes`] wrote.
    ///
    /// # Errors
    /// Bytes of another version or another model.
    pub fn from_bytes(&mut self, bytes: &[u8]) -> Result<Snapshot<M>, ModelError> {
        let wrong = |what: &str| ModelError(format!("the serialized FMU state cannot be read: {what}"));
        let mut values = Values::start(self.model.interface());
        let numbers = 1 + values.all.len() + values.rates.len();
        let head = MAGIC.len() + 5;
        if bytes.get(..MAGIC.len()) != Some(MAGIC) {
            return Err(wrong("it does not begin with this program's mark and version"));
        }
        if bytes.len() < head + 8 * numbers {
            return Err(wrong("it is too short for this model"));
        }
        let (flags, rest) = bytes[MAGIC.len()..].split_at(5);
        let (real, state) = rest.split_at(8 * numbers);
        let mut real =
            real.chunks_exact(8).map(|b| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]));
        let mut next = || real.next().unwrap_or(f64::NAN);
        let start = next();
        values.all.iter_mut().for_each(|x| *x = next());
        values.rates.iter_mut().for_each(|x| *x = next());
        (values.has_rates, values.had_rates) = (flags[1] != 0, flags[2] != 0);
        let phase = match flags[0] {
            0 => Phase::Instantiated,
            1 => Phase::Initialization,
            _ => Phase::Stepping,
        };
        let state = if flags[4] == 0 {
            None
        } else {
            // The model's layout depends on its parameters: build with those of the snapshot before reading.
            let now = std::mem::replace(&mut self.values, values.clone());
            let start_now = std::mem::replace(&mut self.start, start);
            let read = self.build().and_then(|()| self.model.read_state(state));
            (self.values, self.start) = (now, start_now);
            let rebuilt = self.built.is_some() && self.phase != Phase::Instantiated;
            if rebuilt {
                self.build()?;
            }
            Some(read?)
        };
        Ok(Snapshot { values, phase, start, stale: flags[3] != 0, state })
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
