//! What a row leaves: four histories and what they took.

use ttb_contract::finite::largest;
use ttb_scenario::Checked;
use ttb_session::{Column, Of, Quantity as Measured};

use crate::error::Error;

/// The compared quantities, in the order of the paper's figures.
pub const QUANTITIES: [Quantity; 4] = [
    Quantity { key: "displacement", name: "deck displacement", unit: "mm", factor: 1e3 },
    Quantity { key: "deck-acceleration", name: "deck acceleration", unit: "m/s²", factor: 1.0 },
    Quantity { key: "car-acceleration", name: "car body acceleration", unit: "m/s²", factor: 1.0 },
    Quantity { key: "contact-force", name: "wheel–rail force", unit: "kN", factor: 1e-3 },
];

/// One of them.
pub struct Quantity {
    /// In file names.
    pub key: &'static str,
    /// For people.
    pub name: &'static str,
    /// Shown in this unit.
    pub unit: &'static str,
    /// From SI.
    pub factor: f64,
}

/// Which point, car and wheelset are compared.
pub struct Watched {
    /// Name of the monitored point.
    pub point: String,
    /// Car from 1.
    pub car: usize,
    /// Wheelset from 1.
    pub wheel: usize,
}

impl Watched {
    /// By the name of a point, if any, and numbers from 1.
    pub fn new(checked: &Checked, point: Option<&str>, car: usize, wheel: usize) -> Result<Self, Error> {
        let points = &checked.bridge.points;
        let (cars, wheels) = (checked.train_track.consist().len(), checked.train_track.axle_count());
        let at = match point {
            None => Some(0).filter(|_| !points.is_empty()),
            Some(name) => points.iter().position(|p| p.name == name),
        };
        let Some(at) = at else {
            let known: Vec<&str> = points.iter().map(|p| p.name.as_str()).collect();
            let asked = point.unwrap_or_default();
            let known = known.join(", ");
            return Err(Error::Input(format!("--point: the bridge has no monitored point {asked}; it has: {known}")));
        };
        let within = |option: &str, value: usize, most: usize| {
            let fits = (1..=most).contains(&value);
            let wrong = || Error::Input(format!("--{option} is {value}; the train has 1 to {most}"));
            if fits { Ok(value) } else { Err(wrong()) }
        };
        Ok(Self {
            point: points[at].name.clone(),
            car: within("car", car, cars)?,
            wheel: within("wheel", wheel, wheels)?,
        })
    }

    /// Which of [`QUANTITIES`] a column is.
    pub fn which(&self, column: &Column) -> Option<usize> {
        match (&column.of, &column.quantity) {
            (Of::Point(name), Measured::Displacement) if *name == self.point => Some(0),
            (Of::Point(name), Measured::Acceleration) if *name == self.point => Some(1),
            (Of::Car(car), Measured::Acceleration) if *car == self.car => Some(2),
            (Of::Wheel(wheel), Measured::ContactForce) if *wheel == self.wheel => Some(3),
            _ => None,
        }
    }

    /// For titles.
    pub fn describe(&self, quantity: usize) -> String {
        let place = match quantity {
            0 | 1 => format!("at {}", self.point),
            2 => format!("of car {}", self.car),
            _ => format!("of wheelset {}", self.wheel),
        };
        format!("{} {place}", QUANTITIES[quantity].name)
    }
}

/// A row.
#[derive(Clone, Debug, Default)]
pub struct Ran {
    /// Method, for people.
    pub method: String,
    /// Step, s.
    pub step: f64,
    /// Steps of the whole run, and those taken.
    pub steps: u64,
    /// Taken.
    pub taken: u64,
    /// CPU seconds before the first step.
    pub preparation: f64,
    /// CPU seconds of the steps taken.
    pub stepping: f64,
    /// Iterations and factorisations of all steps taken.
    pub iterations: u64,
    /// Factorisations.
    pub factors: u64,
    /// t, s; row 0 is the start.
    pub time: Vec<f64>,
    /// [`QUANTITIES`] over time, SI.
    pub histories: [Vec<f64>; 4],
    /// What was chosen.
    pub notes: Vec<String>,
    /// Why it could not go on.
    pub failure: Option<String>,
}

impl Ran {
    /// CPU seconds of a step.
    pub fn per_step(&self) -> f64 {
        self.stepping / self.taken.max(1) as f64
    }

    /// CPU seconds of the whole run without preparation; where it was cut short, what it would have been.
    pub fn total(&self) -> f64 {
        self.per_step() * self.steps as f64
    }

    /// Whether all steps were taken.
    pub fn complete(&self) -> bool {
        self.taken == self.steps
    }

    /// Iterations of a step.
    pub fn mean_iterations(&self) -> f64 {
        self.iterations as f64 / self.taken.max(1) as f64
    }

    /// The last time reached, s.
    pub fn reached(&self) -> f64 {
        self.time.last().copied().unwrap_or(0.0)
    }

    /// Greatest absolute value of a quantity up to time `t`.
    pub fn peak(&self, quantity: usize, t: f64) -> f64 {
        let rows = self.time.partition_point(|time| *time <= t * (1.0 + 1e-12));
        largest(self.histories[quantity][..rows].iter().map(|x| x.abs()))
    }

    /// Greatest difference of a quantity from another run of the same step, as far as both go.
    pub fn difference(&self, other: &Self, quantity: usize) -> f64 {
        let pairs = self.histories[quantity].iter().zip(&other.histories[quantity]);
        largest(pairs.map(|(a, b)| (a - b).abs()))
    }
}
