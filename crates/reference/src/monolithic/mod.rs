//! The strongly coupled method: Newmark on the whole system, Newton on the contacts, everything refactorised every time.
//!
//! ```text
//! K̂ u₁ + Σ_j v_j F_j(s_j) = w + p(u, u̇, ü),   s_j = v_jᵀ u₁ − r(x_j),   v_j = e(z_w) − N(x_j)
//! ```
//!
//! F(s) is the contact in series with the rail's local compliance, δ + c_loc F(δ) = s. Constant speed, one smooth or wavy
//! profile: what the comparisons need, written as plainly as possible.

mod contact;
mod newton;
mod setup;

use std::ops::ControlFlow;

use ttb_coupling::{Outcome, StepInfo};
use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_scenario::spec::{BridgeSpec, TrainTrackSpec};
use ttb_session::{Column, Moment, Observer, Plan, RunError, Stepping, TimeAxis, drive};

use crate::assembly::{Row, System};
use crate::outputs::{Place, failed, outputs};
pub(crate) use contact::roughness;
use newton::solve;
use setup::{Axle, axles, combine, place, weight};

/// A run by this method.
pub struct Monolithic {
    spec: TrainTrackSpec,
    system: System,
    axles: Vec<Axle>,
    weight: Vec<f64>,
    newmark: Newmark,
    /// K + a₀M + a₁C.
    dynamics: Vec<(usize, usize, f64)>,
    points: Vec<Row>,
    /// Names of the points.
    names: Vec<String>,
    /// Where what is read stands.
    chosen: Vec<Place>,
    motion: Motion,
    forces: Vec<f64>,
    steps: usize,
}

impl Monolithic {
    /// Assembles a case and finds its static equilibrium.
    ///
    /// # Errors
    /// A case this plain solver does not know, or an iteration that does not converge.
    pub fn new(spec: &TrainTrackSpec, bridge: &BridgeSpec) -> Result<Self, String> {
        let system = System::new(spec, bridge)?;
        let axles = axles(spec);
        let newmark = Newmark::new(spec.newmark.gamma, spec.newmark.beta, spec.step);
        let weight = weight(spec, system.order);
        let statics = combine(&system, 0.0, 0.0);
        let dynamics = combine(&system, newmark.a[0], newmark.a[1]);
        let mut motion = Motion::rest(system.order);
        let contacts = place(&system, spec, &axles, 0.0)?;
        let mut forces = vec![0.0; axles.len()];
        solve(&statics, spec, &axles, &contacts, &weight, None, &mut motion.u, &mut forces)?;
        let on_deck = bridge.points.iter().filter_map(|p| p.x.map(|x| (p.name.clone(), system.deck_row(x))));
        let (names, points): (Vec<String>, Vec<Row>) = on_deck.unzip();
        let spec = spec.clone();
        Ok(Self {
            spec,
            system,
            axles,
            weight,
            newmark,
            dynamics,
            points,
            names,
            chosen: Vec::new(),
            motion,
            forces,
            steps: 0,
        })
    }

    fn advance(&mut self) -> Result<(), String> {
        let (system, newmark, motion) = (&self.system, &self.newmark, &self.motion);
        let run = self.spec.speed[0][1] * (self.steps + 1) as f64 * newmark.h;
        let contacts = place(system, &self.spec, &self.axles, run)?;
        let mut load = self.weight.clone();
        let terms = |f: &dyn Fn(f64, f64, f64) -> f64| -> Vec<f64> {
            (0..system.order).map(|i| f(motion.u[i], motion.v[i], motion.a[i])).collect()
        };
        system.m.multiply_add(&terms(&|u, v, a| newmark.inertia(u, v, a)), &mut load);
        system.c.multiply_add(&terms(&|u, v, a| newmark.damping(u, v, a)), &mut load);
        let mut next = motion.clone();
        let (forces, known) = (&mut self.forces, Some(&motion.u));
        solve(&self.dynamics, &self.spec, &self.axles, &contacts, &load, known, &mut next.u, forces)?;
        newmark.finish_all(motion, &mut next);
        self.motion = next;
        self.steps += 1;
        Ok(())
    }
}

impl Stepping for Monolithic {
    fn columns(&mut self, wanted: &dyn Fn(&Column) -> bool) -> Vec<Column> {
        let all = outputs(&self.names, self.spec.cars.len());
        let (columns, places) = all.into_iter().filter(|(column, _)| wanted(column)).unzip();
        self.chosen = places;
        columns
    }

    /// It has been started in static equilibrium.
    fn start(&mut self) -> Result<(), RunError> {
        Ok(())
    }

    /// Steps have the size of the specification.
    fn step(&mut self, _t: f64, _h: f64) -> Result<StepInfo, RunError> {
        self.advance().map_err(failed)?;
        Ok(StepInfo { outcome: Outcome::Converged, ..StepInfo::default() })
    }

    fn read(&mut self, row: &mut [f64]) -> Result<(), RunError> {
        let of = [&self.motion.u, &self.motion.v, &self.motion.a];
        for (value, place) in row.iter_mut().zip(&self.chosen) {
            *value = match *place {
                Place::Point { point, order } => self.points[point].iter().map(|(i, n)| n * of[order][*i]).sum(),
                Place::Car(car) => self.motion.a[10 * car],
                Place::Wheel(wheel) => self.forces[wheel],
            };
        }
        Ok(())
    }
}

/// Results over time, row 0 at t = 0.
#[derive(Clone, Debug, Default)]
pub struct History {
    /// Displacement of every monitored deck point, m.
    pub points: Vec<Vec<f64>>,
    /// Acceleration of every monitored deck point, m/s².
    pub point_accelerations: Vec<Vec<f64>>,
    /// Acceleration of every car body, m/s².
    pub cars: Vec<Vec<f64>>,
    /// Contact force of every axle, N.
    pub wheels: Vec<Vec<f64>>,
}

/// Runs the whole case with steps of the specification's size.
///
/// # Errors
/// A case this plain solver does not know, or an iteration that does not converge.
pub fn run(spec: &TrainTrackSpec, bridge: &BridgeSpec) -> Result<History, String> {
    let mut method = Monolithic::new(spec, bridge)?;
    let places = outputs(&method.names, spec.cars.len()).into_iter().map(|(_, place)| place).collect();
    let mut recording = Recording { places, history: History::default() };
    let axis = TimeAxis::new(spec.step, (spec.end / spec.step).round() * spec.step);
    let plan = Plan { axis, wanted: &|_| true, clock: &|| 0.0 };
    drive(&mut method, &plan, &mut [&mut recording]).map_err(|error| error.to_string())?;
    Ok(recording.history)
}

/// Sorts rows into a history.
struct Recording {
    places: Vec<Place>,
    history: History,
}

impl Observer for Recording {
    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        let push = |columns: &mut Vec<Vec<f64>>, i: usize, value: f64| {
            columns.resize(columns.len().max(i + 1), Vec::new());
            columns[i].push(value);
        };
        let history = &mut self.history;
        for (place, value) in self.places.iter().zip(moment.row) {
            match *place {
                Place::Point { point, order: 0 } => push(&mut history.points, point, *value),
                Place::Point { point, order: 2 } => push(&mut history.point_accelerations, point, *value),
                Place::Point { .. } => {}
                Place::Car(car) => push(&mut history.cars, car, *value),
                Place::Wheel(wheel) => push(&mut history.wheels, wheel, *value),
            }
        }
        Ok(ControlFlow::Continue(()))
    }
}
