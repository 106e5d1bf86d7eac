//! Train, track and bridge in space as one system, as plainly as possible: the independent check of everything between.
//!
//! ```text
//! K̂ u₁ = w + p(u, u̇, ü) + B x,   x = F(m),   m = R u₁ + C x of positions,  R u̇₁ of rates
//! u₁ = A (w + p) + A B x,   A = K̂⁻¹ of cars, rails, sleepers and bridge together, dense, made once
//! Newton on x: J = I − (∂F/∂m) T,   T = R A B + C, or a₁ R A B
//! ```
//!
//! x are six forces a wheel, C the local compliance of the rails. It shares with the product the matrices of a car, the
//! bridge's elements, and the contact of one wheel on one rail, and neither the lines of the track nor ports nor the iteration
//! on the supports. Constant speed, straight track, waves.

mod assembly;
mod rest;
mod wheels;

use nalgebra::{DMatrix, DVector};
use ttb_dynamics::newmark::Newmark;
use ttb_scenario::spec::{BridgeSpec, SpaceSpec, TrainTrackSpec};
use ttb_scenario::travel::wheel_offsets;
use ttb_train_track::space::car::{AXLES, Car, DOFS};
use ttb_train_track::space::spec::{geometry, settings};
use ttb_wheel_rail::contact::Contact;
use ttb_wheel_rail::patch::Motion;

use crate::assembly::Row;
use crate::monolithic::roughness;
use assembly::System;
use wheels::{Arms, FORCES, MOTIONS, RATE, Wheel, answer, wheel};

/// A correction of the forces below this ends Newton's method, N.
const SMALL: f64 = 1e-7;
/// Corrections at most.
const ITERATIONS: usize = 60;

/// A run by this method.
pub struct Whole {
    spec: TrainTrackSpec,
    space: SpaceSpec,
    system: System,
    cars: Vec<Car>,
    contacts: Vec<Contact>,
    offsets: Vec<f64>,
    newmark: Newmark,
    /// K̂⁻¹.
    answers: DMatrix<f64>,
    weight: DVector<f64>,
    motion: [DVector<f64>; 3],
    forces: DVector<f64>,
    steps: usize,
}

impl Whole {
    /// Assembles a case and finds its rest.
    ///
    /// # Errors
    /// A case that this plain solver does not know.
    pub fn new(spec: &TrainTrackSpec, bridge: &BridgeSpec) -> Result<Self, String> {
        let space = spec.space.clone().ok_or("the scenario is plane")?;
        let cars: Vec<Car> = space.cars.iter().map(Car::new).collect::<Result<_, _>>()?;
        let table = geometry(&space.contact, &space.track)?;
        let contact =
            |car: &Car| Contact::new(table.clone(), &settings(&space.contact, car.radius, space.contact.friction));
        let contacts = cars.iter().map(contact).collect::<Result<_, _>>()?;
        let system = System::new(spec, &space, &cars, bridge)?;
        let newmark = Newmark::new(spec.newmark.gamma, spec.newmark.beta, spec.step);
        let effective = &system.k + newmark.a[0] * &system.m + newmark.a[1] * &system.c;
        let order = effective.nrows();
        let mut weight = DVector::zeros(order);
        for (n, car) in cars.iter().enumerate() {
            weight.rows_mut(n * DOFS, DOFS).copy_from_slice(&car.weight);
        }
        let zeros = || DVector::zeros(order);
        let mut whole = Self {
            offsets: wheel_offsets(&spec.cars),
            spec: spec.clone(),
            space,
            cars,
            contacts,
            newmark,
            answers: effective.try_inverse().ok_or("the whole has no inverse")?,
            weight,
            motion: [zeros(), zeros(), zeros()],
            forces: DVector::zeros(0),
            system,
            steps: 0,
        };
        let wheels = whole.wheels(0.0)?;
        (whole.motion[0], whole.forces) = rest::rest(&whole.system, &whole.cars, &whole.contacts, &wheels)?;
        Ok(whole)
    }

    /// All wheels, left before right, after `run` metres.
    fn wheels(&self, run: f64) -> Result<Vec<Wheel>, String> {
        let (spec, profiles) = (&self.spec, &self.space.irregularity);
        let mut wheels = Vec::new();
        for (axle, offset) in self.offsets.iter().enumerate() {
            let x = spec.front_wheel + run - offset;
            let at = |profile| Ok::<_, String>(roughness(profile, x)? * spec.irregularity_scale);
            let (level, alignment) = (at(&spec.irregularity)?, at(&profiles.alignment)?);
            let (twist, gauge) = (at(&profiles.cross_level)?, at(&profiles.gauge)?);
            let under = self.system.under(x);
            let track = &self.space.track;
            let arms: Arms = [self.cars[axle / AXLES].radius, track.head_height, track.half_distance];
            for (side, sign) in assembly::SIDES.into_iter().enumerate() {
                let rail = [alignment + 0.5 * sign * gauge, level + 0.5 * sign * twist];
                wheels.push(wheel(axle, side, arms, &under, rail, spec.local_compliance));
            }
        }
        Ok(wheels)
    }

    /// One step.
    ///
    /// # Errors
    /// Newton's method does not end.
    pub fn advance(&mut self) -> Result<(), String> {
        let (newmark, order) = (&self.newmark, self.answers.nrows());
        let [u, v, a] = &self.motion;
        let past = DVector::from_fn(order, |i, _| newmark.damping(u[i], v[i], a[i]));
        let inertia = DVector::from_fn(order, |i, _| newmark.inertia(u[i], v[i], a[i]));
        let load = &self.weight + &self.system.m * inertia + &self.system.c * &past;
        let free = &self.answers * load;
        let wheels = self.wheels(self.spec.speed[0][1] * (self.steps + 1) as f64 * newmark.h)?;
        let forces: Vec<&Row> = wheels.iter().flat_map(|wheel| &wheel.force).collect();
        let a1 = newmark.a[1];
        // m without forces, and T.
        let n = wheels.len();
        let (mut still, mut by_force) = (DVector::zeros(MOTIONS * n), DMatrix::zeros(MOTIONS * n, FORCES * n));
        for (i, wheel) in wheels.iter().enumerate() {
            for (k, row) in wheel.motion.iter().enumerate() {
                let factor = if RATE[k] { a1 } else { 1.0 };
                let gone: f64 = if RATE[k] { row.iter().map(|(dof, n)| n * past[*dof]).sum() } else { 0.0 };
                let moved: f64 = row.iter().map(|(dof, n)| n * free[*dof]).sum();
                still[MOTIONS * i + k] = factor * moved - gone + wheel.offset[k];
                for (j, force) in forces.iter().enumerate() {
                    let y: f64 = row
                        .iter()
                        .map(|(p, n)| n * force.iter().map(|(q, b)| self.answers[(*p, *q)] * b).sum::<f64>())
                        .sum();
                    let own = if j / FORCES == i { wheel.local[k][j % FORCES] } else { 0.0 };
                    by_force[(MOTIONS * i + k, j)] = factor * y + own;
                }
            }
        }
        let found = self.solve(&still, &by_force)?;
        let mut pressed = DVector::zeros(order);
        for (row, x) in forces.iter().zip(&found) {
            row.iter().for_each(|(dof, n)| pressed[*dof] += n * x);
        }
        let next = free + &self.answers * pressed;
        let velocity = DVector::from_fn(order, |i, _| a1 * next[i] - past[i]);
        let acceleration = DVector::from_fn(order, |i, _| newmark.a[0] * next[i] - newmark.inertia(u[i], v[i], a[i]));
        self.motion = [next, velocity, acceleration];
        self.forces = found;
        self.steps += 1;
        Ok(())
    }

    /// x = F(m(x)) from the forces of the step before; the full correction, or as much of it as makes the residual smaller.
    fn solve(&self, still: &DVector<f64>, by_force: &DMatrix<f64>) -> Result<DVector<f64>, String> {
        let speed = self.spec.speed[0][1];
        let per_car = 2 * AXLES;
        let residual = |x: &DVector<f64>| {
            let m = still + by_force * x;
            let mut slopes = DMatrix::zeros(x.len(), m.len());
            let mut r = x.clone();
            for i in 0..x.len() / FORCES {
                let own: Motion = std::array::from_fn(|k| m[MOTIONS * i + k]);
                let (f, g) = answer(&self.contacts[i / per_car], speed, &own);
                (0..FORCES).for_each(|k| r[FORCES * i + k] -= f[k]);
                slopes.view_mut((FORCES * i, MOTIONS * i), (FORCES, MOTIONS)).copy_from(&DMatrix::from_fn(
                    FORCES,
                    MOTIONS,
                    |a, b| g[a][b],
                ));
            }
            (r, slopes)
        };
        let mut x = self.forces.clone();
        for _ in 0..ITERATIONS {
            let (r, slopes) = residual(&x);
            let jacobian = DMatrix::identity(x.len(), x.len()) - slopes * by_force;
            let correction = jacobian.lu().solve(&r).ok_or("the contacts have no stiffness")?;
            let mut factor = 1.0;
            while factor > 1e-3 && residual(&(&x - factor * &correction)).0.norm() > r.norm() {
                factor *= 0.5;
            }
            x -= factor * &correction;
            if correction.amax() < SMALL {
                return Ok(x);
            }
        }
        Err(format!("the contacts did not converge in step {}", self.steps + 1))
    }

    /// Displacement and acceleration of a monitored point of the bridge.
    pub fn point(&self, point: usize) -> [f64; 2] {
        [0, 2].map(|of| self.system.points[point].iter().map(|(dof, n)| n * self.motion[of][*dof]).sum())
    }

    /// Displacement and acceleration of a degree of freedom of a car.
    pub fn car(&self, car: usize, dof: usize) -> [f64; 2] {
        [0, 2].map(|of| self.motion[of][car * DOFS + dof])
    }

    /// Lateral (outwards) and vertical force of a wheel on its rail, N; sides 0 left, 1 right.
    pub fn wheel(&self, axle: usize, side: usize) -> [f64; 2] {
        let at = FORCES * (2 * axle + side);
        [-self.forces[at], -self.forces[at + 1]]
    }
}
