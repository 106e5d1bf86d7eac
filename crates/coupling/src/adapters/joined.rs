//! Several bridges along one track as one subsystem: each has its own range of the ports.

use std::ops::Range;

use ttb_contract::{Failure, Ports, Signal, Subsystem};

/// Bridges in track order. Forces of all come one after the other; so do positions, then rates.
pub struct Joined<S> {
    parts: Vec<Part<S>>,
    /// The ports of all.
    ports: Ports,
    /// Names of all, joined by a plus.
    name: String,
}

/// A bridge and its ports.
struct Part<S> {
    bridge: S,
    ports: Ports,
    /// Where they stand among those of all.
    range: Range<usize>,
    motion: Vec<f64>,
    /// Outputs that are recorded.
    recorded: usize,
}

impl<S: Subsystem> Joined<S> {
    /// Of bridges with their ports. Of several every port must have position and rate; `None` if one has not.
    pub fn new(bridges: Vec<(S, Ports)>) -> Option<Self> {
        let ports = match &bridges[..] {
            [(_, ports)] => ports.clone(),
            several if several.iter().all(|(_, ports)| ports.complete()) => {
                Ports::new(several.iter().flat_map(|(_, ports)| ports.list().to_vec()).collect(), 0)?
            }
            _ => return None,
        };
        let mut from = 0;
        let part = |(bridge, ports): (S, Ports)| {
            let range = from..from + ports.forces();
            from = range.end;
            Part { bridge, range, motion: vec![0.0; ports.motions()], ports, recorded: 0 }
        };
        let parts: Vec<Part<S>> = bridges.into_iter().map(part).collect();
        let names: Vec<&str> = parts.iter().map(|part| part.bridge.name()).collect();
        Some(Self { name: names.join(" + "), parts, ports })
    }

    /// The ports of all.
    pub fn ports(&self) -> &Ports {
        &self.ports
    }

    /// The bridges.
    pub fn parts(&mut self) -> impl Iterator<Item = &mut S> {
        self.parts.iter_mut().map(|part| &mut part.bridge)
    }

    /// The ports of each, by position.
    pub fn ranges(&self) -> Vec<Range<usize>> {
        self.parts.iter().map(|part| part.range.clone()).collect()
    }

    /// Hands what each part wrote to its place among the others.
    fn scatter(&self, motion: &mut [f64]) {
        let all = self.ports.parts_mut(motion);
        for part in &self.parts {
            let own = part.ports.parts(&part.motion);
            all.positions[part.range.clone()].copy_from_slice(own.positions);
            all.rates[part.range.clone()].copy_from_slice(own.rates);
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
            let own = part.range.clone();
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
        let [part] = &self.parts[..] else {
            let n = self.ports.forces().max(1);
            let (block, port) = (index / n, index % n);
            let part = self.parts.iter().find(|part| part.range.contains(&port));
            let own = |part: &Part<S>| block * part.range.len() + port - part.range.start;
            return part.map_or_else(String::new, |part| part.bridge.output_name(own(part)));
        };
        part.bridge.output_name(index)
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
            let Some(other) = part.bridge.trial_instance(&inputs[part.range.clone()])? else { return Ok(None) };
            others.push((other, part.ports.clone()));
        }
        Ok(Joined::new(others).map(|joined| Box::new(joined) as Box<dyn Subsystem>))
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
            .try_for_each(|part| part.bridge.derivative(&seed[part.range.clone()], &mut part.motion))?;
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
