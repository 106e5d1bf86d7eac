//! A train of axle loads.

use serde::Serialize;
use ttb_scenario::spec::Vehicle;
use ttb_scenario::travel::vehicle_offsets;
use ttb_scenario::types::Car;

/// One axle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Axle {
    /// Distance behind the first axle, m, 0 or more.
    pub x: f64,
    /// Static load P, N, positive down.
    pub load: f64,
}

/// A train of axle loads.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ForceTrain {
    /// Name, as on the command line.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Its own top speed, m/s; `None`: it is meant for any speed (HSLM), or nobody knows.
    pub max_speed: Option<f64>,
    /// The axles, from the first backwards; at least one.
    pub axles: Vec<Axle>,
    /// Length over buffers, m, where it is known.
    pub buffers: Option<f64>,
    /// Length of a coach, the distance at which most loads repeat, m, where it is known.
    pub coach: Option<f64>,
    /// Where the data come from.
    pub source: String,
    /// How sure they are: `secondary` for a standard that was not at hand, `program` for bundled vehicles, `user` for a
    /// file of the user.
    pub verified: String,
}

impl ForceTrain {
    /// The static axle loads of cars that stand buffer to buffer.
    #[must_use]
    pub fn of_cars(name: &str, title: &str, cars: &[Car]) -> Self {
        let vehicles: Vec<Vehicle> = cars.iter().cloned().map(Vehicle::Car).collect();
        let source = cars.first().map(|car| car.source.clone()).unwrap_or_default();
        Self { source, ..Self::of_vehicles(name, title, &vehicles) }
    }

    /// The static axle loads of vehicles that stand buffer to buffer.
    #[must_use]
    pub fn of_vehicles(name: &str, title: &str, vehicles: &[Vehicle]) -> Self {
        let loads = vehicles.iter().flat_map(Vehicle::axles).map(|[load, _]| load);
        let axles = vehicle_offsets(vehicles).into_iter().zip(loads).map(|(x, load)| Axle { x, load }).collect();
        // The pitch that most vehicles share.
        let count = |length: f64| vehicles.iter().filter(|vehicle| vehicle.length() == length).count();
        let coach = vehicles.iter().map(Vehicle::length).max_by_key(|length| count(*length));
        Self {
            name: name.into(),
            title: title.into(),
            max_speed: None,
            axles,
            buffers: Some(vehicles.iter().map(Vehicle::length).sum()),
            coach: coach.filter(|_| vehicles.len() > 1),
            source: String::new(),
            verified: "program".into(),
        }
    }

    /// Distance from the first to the last axle, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.axles.last().map_or(0.0, |axle| axle.x)
    }

    /// Sum of all loads, N.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.axles.iter().map(|axle| axle.load).sum()
    }

    /// The same train with its last axle first.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let length = self.length();
        let axles = self.axles.iter().rev().map(|axle| Axle { x: length - axle.x, load: axle.load });
        Self { axles: axles.collect(), ..self.clone() }
    }
}
