//! What a method can be asked for at the end of a step: columns as those of the product, and where they stand.

use ttb_contract::Failure;
use ttb_session::{Column, Of, Quantity, RunError};
use ttb_train_track::car::AXLES;

/// Where an output stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Motion of a monitored point of the bridge.
    Point {
        /// Which one.
        point: usize,
        /// 0: displacement, 1: velocity, 2: acceleration.
        order: usize,
    },
    /// Acceleration of a car body's centre; cars count from 0 at the front.
    Car(usize),
    /// Contact force of a wheelset; they count from 0 at the front.
    Wheel(usize),
}

/// All outputs of a case with these monitored points and so many cars.
pub fn outputs(points: &[String], cars: usize) -> Vec<(Column, Place)> {
    let column = |quantity, of, unit: &str| Column { quantity, of, unit: unit.into(), instance: None };
    let mut all = Vec::new();
    for (point, name) in points.iter().enumerate() {
        let motions = [(Quantity::Displacement, "m"), (Quantity::Velocity, "m/s"), (Quantity::Acceleration, "m/s2")];
        for (order, (quantity, unit)) in motions.into_iter().enumerate() {
            all.push((column(quantity, Of::Point(name.clone()), unit), Place::Point { point, order }));
        }
    }
    for car in 0..cars {
        all.push((column(Quantity::Acceleration, Of::Car(car + 1), "m/s2"), Place::Car(car)));
    }
    for wheel in 0..cars * AXLES {
        all.push((column(Quantity::ContactForce, Of::Wheel(wheel + 1), "N"), Place::Wheel(wheel)));
    }
    all
}

/// A step of a method that failed.
pub fn failed(why: impl std::fmt::Display) -> RunError {
    RunError::from(Failure::new("reference", why.to_string()))
}
