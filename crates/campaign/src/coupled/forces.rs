//! Axle loads on a rigid track over the bridge: the coupled way's answer to what the modal way and the way of one axle find.
//!
//! ```text
//! x_k(t) = v t − x_k          axle k from the bridge's begin (backward: L − v t + x_k); it counts while 0 < x_k < L
//! f_i    = Σ_k P_k (1 − |x_k − s_i|/s)⁺      lever between the points s_i at equal distances s; what an end's line bears is
//!                                            the ground's
//! ```
//!
//! The points stand so close that the lever is no matter. Bridge, integrator and iteration are those of any coupled run; the
//! iteration has nothing to do, since the loads do not depend on the deck.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use ttb_bridge::Bridge;
use ttb_contract::names::{sibling, support};
use ttb_contract::{
    Component, Failure, InProcess, Instance, Interface, Model, ModelError, Port, Ports, Signal, Subsystem,
};
use ttb_coupling::{Coupling, Method, Predictor, Settings};
use ttb_scenario::spec::BridgeSpec;
use ttb_session::{Coupled, Ended, Plan as Steps, Table, TimeAxis, drive};

use super::rows;
use super::vehicles::{Watch, set_bridge};
use crate::plan::Variant;

/// Greatest distance of the points on which loads rest, m.
const DISTANCE: f64 = 0.25;

/// Loads that run over a bridge.
pub struct Passage<'a> {
    /// The bridge, its supports, points, step and end as [`on_points`] sets them.
    pub bridge: &'a BridgeSpec,
    /// Length of the deck, m.
    pub length: f64,
    /// Distance behind the first axle, m, and load, N.
    pub axles: &'a [[f64; 2]],
    /// m/s.
    pub speed: f64,
    /// Whether the first axle enters at the deck's end.
    pub backward: bool,
    /// Factors on mass and stiffness.
    pub variant: &'a Variant,
}

/// A bridge that is loaded at points at equal distances.
pub fn on_points(bridge: &BridgeSpec, length: f64, step: f64, end: f64) -> BridgeSpec {
    let parts = (length / DISTANCE).ceil().max(2.0);
    let supports = (1..parts as usize).map(|i| length * i as f64 / parts).collect();
    BridgeSpec { supports, step, end, space: false, ground: None, ..bridge.clone() }
}

impl Passage<'_> {
    /// Histories of all points of the bridge; `None` if it was asked to stop.
    ///
    /// # Errors
    /// The bridge cannot be built, or a step fails.
    pub fn run(&self, prepared: &Arc<ttb_bridge::Prepared>, stop: &AtomicBool) -> Result<Option<Table>, String> {
        let (mut bridge, ports) = self.bridge(prepared).map_err(|error| error.to_string())?;
        let distance = self.length / (ports.forces() + 1) as f64;
        let loads = Loads {
            axles: self.axles.iter().map(|[x, load]| [-x, *load]).collect(),
            speed: self.speed,
            distance,
            backward: self.backward,
            forces: vec![0.0; ports.forces()],
        };
        let settings = Settings {
            method: Method::FixedPoint,
            predictor: Predictor::Linear,
            reuse: 0,
            tolerance: 1e-9,
            max_iterations: 10,
            hold_forces: false,
            mean_forces: false,
            ..ttb_session::case::settings(&ttb_scenario::types::CouplingSettings::default(), 1)
        };
        let mut coupling = Coupling::new(ports, settings);
        let mut loads = loads;
        let mut coupled = Coupled::new(&mut loads, &mut bridge, &mut coupling);
        let axis = TimeAxis::new(self.bridge.step, self.bridge.end);
        let steps = Steps { axis, wanted: &|column: &ttb_session::Column| rows::wanted(column), clock: &|| 0.0 };
        let (mut table, mut watch) = (Table::default(), Watch(stop));
        match drive(&mut coupled, &steps, &mut [&mut table, &mut watch]) {
            Ok(Ended::Complete) => Ok(Some(table)),
            Ok(Ended::Stopped) => Ok(None),
            Err(error) => Err(error.to_string()),
        }
    }

    fn bridge(&self, prepared: &Arc<ttb_bridge::Prepared>) -> Result<(InProcess<Bridge>, Ports), ModelError> {
        let bridge = Bridge::over(prepared, self.bridge)?;
        let heaviest = self.axles.iter().map(|axle| axle[1]).fold(0.0, f64::max);
        let component = Component::Vertical;
        let forces: Vec<String> = (1..=self.bridge.supports.len()).map(|i| support(i, component.force())).collect();
        let ports = (1..=forces.len()).map(|i| Port::new(i, component, heaviest)).collect();
        let ports = Ports::new(ports, 0).ok_or_else(|| ModelError(format!("loads of {heaviest} N at most")))?;
        let interface = bridge.interface();
        let each = |motion: &str| forces.iter().map(|force| sibling(force, motion)).collect::<Vec<_>>();
        let motions = [each(component.position()), each(component.rate())].concat();
        let (into, out) = (references(interface, &forces)?, references(interface, &motions)?);
        let mut instance = Instance::new(bridge);
        instance.enter_initialization(0.0)?;
        set_bridge(&mut instance, self.variant)?;
        Ok((InProcess::new("Bridge", instance, into, out), ports))
    }
}

fn references(of: &Interface, names: &[String]) -> Result<Vec<u32>, ModelError> {
    let find = |name: &String| of.find(name).map(|reference| reference as u32);
    names
        .iter()
        .map(|name| find(name).ok_or_else(|| ModelError(format!("the bridge has no variable {name}"))))
        .collect()
}

/// Loads at speed v on a rigid track.
struct Loads {
    /// Abscissa at t = 0 and load.
    axles: Vec<[f64; 2]>,
    speed: f64,
    /// Of the points.
    distance: f64,
    backward: bool,
    forces: Vec<f64>,
}

impl Loads {
    fn at(&mut self, t: f64) {
        self.forces.fill(0.0);
        for [x, load] in &self.axles {
            let place = (x + self.speed * t) / self.distance;
            if place <= 0.0 {
                continue;
            }
            // Counted from the deck's begin, whichever end is met first.
            let parts = self.forces.len() as f64 + 1.0;
            let place = if self.backward { parts - place } else { place };
            let (before, share) = (place.floor(), place - place.floor());
            // Point i stands at (i + 1) distances; before the first and behind the last is the ground.
            let mut add = |i: f64, force: f64| {
                if i >= 0.0
                    && let Some(at) = self.forces.get_mut(i as usize)
                {
                    *at += force;
                }
            };
            add(before - 1.0, load * (1.0 - share));
            add(before, load * share);
        }
    }
}

impl Subsystem for Loads {
    fn set_inputs(&mut self, _values: &[f64], _rates: Option<&[f64]>) -> Result<(), Failure> {
        Ok(())
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        outputs.copy_from_slice(&self.forces);
        Ok(())
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.at(0.0);
        Ok(())
    }
    fn step(&mut self, t: f64, h: f64, _may_restore: bool) -> Result<(), Failure> {
        self.at(t + h);
        Ok(())
    }
    fn save(&mut self) -> Result<(), Failure> {
        Ok(())
    }
    /// The loads follow from the time of the next step alone.
    fn restore(&mut self) -> Result<(), Failure> {
        Ok(())
    }
    fn can_interpolate(&self) -> bool {
        true
    }
    fn record(&mut self, _wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        Vec::new()
    }
    fn name(&self) -> &str {
        "Loads"
    }
}
