//! A reference method as something that [`ttb_session::drive`] steps: its monitored points, car bodies and contact forces are
//! columns as those of the product.

use ttb_contract::Failure;
use ttb_coupling::{Outcome, StepInfo};
use ttb_session::{Column, Of, Quantity, RunError, Stepping};
use ttb_train_track::car::DOFS;

use crate::stepper::{StepReport, Stepper};

/// A method under way.
pub struct Stepped<'a> {
    stepper: Stepper<'a>,
    points: Vec<String>,
    /// What is read, and where it stands.
    chosen: Vec<Place>,
    /// Matrices factorised so far.
    pub factors: u64,
}

/// Where an output stands.
#[derive(Clone, Copy)]
enum Place {
    /// Displacement, velocity or acceleration of a point.
    Point(usize, usize),
    /// Acceleration of a car body.
    Car(usize),
    /// Contact force of a wheelset.
    Wheel(usize),
}

impl<'a> Stepped<'a> {
    /// With the names of the monitored points, in the order of the bridge's.
    pub fn new(stepper: Stepper<'a>, points: Vec<String>) -> Self {
        Self { stepper, points, chosen: Vec::new(), factors: 0 }
    }

    /// All outputs.
    fn outputs(&self) -> Vec<(Column, Place)> {
        let column = |quantity, of, unit: &str| Column { quantity, of, unit: unit.into(), instance: None };
        let motions = [(Quantity::Displacement, "m"), (Quantity::Velocity, "m/s"), (Quantity::Acceleration, "m/s2")];
        let mut all = Vec::new();
        for (i, name) in self.points.iter().enumerate() {
            for (which, (quantity, unit)) in motions.iter().enumerate() {
                all.push((column(quantity.clone(), Of::Point(name.clone()), unit), Place::Point(i, which)));
            }
        }
        let state = self.stepper.state();
        for car in 0..state.cars.a.len() / DOFS {
            all.push((column(Quantity::Acceleration, Of::Car(car + 1), "m/s2"), Place::Car(car)));
        }
        for wheel in 0..state.forces.len() {
            all.push((column(Quantity::ContactForce, Of::Wheel(wheel + 1), "N"), Place::Wheel(wheel)));
        }
        all
    }
}

impl Stepping for Stepped<'_> {
    fn columns(&mut self, wanted: &dyn Fn(&Column) -> bool) -> Vec<Column> {
        let (columns, places) = self.outputs().into_iter().filter(|(column, _)| wanted(column)).unzip();
        self.chosen = places;
        columns
    }

    /// The stepper starts in static equilibrium.
    fn start(&mut self) -> Result<(), RunError> {
        Ok(())
    }

    /// Steps have the size that the stepper was made for.
    fn step(&mut self, _t: f64, _h: f64) -> Result<StepInfo, RunError> {
        let failed = |e: crate::ReferenceError| Failure { subsystem: "reference".into(), message: e.to_string() };
        let StepReport { iterations, factors } = self.stepper.step().map_err(failed)?;
        self.factors += factors as u64;
        Ok(StepInfo { outcome: Outcome::Converged, iterations, ..StepInfo::default() })
    }

    fn read(&mut self, row: &mut [f64]) -> Result<(), RunError> {
        let state = self.stepper.state();
        for (value, place) in row.iter_mut().zip(&self.chosen) {
            *value = match *place {
                Place::Point(point, which) => self.stepper.point(point)[which],
                Place::Car(car) => state.cars.a[DOFS * car],
                Place::Wheel(wheel) => state.forces[wheel],
            };
        }
        Ok(())
    }
}
