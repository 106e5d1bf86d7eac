//! A reference method as something that [`ttb_session::drive()`] steps: its monitored points, car bodies and contact forces are
//! columns as those of the product.

use ttb_coupling::{Outcome, StepInfo};
use ttb_session::{Column, RunError, Stepping};
use ttb_train_track::car::DOFS;

use crate::outputs::{Place, failed, outputs};
use crate::stepper::{StepReport, Stepper};

/// A method under way.
pub struct Stepped<'a> {
    stepper: Stepper<'a>,
    points: Vec<String>,
    /// Where what is read stands.
    chosen: Vec<Place>,
    /// Matrices factorised so far.
    pub factors: u64,
}

impl<'a> Stepped<'a> {
    /// With the names of the monitored points, in the order of the bridge's.
    pub fn new(stepper: Stepper<'a>, points: Vec<String>) -> Self {
        Self { stepper, points, chosen: Vec::new(), factors: 0 }
    }
}

impl Stepping for Stepped<'_> {
    fn columns(&mut self, wanted: &dyn Fn(&Column) -> bool) -> Vec<Column> {
        let all = outputs(&self.points, self.stepper.state().cars.a.len() / DOFS);
        let (columns, places) = all.into_iter().filter(|(column, _)| wanted(column)).unzip();
        self.chosen = places;
        columns
    }

    /// The stepper starts in static equilibrium.
    fn start(&mut self) -> Result<(), RunError> {
        Ok(())
    }

    /// Steps have the size that the stepper was made for.
    fn step(&mut self, _t: f64, _h: f64) -> Result<StepInfo, RunError> {
        let StepReport { iterations, factors } = self.stepper.step().map_err(failed)?;
        self.factors += factors as u64;
        Ok(StepInfo { outcome: Outcome::Converged, iterations, ..StepInfo::default() })
    }

    fn read(&mut self, row: &mut [f64]) -> Result<(), RunError> {
        let state = self.stepper.state();
        for (value, place) in row.iter_mut().zip(&self.chosen) {
            *value = match *place {
                Place::Point { point, order } => self.stepper.point(point)[order],
                Place::Car(car) => state.cars.a[DOFS * car],
                Place::Wheel(wheel) => state.forces[wheel],
            };
        }
        Ok(())
    }
}
