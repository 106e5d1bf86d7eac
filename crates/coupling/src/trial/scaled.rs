//! Ports of different units, brought to the unit of the first one on the way in and out of a subsystem:
//!
//! ```text
//! f̂ = w f,  q̂ = q/w        w_i = s_1/s_i       (ttb_contract::Ports)
//! ```
//!
//! The iteration then sees forces of one unit, and every norm, least-squares model and trial load makes sense as it is.

use std::sync::Arc;

use ttb_contract::{Failure, Ports, Subsystem};

/// By what a subsystem's inputs and outputs are multiplied, and room for what is sent.
pub(crate) struct Factors {
    inputs: Arc<[f64]>,
    outputs: Arc<[f64]>,
    values: Vec<f64>,
    rates: Vec<f64>,
}

impl Factors {
    fn new(inputs: Arc<[f64]>, outputs: Arc<[f64]>) -> Self {
        let room = || vec![0.0; inputs.len()];
        Self { values: room(), rates: room(), inputs, outputs }
    }

    /// Of the train–track side and of the bridge; `None` if all ports have one unit.
    pub fn of(ports: &Ports) -> Option<[Self; 2]> {
        let w = ports.weights()?;
        let inverse: Vec<f64> = w.iter().map(|w| w.recip()).collect();
        // Positions, rates and others of the motions, each in the order of the ports.
        let motion = |of_port: &[f64]| -> Arc<[f64]> {
            let mut all = vec![1.0; ports.motions()];
            let parts = ports.parts_mut(&mut all);
            for part in [parts.positions, parts.rates] {
                part.iter_mut().zip(of_port).for_each(|(factor, of_port)| *factor = *of_port);
            }
            all.into()
        };
        let train_track = Self::new(motion(&w), w.clone().into());
        let bridge = Self::new(inverse.clone().into(), motion(&inverse));
        Some([train_track, bridge])
    }
}

/// A subsystem behind its factors.
pub(crate) struct Scaled<S> {
    inner: S,
    factors: Factors,
}

impl<S: Subsystem> Scaled<S> {
    pub fn new(inner: S, factors: Factors) -> Self {
        Self { inner, factors }
    }

    /// The factors, to be used again.
    pub fn into_factors(self) -> Factors {
        self.factors
    }

    fn out(&self, outputs: &mut [f64]) {
        outputs.iter_mut().zip(&self.factors.outputs[..]).for_each(|(x, factor)| *x *= factor);
    }
}

fn times(to: &mut [f64], factors: &[f64], from: &[f64]) {
    to.iter_mut().zip(factors).zip(from).for_each(|((to, factor), from)| *to = factor * from);
}

impl<S: Subsystem> Subsystem for Scaled<S> {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        let own = &mut self.factors;
        times(&mut own.values, &own.inputs, values);
        let rates = rates.map(|rates| {
            times(&mut own.rates, &own.inputs, rates);
            &own.rates[..]
        });
        self.inner.set_inputs(&own.values, rates)
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        self.inner.get_outputs(outputs)?;
        self.out(outputs);
        Ok(())
    }
    fn derivative(&mut self, seed: &[f64], change: &mut [f64]) -> Result<(), Failure> {
        times(&mut self.factors.values, &self.factors.inputs, seed);
        self.inner.derivative(&self.factors.values, change)?;
        self.out(change);
        Ok(())
    }
    fn trial_instance(&mut self, inputs: &[f64]) -> Result<Option<Box<dyn Subsystem>>, Failure> {
        let own = &mut self.factors;
        times(&mut own.values, &own.inputs, inputs);
        let Some(inner) = self.inner.trial_instance(&own.values)? else { return Ok(None) };
        let factors = Factors::new(Arc::clone(&own.inputs), Arc::clone(&own.outputs));
        Ok(Some(Box::new(Scaled { inner, factors })))
    }
    fn output_name(&self, index: usize) -> String {
        self.inner.output_name(index)
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.inner.exit_initialization()
    }
    fn step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), Failure> {
        self.inner.step(t, h, may_restore)
    }
    fn save(&mut self) -> Result<(), Failure> {
        self.inner.save()
    }
    fn restore(&mut self) -> Result<(), Failure> {
        self.inner.restore()
    }
    fn work(&mut self) -> Result<Option<f64>, Failure> {
        self.inner.work()
    }
    fn can_interpolate(&self) -> bool {
        self.inner.can_interpolate()
    }
    fn can_roll_back(&self) -> bool {
        self.inner.can_roll_back()
    }
    fn can_derive(&self) -> bool {
        self.inner.can_derive()
    }
    fn name(&self) -> &str {
        self.inner.name()
    }
}
