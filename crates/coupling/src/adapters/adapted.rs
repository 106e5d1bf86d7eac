//! A bridge that gives less than the iteration wants: no velocities ([`super::velocities`]), or motions at other places than
//! the supports ([`Stations`]). Where neither is lacking everything passes as it is.
//!
//! Vectors are sequences of blocks: one a component for the forces; one a component for the positions, then one a component
//! for the rates. A block has one number a station on the bridge's side, one a support on ours.

use ttb_contract::{Failure, Signal, Subsystem};

use crate::adapters::stations::Stations;
use crate::adapters::velocities::Velocities;
use crate::adapters::watch::Watch;

/// A subsystem, its stations, its missing velocities.
pub struct Adapted<S> {
    inner: S,
    stations: Option<Stations>,
    velocities: Option<Velocities>,
    /// Forces, their rates and the motion at its own places.
    forces: Vec<f64>,
    rates: Vec<f64>,
    motion: Vec<f64>,
    /// Places of interest, and how many outputs of its own are recorded before theirs.
    watch: Option<Watch>,
    recorded: usize,
}

/// How a subsystem is adapted.
pub struct Lacks {
    /// Places of its own, along the track.
    pub points: usize,
    /// Components of force and motion at each.
    pub components: usize,
    /// From its places to the supports; `None`: they are the supports.
    pub stations: Option<Stations>,
    /// Whether its outputs are positions only.
    pub velocities: bool,
}

impl<S: Subsystem> Adapted<S> {
    /// As it is.
    pub fn plain(inner: S) -> Self {
        let none = Vec::new;
        let (forces, rates, motion) = (none(), none(), none());
        Self { inner, stations: None, velocities: None, forces, rates, motion, watch: None, recorded: 0 }
    }

    /// With what it lacks made up for; `h` is the size of the steps to come, s.
    pub fn new(inner: S, lacks: Lacks, h: f64) -> Self {
        let n = lacks.points * lacks.components;
        let velocities = lacks.velocities.then(|| Velocities::new(n, h));
        let (forces, rates, motion) = (vec![0.0; n], vec![0.0; n], vec![0.0; 2 * n]);
        Self { inner, stations: lacks.stations, velocities, forces, rates, motion, watch: None, recorded: 0 }
    }

    /// Records also the motion at places of interest.
    #[must_use]
    pub fn watched(self, watch: Watch) -> Self {
        Self { watch: Some(watch), ..self }
    }

    /// The subsystem itself.
    pub fn inner(&mut self) -> &mut S {
        &mut self.inner
    }

    /// The motion at its own places.
    fn own_motion(inner: &mut S, velocities: Option<&Velocities>, motion: &mut [f64]) -> Result<(), Failure> {
        let Some(velocities) = velocities else { return inner.get_outputs(motion) };
        let (d, v) = motion.split_at_mut(velocities.end.len());
        match velocities.now() {
            Some([now_d, now_v]) => {
                d.copy_from_slice(now_d);
                v.copy_from_slice(now_v);
            }
            None => {
                inner.get_outputs(d)?;
                v.fill(0.0);
            }
        }
        Ok(())
    }
}

impl<S: Subsystem> Subsystem for Adapted<S> {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        let Some(stations) = &self.stations else { return self.inner.set_inputs(values, rates) };
        stations.forces(values, &mut self.forces);
        let rates = rates.map(|rates| {
            stations.forces(rates, &mut self.rates);
            &self.rates[..]
        });
        self.inner.set_inputs(&self.forces, rates)
    }

    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        let velocities = self.velocities.as_ref();
        let own = match &self.stations {
            None => {
                Self::own_motion(&mut self.inner, velocities, outputs)?;
                &*outputs
            }
            Some(stations) => {
                Self::own_motion(&mut self.inner, velocities, &mut self.motion)?;
                stations.motions(&self.motion, outputs);
                &self.motion
            }
        };
        self.watch.iter_mut().for_each(|watch| watch.see(own));
        Ok(())
    }

    fn output_name(&self, index: usize) -> String {
        match (&self.stations, &self.velocities) {
            (None, None) => self.inner.output_name(index),
            (None, Some(velocities)) => self.inner.output_name(index % velocities.end.len()),
            (Some(stations), _) => format!("motion of the deck at support {}", index % stations.supports() + 1),
        }
    }

    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.inner.exit_initialization()?;
        if let Some(velocities) = &mut self.velocities {
            self.inner.get_outputs(&mut velocities.end)?;
            velocities.start();
        }
        Ok(())
    }

    fn step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), Failure> {
        self.watch.iter_mut().for_each(|watch| watch.begin(h));
        self.inner.step(t, h, may_restore)?;
        if let Some(velocities) = &mut self.velocities {
            self.inner.get_outputs(&mut velocities.end)?;
            velocities.step(h);
        }
        Ok(())
    }

    /// Made-up velocities belong to the state.
    fn save(&mut self) -> Result<(), Failure> {
        self.velocities.iter_mut().for_each(Velocities::save);
        self.watch.iter_mut().for_each(Watch::save);
        self.inner.save()
    }

    fn restore(&mut self) -> Result<(), Failure> {
        self.velocities.iter_mut().for_each(Velocities::restore);
        self.watch.iter_mut().for_each(Watch::restore);
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
                stations.forces(inputs, &mut self.forces);
                &self.forces
            }
        };
        let Some(mut inner) = self.inner.trial_instance(own)? else { return Ok(None) };
        let mut velocities = self.velocities.clone();
        if let Some(velocities) = &mut velocities {
            inner.get_outputs(&mut velocities.end)?;
            velocities.start();
        }
        let (forces, rates, motion) = (self.forces.clone(), self.rates.clone(), self.motion.clone());
        let stations = self.stations.clone();
        let (watch, recorded) = (None, 0);
        Ok(Some(Box::new(Adapted { inner, stations, velocities, forces, rates, motion, watch, recorded })))
    }

    fn can_derive(&self) -> bool {
        self.inner.can_derive()
    }

    fn derivative(&mut self, seed: &[f64], change: &mut [f64]) -> Result<(), Failure> {
        let seed = match &self.stations {
            None => seed,
            Some(stations) => {
                stations.forces(seed, &mut self.forces);
                &self.forces
            }
        };
        let own = if self.stations.is_some() { &mut self.motion[..] } else { &mut *change };
        match &self.velocities {
            None => self.inner.derivative(seed, own)?,
            Some(velocities) => {
                let (d, v) = own.split_at_mut(velocities.end.len());
                self.inner.derivative(seed, d)?;
                d.iter().zip(v).for_each(|(d, v)| *v = velocities.per_displacement() * d);
            }
        }
        self.stations.iter().for_each(|stations| stations.motions(&self.motion, change));
        Ok(())
    }

    fn record(&mut self, wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        let mut signals = self.inner.record(wanted);
        self.recorded = signals.len();
        let watched = self.watch.as_mut().map(|watch| watch.record(&signals, wanted));
        signals.extend(watched.into_iter().flatten());
        signals
    }

    fn read(&mut self, row: &mut [f64]) -> Result<(), Failure> {
        let (own, watched) = row.split_at_mut(self.recorded.min(row.len()));
        self.inner.read(own)?;
        self.watch.iter().for_each(|watch| watch.read(watched));
        Ok(())
    }

    fn name(&self) -> &str {
        self.inner.name()
    }

    fn seconds(&self) -> f64 {
        self.inner.seconds()
    }
}
