//! A bridge that gives less than the iteration wants: no velocities, or motions at other places than the supports.
//!
//! Velocities that it does not give follow from its displacements as in the trapezoidal rule,
//!
//! ```text
//! ḋ_{n+1} = 2 (d_{n+1} − d_n)/h − ḋ_n,      ḋ_0 = 0
//! ```
//!
//! which is what a bridge that integrates by this rule (Newmark's, γ = 1/2, β = 1/4) has; it is of second order for any
//! other. They belong to the state: saved, restored, differentiated with it. Then comes the way from its stations to the
//! supports ([`Stations`]). Where neither is needed everything passes as it is.

use crate::stations::Stations;
use ttb_contract::{Failure, Signal, Subsystem};

/// A subsystem, its stations, its missing velocities.
pub struct Adapted<S> {
    inner: S,
    stations: Option<Stations>,
    differences: Option<Differences>,
    /// Forces and rates at the stations; (d, ḋ) there.
    forces: Vec<f64>,
    rates: Vec<f64>,
    motion: Vec<f64>,
}

/// Velocities from displacements.
#[derive(Clone)]
struct Differences {
    /// (d, ḋ) now, and as saved.
    now: Vec<f64>,
    saved: Vec<f64>,
    /// Displacements at the end of a step.
    end: Vec<f64>,
    /// The last step, s.
    h: f64,
    stepping: bool,
}

impl<S: Subsystem> Adapted<S> {
    /// As it is.
    pub fn plain(inner: S) -> Self {
        let none = Vec::new;
        Self { inner, stations: None, differences: None, forces: none(), rates: none(), motion: none() }
    }

    /// With `points` places of its own; `stations` leads from them to the supports, else they are the supports. Without
    /// `velocities` its outputs are displacements only; `h` is the size of the steps to come, s.
    pub fn new(inner: S, points: usize, stations: Option<Stations>, velocities: bool, h: f64) -> Self {
        let zero = || vec![0.0; points];
        let pair = || vec![0.0; 2 * points];
        let differences = Differences { now: pair(), saved: pair(), end: zero(), h, stepping: false };
        let differences = (!velocities).then_some(differences);
        Self { inner, stations, differences, forces: zero(), rates: zero(), motion: pair() }
    }

    /// The subsystem itself.
    pub fn inner(&mut self) -> &mut S {
        &mut self.inner
    }

    /// (d, ḋ) at its own places.
    fn own_motion(&mut self, plain: &mut [f64]) -> Result<(), Failure> {
        match &self.differences {
            Some(differences) if differences.stepping => plain.copy_from_slice(&differences.now),
            Some(_) => {
                let (d, v) = plain.split_at_mut(plain.len() / 2);
                self.inner.get_outputs(d)?;
                v.fill(0.0);
            }
            None => self.inner.get_outputs(plain)?,
        }
        Ok(())
    }

    /// From its own places to the supports.
    fn to_supports(stations: &Stations, own: &[f64], ours: &mut [f64]) {
        let (d, v) = own.split_at(own.len() / 2);
        let (our_d, our_v) = ours.split_at_mut(ours.len() / 2);
        stations.motion(d, our_d);
        stations.motion(v, our_v);
    }
}

impl Differences {
    /// After a step of `h` to the displacements `self.end`.
    fn step(&mut self, h: f64) {
        let (d, v) = self.now.split_at_mut(self.end.len());
        for ((d, v), end) in d.iter_mut().zip(v).zip(&self.end) {
            (*v, *d) = (2.0 / h * (end - *d) - *v, *end);
        }
        self.h = h;
    }
}

impl<S: Subsystem> Subsystem for Adapted<S> {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        let Some(stations) = &self.stations else { return self.inner.set_inputs(values, rates) };
        stations.force(values, &mut self.forces);
        let rates = rates.map(|rates| {
            stations.force(rates, &mut self.rates);
            &self.rates[..]
        });
        self.inner.set_inputs(&self.forces, rates)
    }

    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        if self.stations.is_none() {
            return self.own_motion(outputs);
        }
        let mut motion = std::mem::take(&mut self.motion);
        let got = self.own_motion(&mut motion);
        self.motion = motion;
        if let Some(stations) = &self.stations {
            Self::to_supports(stations, &self.motion, outputs);
        }
        got
    }

    fn output_name(&self, index: usize) -> String {
        let half = self.motion.len() / 2;
        match &self.stations {
            None => self.inner.output_name(if self.differences.is_some() { index % half } else { index }),
            Some(stations) => format!("motion of the deck at support {}", index % stations.supports() + 1),
        }
    }

    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.inner.exit_initialization()?;
        if let Some(differences) = &mut self.differences {
            let points = differences.end.len();
            self.inner.get_outputs(&mut differences.now[..points])?;
            differences.now[points..].fill(0.0);
            differences.stepping = true;
        }
        Ok(())
    }

    fn step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), Failure> {
        self.inner.step(t, h, may_restore)?;
        if let Some(differences) = &mut self.differences {
            self.inner.get_outputs(&mut differences.end)?;
            differences.step(h);
        }
        Ok(())
    }

    fn save(&mut self) -> Result<(), Failure> {
        if let Some(differences) = &mut self.differences {
            differences.saved.copy_from_slice(&differences.now);
        }
        self.inner.save()
    }

    fn restore(&mut self) -> Result<(), Failure> {
        if let Some(differences) = &mut self.differences {
            differences.now.copy_from_slice(&differences.saved);
        }
        self.inner.restore()
    }

    fn can_interpolate(&self) -> bool {
        self.inner.can_interpolate()
    }

    fn can_roll_back(&self) -> bool {
        self.inner.can_roll_back()
    }

    fn trial_instance(&mut self, inputs: &[f64]) -> Result<Option<Box<dyn Subsystem>>, Failure> {
        let own = match &self.stations {
            None => inputs,
            Some(stations) => {
                stations.force(inputs, &mut self.forces);
                &self.forces
            }
        };
        let Some(inner) = self.inner.trial_instance(own)? else { return Ok(None) };
        let mut adapted = Adapted {
            inner,
            stations: self.stations.clone(),
            differences: self.differences.clone(),
            forces: self.forces.clone(),
            rates: self.rates.clone(),
            motion: self.motion.clone(),
        };
        if let Some(differences) = &mut adapted.differences {
            let points = differences.end.len();
            adapted.inner.get_outputs(&mut differences.now[..points])?;
            differences.now[points..].fill(0.0);
        }
        Ok(Some(Box::new(adapted)))
    }

    fn can_derive(&self) -> bool {
        self.inner.can_derive()
    }

    fn derivative(&mut self, seed: &[f64], change: &mut [f64]) -> Result<(), Failure> {
        let seed = match &self.stations {
            None => seed,
            Some(stations) => {
                stations.force(seed, &mut self.forces);
                &self.forces
            }
        };
        let own = if self.stations.is_some() { &mut self.motion[..] } else { &mut *change };
        match &self.differences {
            None => self.inner.derivative(seed, own)?,
            Some(differences) => {
                let (d, v) = own.split_at_mut(differences.end.len());
                self.inner.derivative(seed, d)?;
                d.iter().zip(v).for_each(|(d, v)| *v = 2.0 / differences.h * d);
            }
        }
        if let Some(stations) = &self.stations {
            Self::to_supports(stations, &self.motion, change);
        }
        Ok(())
    }

    fn record(&mut self, wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        self.inner.record(wanted)
    }
    fn read(&mut self, row: &mut [f64]) -> Result<(), Failure> {
        self.inner.read(row)
    }
    fn name(&self) -> &str {
        self.inner.name()
    }
    fn seconds(&self) -> f64 {
        self.inner.seconds()
    }
}
