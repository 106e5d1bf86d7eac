//! All vehicles of a train: cars of 10 degrees of freedom and vehicles of bodies, wheels and links, one block each.
//!
//! ```text
//! q_free = K̂⁻¹ p                    p = w + M(…) + C(…)     Newmark's history of the block's last step
//! q₁ = q_free − K̂⁻¹ Bᵀ F,  Y += B K̂⁻¹ Bᵀ                   B picks the wheels that have a mass
//! ```
//!
//! A force alone has no degree of freedom: it stands still on the rail, δ = −w_rail − r, and presses with its load whatever δ.

use nalgebra::{DMatrix, DVector};
use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_scenario::spec::Vehicle as Data;
use ttb_scenario::types::Contact;
use ttb_scenario::vehicle::Equations;

use crate::car::{AXLES, Car, DOFS, FIRST_WHEEL, Matrix10, Vector10};
use crate::law::Law;

/// One vehicle.
#[derive(Clone, Debug)]
enum Vehicle {
    Car(Box<Car>),
    Bodies(Box<Block>),
}

/// Matrices of a vehicle of bodies.
#[derive(Clone, Debug)]
struct Block {
    equations: Equations,
    mass: DVector<f64>,
    damping: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    weight: DVector<f64>,
}

/// K̂⁻¹ of a vehicle.
#[derive(Clone, Debug)]
pub enum Inverse {
    /// Of a car.
    Car(Box<Matrix10>),
    /// Of a vehicle of bodies.
    Bodies(DMatrix<f64>),
}

/// An output of a vehicle: a degree of freedom and which of its derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Name after `car[i].`.
    pub name: String,
    /// Unit.
    pub unit: &'static str,
    /// What it is.
    pub text: String,
    /// Degree of freedom among those of all vehicles.
    pub dof: usize,
    /// Acceleration, or displacement.
    pub acceleration: bool,
}

/// All vehicles from the front.
#[derive(Clone, Debug)]
pub struct Fleet {
    vehicles: Vec<Vehicle>,
    /// First degree of freedom of every vehicle, and the number of all.
    begins: Vec<usize>,
    /// First axle of every vehicle, and the number of all.
    axles: Vec<usize>,
    /// Degree of freedom of every axle; `None`: a force alone.
    wheels: Vec<Option<usize>>,
    /// Static load of every axle, N.
    loads: Vec<f64>,
}

impl Fleet {
    /// Assembles all vehicles.
    ///
    /// # Errors
    /// A vehicle that cannot be built, with everything that is wrong with it.
    pub fn new(vehicles: &[Data]) -> Result<Self, String> {
        let mut fleet =
            Self { vehicles: Vec::new(), begins: vec![0], axles: vec![0], wheels: Vec::new(), loads: Vec::new() };
        for (number, data) in (1..).zip(vehicles) {
            let begin = fleet.order();
            let vehicle = match data {
                Data::Car(car) => {
                    let car = Car::new(car);
                    fleet.wheels.extend((0..AXLES).map(|axle| Some(begin + FIRST_WHEEL + axle)));
                    fleet.loads.extend([car.axle_load; AXLES]);
                    Vehicle::Car(Box::new(car))
                }
                Data::Bodies(vehicle) => {
                    let equations = Equations::new(vehicle).map_err(|faults| {
                        let told = faults.iter().map(|f| format!("{} {}: {}", f.path, f.rule, f.found));
                        format!("vehicle {number}: {}", told.collect::<Vec<_>>().join("; "))
                    })?;
                    fleet.wheels.extend(equations.wheels.iter().map(|dof| dof.map(|dof| begin + dof)));
                    fleet.loads.extend(&equations.loads);
                    let n = equations.mass.len();
                    Vehicle::Bodies(Box::new(Block {
                        mass: DVector::from_column_slice(&equations.mass),
                        damping: DMatrix::from_row_slice(n, n, &equations.damping),
                        stiffness: DMatrix::from_row_slice(n, n, &equations.stiffness),
                        weight: DVector::from_column_slice(&equations.weight),
                        equations,
                    }))
                }
            };
            fleet.begins.push(begin + vehicle.order());
            fleet.axles.push(fleet.wheels.len());
            fleet.vehicles.push(vehicle);
        }
        Ok(fleet)
    }

    /// Degrees of freedom of all vehicles.
    pub fn order(&self) -> usize {
        self.begins.last().copied().unwrap_or(0)
    }

    /// Wheelsets and forces of all vehicles.
    pub fn axles(&self) -> usize {
        self.wheels.len()
    }

    /// Degree of freedom of an axle; `None`: a force alone.
    pub fn wheel(&self, axle: usize) -> Option<usize> {
        self.wheels[axle]
    }

    /// Greatest static load of an axle, N.
    pub fn greatest_load(&self) -> f64 {
        self.loads.iter().copied().fold(0.0, ttb_contract::finite::larger)
    }

    /// Contact laws of all axles.
    pub fn laws(&self, contact: &Contact) -> Vec<Law> {
        let law = |(load, wheel): (&f64, &Option<usize>)| match wheel {
            Some(_) => Law::new(contact, *load),
            None => Law::dead(contact, *load),
        };
        self.loads.iter().zip(&self.wheels).map(law).collect()
    }

    /// Weights of all degrees of freedom, N.
    pub fn weight(&self) -> Vec<f64> {
        let of = |vehicle: &Vehicle| match vehicle {
            Vehicle::Car(car) => car.weight().as_slice().to_vec(),
            Vehicle::Bodies(block) => block.weight.as_slice().to_vec(),
        };
        self.vehicles.iter().flat_map(of).collect()
    }

    /// Degrees of freedom of the largest vehicle.
    pub fn largest_order(&self) -> usize {
        self.vehicles.iter().map(Vehicle::order).max().unwrap_or(0)
    }

    /// The first axle of the vehicle that an axle belongs to.
    pub fn first_axle(&self, axle: usize) -> usize {
        self.axles[self.axles.partition_point(|first| *first <= axle).saturating_sub(1)]
    }

    /// r ← r − K q, vehicle by vehicle.
    pub fn subtract_stiffness(&self, q: &[f64], residual: &mut [f64]) {
        for (vehicle, begin) in self.vehicles.iter().zip(&self.begins) {
            let own = *begin..begin + vehicle.order();
            let mut subtract = |force: &[f64]| residual[own.clone()].iter_mut().zip(force).for_each(|(r, f)| *r -= f);
            match vehicle {
                Vehicle::Car(car) => {
                    subtract((car.stiffness * Vector10::from_column_slice(&q[own.clone()])).as_slice());
                }
                Vehicle::Bodies(block) => {
                    subtract((&block.stiffness * DVector::from_column_slice(&q[own.clone()])).as_slice());
                }
            }
        }
    }

    /// Entries of K on and below the diagonal: row, column, value, column by column.
    pub fn each_stiffness(&self, mut visit: impl FnMut(usize, usize, f64)) {
        for (vehicle, begin) in self.vehicles.iter().zip(&self.begins) {
            for (i, j) in (0..vehicle.order()).flat_map(|j| (j..vehicle.order()).map(move |i| (i, j))) {
                let value = match vehicle {
                    Vehicle::Car(car) => car.stiffness[(i, j)],
                    Vehicle::Bodies(block) => block.stiffness[(i, j)],
                };
                visit(begin + i, begin + j, value);
            }
        }
    }

    /// K̂⁻¹ = (K + a₀M + a₁C)⁻¹ of every vehicle.
    pub fn effective_inverses(&self, newmark: &Newmark) -> Option<Vec<Inverse>> {
        let inverse = |vehicle: &Vehicle| match vehicle {
            Vehicle::Car(car) => Some(Inverse::Car(Box::new(car.effective_inverse(newmark)?))),
            Vehicle::Bodies(block) if block.mass.is_empty() => Some(Inverse::Bodies(DMatrix::zeros(0, 0))),
            Vehicle::Bodies(block) => {
                let a = &newmark.a;
                let effective = &block.stiffness + a[1] * &block.damping + a[0] * DMatrix::from_diagonal(&block.mass);
                Some(Inverse::Bodies(effective.cholesky()?.inverse()))
            }
        };
        self.vehicles.iter().map(inverse).collect()
    }

    /// q_free of all vehicles from their old motion.
    pub fn free(&self, inverses: &[Inverse], newmark: &Newmark, old: &Motion, free: &mut [f64]) {
        for ((vehicle, inverse), begin) in self.vehicles.iter().zip(inverses).zip(&self.begins) {
            let own = *begin..begin + vehicle.order();
            match (vehicle, inverse) {
                (Vehicle::Car(car), Inverse::Car(inverse)) => {
                    let p = car.history(newmark, &old.u[own.clone()], &old.v[own.clone()], &old.a[own.clone()]);
                    free[own].copy_from_slice((**inverse * p).as_slice());
                }
                (Vehicle::Bodies(block), Inverse::Bodies(inverse)) => {
                    let of = |values: &[f64]| DVector::from_column_slice(&values[own.clone()]);
                    let (u, v, a) = (of(&old.u), of(&old.v), of(&old.a));
                    let inertia = u.zip_zip_map(&v, &a, |u, v, a| newmark.inertia(u, v, a));
                    let damping = u.zip_zip_map(&v, &a, |u, v, a| newmark.damping(u, v, a));
                    let p = &block.weight + block.mass.component_mul(&inertia) + &block.damping * damping;
                    free[own].copy_from_slice((inverse * p).as_slice());
                }
                _ => {}
            }
        }
    }

    /// q = q_free − K̂⁻¹ Bᵀ F of all vehicles.
    pub fn press(&self, inverses: &[Inverse], free: &[f64], forces: &[f64], q: &mut [f64]) {
        for (k, inverse) in inverses.iter().enumerate() {
            let (begin, axles) = (self.begins[k], self.axles[k]..self.axles[k + 1]);
            match inverse {
                Inverse::Car(inverse) => {
                    let free = &free[begin..begin + DOFS];
                    crate::car::press(std::slice::from_ref(inverse), free, &forces[axles], &mut q[begin..begin + DOFS]);
                }
                Inverse::Bodies(inverse) => {
                    let n = self.begins[k + 1] - begin;
                    q[begin..begin + n].copy_from_slice(&free[begin..begin + n]);
                    for axle in axles {
                        let Some(wheel) = self.wheels[axle] else { continue };
                        let column = inverse.column(wheel - begin);
                        q[begin..begin + n].iter_mut().zip(column.iter()).for_each(|(q, y)| *q -= y * forces[axle]);
                    }
                }
            }
        }
    }

    /// Y ← Y + B K̂⁻¹ Bᵀ of all vehicles, Y over all axles by rows.
    pub fn add_wheel_compliance(&self, inverses: &[Inverse], y: &mut [f64]) {
        let n = self.axles();
        for (k, inverse) in inverses.iter().enumerate() {
            let (begin, axles) = (self.begins[k], self.axles[k]..self.axles[k + 1]);
            for (i, j) in axles.clone().flat_map(|i| axles.clone().map(move |j| (i, j))) {
                let (Some(a), Some(b)) = (self.wheels[i], self.wheels[j]) else { continue };
                y[i * n + j] += match inverse {
                    Inverse::Car(inverse) => inverse[(a - begin, b - begin)],
                    Inverse::Bodies(inverse) => inverse[(a - begin, b - begin)],
                };
            }
        }
    }

    /// Outputs of every vehicle that has a body.
    pub fn readings(&self) -> Vec<Vec<Reading>> {
        let of = |(vehicle, begin): (&Vehicle, &usize)| match vehicle {
            Vehicle::Car(_) => of_car(*begin),
            Vehicle::Bodies(block) => of_bodies(&block.equations, *begin),
        };
        self.vehicles.iter().zip(&self.begins).map(of).filter(|readings| !readings.is_empty()).collect()
    }
}

impl Vehicle {
    fn order(&self) -> usize {
        match self {
            Self::Car(_) => DOFS,
            Self::Bodies(block) => block.mass.len(),
        }
    }
}

/// Outputs of a car.
fn of_car(begin: usize) -> Vec<Reading> {
    [
        ("displacement", "m", "Displacement of the car body's centre, down", 0),
        ("acceleration", "m/s2", "Acceleration of the car body's centre, down", 0),
        ("pitch_acceleration", "rad/s2", "Pitch acceleration of the car body, front down", 1),
        ("front_bogie_acceleration", "m/s2", "Acceleration of the leading bogie, down", 2),
        ("rear_bogie_acceleration", "m/s2", "Acceleration of the trailing bogie, down", 4),
    ]
    .map(|(name, unit, text, dof)| Reading {
        name: name.into(),
        unit,
        text: text.into(),
        dof: begin + dof,
        acceleration: name != "displacement",
    })
    .to_vec()
}

/// Outputs of a vehicle of bodies: those of the first one have no name of a body.
fn of_bodies(equations: &Equations, begin: usize) -> Vec<Reading> {
    let mut readings = Vec::new();
    for (i, [bounce, pitch]) in equations.bodies.iter().enumerate() {
        let body =
            bounce.or(*pitch).map_or("", |dof| equations.freedoms[dof].rsplit_once(' ').map_or("", |name| name.0));
        let before = if i == 0 { String::new() } else { format!("{body}.") };
        let mut add = |name: &str, unit, what: &str, dof: Option<usize>| {
            readings.extend(dof.map(|dof| Reading {
                name: format!("{before}{name}"),
                unit,
                text: format!("{what} of body {body}"),
                dof: begin + dof,
                acceleration: name != "displacement",
            }));
        };
        add("displacement", "m", "Displacement, down,", *bounce);
        add("acceleration", "m/s2", "Acceleration, down,", *bounce);
        add("pitch_acceleration", "rad/s2", "Pitch acceleration, front down,", *pitch);
    }
    readings
}
