//! Several bridges along one track as one subsystem: each has its own range of the supports.

use std::ops::Range;

use ttb_contract::{Failure, Signal, Subsystem};

/// Bridges in track order. Forces of all come one after the other; so do displacements, then velocities.
pub struct Joined<S> {
    parts: Vec<Part<S>>,
    supports: usize,
    /// Names of all, joined by a plus.
    name: String,
}

/// A bridge and its supports.
struct Part<S> {
    bridge: S,
    supports: Range<usize>,
    /// (d, ḋ) of its supports.
    motion: Vec<f64>,
    /// Outputs that are recorded.
    recorded: usize,
}

impl<S: Subsystem> Joined<S> {
    /// Of bridges with so many supports each.
    pub fn new(bridges: Vec<(S, usize)>) -> Self {
        let mut supports = 0;
        let part = |(bridge, count): (S, usize)| {
            let from = supports;
            supports += count;
            Part { bridge, supports: from..supports, motion: vec![0.0; 2 * count], recorded: 0 }
        };
        let parts: Vec<Part<S>> = bridges.into_iter().map(part).collect();
        let names: Vec<&str> = parts.iter().map(|part| part.bridge.name()).collect();
        Self { name: names.join(" + "), parts, supports }
    }

    /// The bridges.
    pub fn parts(&mut self) -> impl Iterator<Item = &mut S> {
        self.parts.iter_mut().map(|part| &mut part.bridge)
    }

    /// The supports of each.
    pub fn ranges(&self) -> Vec<Range<usize>> {
        self.parts.iter().map(|part| part.supports.clone()).collect()
    }

    /// Hands what each part wrote to its place among the others.
    fn scatter(&self, motion: &mut [f64]) {
        for part in &self.parts {
            let count = part.supports.len();
            let (d, v) = part.motion.split_at(count);
            motion[part.supports.clone()].copy_from_slice(d);
            motion[self.supports..][part.supports.clone()].copy_from_slice(v);
        }
    }

    fn each(&mut self, mut call: impl FnMut(&mut S) -> Result<(), Failure>) -> Result<(), Failure> {
        self.parts.iter_mut().try_for_each(|part| call(&mut part.bridge))
    }

    fn all(&self, is: impl Fn(&S) -> bool) -> bool {
        self.parts.iter().all(|part| is(&part.bridge))
    }
}

impl<S: Subsystem> Subsystem for Joined<S> {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        self.parts.iter_mut().try_for_each(|part| {
            let own = part.supports.clone();
            part.bridge.set_inputs(&values[own.clone()], rates.map(|rates| &rates[own]))
        })
    }

    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        if let [part] = &mut self.parts[..] {
            return part.bridge.get_outputs(outputs);
        }
        self.parts.iter_mut().try_for_each(|part| part.bridge.get_outputs(&mut part.motion))?;
        self.scatter(outputs);
        Ok(())
    }

    fn output_name(&self, index: usize) -> String {
        let support = index % self.supports.max(1);
        let Some(part) = self.parts.iter().find(|part| part.supports.contains(&support)) else { return String::new() };
        let own = support - part.supports.start;
        part.bridge.output_name(if index < self.supports { own } else { part.supports.len() + own })
    }

    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.each(S::exit_initialization)
    }
    fn step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), Failure> {
        self.each(|bridge| bridge.step(t, h, may_restore))
    }
    fn save(&mut self) -> Result<(), Failure> {
        self.each(S::save)
    }
    fn restore(&mut self) -> Result<(), Failure> {
        self.each(S::restore)
    }
    fn can_interpolate(&self) -> bool {
        self.all(S::can_interpolate)
    }
    fn can_roll_back(&self) -> bool {
        self.all(S::can_roll_back)
    }

    fn trial_instance(&mut self, inputs: &[f64]) -> Result<Option<Box<dyn Subsystem>>, Failure> {
        let mut others = Vec::new();
        for part in &mut self.parts {
            let Some(other) = part.bridge.trial_instance(&inputs[part.supports.clone()])? else { return Ok(None) };
            others.push((other, part.supports.len()));
        }
        Ok(Some(Box::new(Joined::new(others))))
    }

    fn can_derive(&self) -> bool {
        self.all(S::can_derive)
    }

    fn derivative(&mut self, seed: &[f64], change: &mut [f64]) -> Result<(), Failure> {
        if let [part] = &mut self.parts[..] {
            return part.bridge.derivative(seed, change);
        }
        self.parts
            .iter_mut()
            .try_for_each(|part| part.bridge.derivative(&seed[part.supports.clone()], &mut part.motion))?;
        self.scatter(change);
        Ok(())
    }

    /// Of several bridges every name begins with that of the bridge.
    fn record(&mut self, wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        let several = self.parts.len() > 1;
        let mut all = Vec::new();
        for part in &mut self.parts {
            let mut own = part.bridge.record(wanted);
            part.recorded = own.len();
            let name = part.bridge.name();
            own.iter_mut().filter(|_| several).for_each(|signal| signal.name = format!("{name}.{}", signal.name));
            all.extend(own);
        }
        all
    }
    fn read(&mut self, row: &mut [f64]) -> Result<(), Failure> {
        let mut rest = row;
        for part in &mut self.parts {
            let (own, others) = rest.split_at_mut(part.recorded);
            part.bridge.read(own)?;
            rest = others;
        }
        Ok(())
    }
    fn name(&self) -> &str {
        &self.name
    }
    fn seconds(&self) -> f64 {
        self.parts.iter().map(|part| part.bridge.seconds()).sum()
    }
}
