//! Track, bridge and cars under trial forces of the wheels, within a step.

use ttb_train_track::car::{Matrix10, add_wheel_compliance, press};

use crate::sweeps::Sweeps;
use crate::wheels::Wheels;
use crate::whole::Whole;

/// Track, bridge and cars under trial forces, within a step.
pub struct Trial<'a> {
    /// The case.
    pub whole: &'a Whole,
    /// The wheels at the step's end.
    pub wheels: &'a Wheels,
    /// Factor of track and bridge.
    pub sweeps: &'a mut Sweeps,
    /// K̂_c⁻¹ of every car.
    pub cars: &'a [Matrix10],
    /// q_free of all cars.
    pub cars_free: &'a [f64],
    /// q of all cars.
    pub moved: &'a mut Vec<f64>,
    /// Load of the wheels on the rail, as degrees of freedom and numbers.
    pub load: &'a mut Vec<(u32, f64)>,
}

impl Trial<'_> {
    /// Track and bridge under a load; the rail can then be looked at.
    pub fn look(&mut self, load: &[(u32, f64)]) {
        self.sweeps.look(load);
    }

    /// Track, bridge and cars under forces of the wheels.
    pub fn press(&mut self, forces: &[f64]) {
        self.wheels.load(&self.whole.track, forces, self.load);
        self.sweeps.look(self.load);
        self.press_cars(forces);
    }

    /// The cars alone.
    pub fn press_cars(&mut self, forces: &[f64]) {
        press(self.cars, self.cars_free, forces, self.moved);
    }

    /// A degree of freedom of the cars.
    pub fn car(&self, dof: usize) -> f64 {
        self.moved[dof]
    }

    /// Deflection of the rail under an axle, without the local part.
    pub fn rail(&self, axle: usize) -> f64 {
        let point = &self.wheels.points[axle];
        let dofs = self.whole.track.element_dofs(point.element);
        dofs.iter().zip(point.row).map(|(dof, n)| n * self.sweeps.at(*dof)).sum()
    }

    /// B K̂_c⁻¹ Bᵀ + N K̂⁻¹ Nᵀ by rows.
    pub fn compliance(&mut self, y: &mut [f64]) {
        let n = self.wheels.len();
        let row = |axle: usize| {
            let point = &self.wheels.points[axle];
            let dofs = self.whole.track.element_dofs(point.element);
            dofs.iter().zip(point.row).map(|(dof, n)| (*dof as u32, n)).collect()
        };
        let rows: Vec<Vec<(u32, f64)>> = (0..n).map(row).collect();
        self.sweeps.compliance(&rows, y);
        add_wheel_compliance(self.cars, y);
    }
}
