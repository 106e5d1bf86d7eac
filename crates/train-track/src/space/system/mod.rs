//! Train and track in space, strongly coupled, without refactorisation.
//!
//! ```text
//! 1  u_p = K̂_t⁻¹ p_t of plane track and lines;  q_free = K̂_c⁻¹ p_c of the cars     old state; weight, wind, curve
//! 2  s_free = (R q_free, N(u_p + K̂_t⁻¹ (k d₁ + c ḋ₁))),  ṡ_free = a₁ s_free + ṡ₀
//!    ṡ₀ = −R(a₁q + a₄q̇ + a₅q̈) and −N(a₁u + a₄u̇ + a₅ü) with N at the new place
//!    f = F(s, ṡ)                                                                    module `newton`
//! 3  u₁ = K̂_t⁻¹ (p_t + k d₁ + c ḋ₁ + Nᵀ f),   q₁ = q_free + K̂_c⁻¹ Rᵀ f
//!    supports beside the bridge: k d + c ḋ of the ground's motion, in p_t
//! 4  Newmark's velocities and accelerations, then the support forces
//! ```

mod cars;
mod places;
mod ports;
mod step;

use std::sync::Arc;

use ttb_dynamics::newmark::Newmark;
use ttb_scenario::spec::SpaceSpec;

use super::car::{AXLES, Car, CarStep, DOFS};
use super::newton::CarPorts;
use super::point::{LineFactors, LinePoint};
use super::prepared::Lines;
use super::state::SpaceState;
use crate::prepared::{Prepared, TrackFactors};
use crate::profile::rails::Rails;
use crate::wheels::Wheels;

/// What is constant for one step size.
#[derive(Clone, Debug)]
pub struct SpaceStep {
    /// Newmark's constants.
    pub newmark: Newmark,
    /// The plane track.
    pub track: Arc<TrackFactors>,
    /// The lines.
    pub lines: Arc<Vec<LineFactors>>,
    /// Kinds of cars.
    pub cars: Vec<CarStep>,
}

/// Matrices, contacts, profile, and the workspace of a step.
pub struct SpaceSystem {
    /// The plane track.
    pub prepared: Arc<Prepared>,
    /// The lines.
    pub lines: Arc<Lines>,
    /// Kinds of cars.
    pub kinds: Vec<Car>,
    /// Kind of every car.
    pub of_kind: Vec<usize>,
    /// Ports of every car.
    pub ports: Vec<CarPorts>,
    /// Where all axles stand.
    pub wheels: Wheels,
    /// Irregularity of both rails.
    pub irregularity: Rails,
    /// Wind, curve.
    pub loads: SpaceSpec,
    /// Points of the lines under all axles, line by line.
    pub points: Vec<Vec<LinePoint>>,
    geometry_for: Option<(u64, u64)>,
    history_for: Option<(Arc<SpaceState>, u64, u64)>,
    /// p and u_p of the plane track, then of the lines.
    history: Vec<Vec<f64>>,
    free: Vec<Vec<f64>>,
    cars_free: Vec<f64>,
    work: Vec<f64>,
    deck_forces: Vec<f64>,
    /// Forces of the deck on the lines' rows to it.
    line_forces: Vec<Vec<f64>>,
    to_supports: Vec<f64>,
    jacobian_for: Option<(Arc<SpaceState>, u64, u64)>,
}

impl SpaceSystem {
    /// Joins the parts and makes the workspace.
    pub fn new(
        prepared: Arc<Prepared>,
        lines: Arc<Lines>,
        kinds: Vec<Car>,
        of_kind: Vec<usize>,
        ports: Vec<CarPorts>,
        wheels: Wheels,
        irregularity: Rails,
        loads: SpaceSpec,
    ) -> Self {
        let (order, supports, axles) =
            (prepared.track.order(), prepared.track.bridge_supports(), AXLES * of_kind.len());
        let orders: Vec<usize> = lines.lines.iter().map(|(line, _)| line.order()).collect();
        let vectors = || std::iter::once(order).chain(orders.iter().copied()).map(|n| vec![0.0; n]).collect::<Vec<_>>();
        Self {
            history: vectors(),
            free: vectors(),
            points: orders.iter().map(|_| vec![LinePoint::default(); axles]).collect(),
            cars_free: vec![0.0; DOFS * of_kind.len()],
            work: vec![0.0; order],
            deck_forces: vec![0.0; supports],
            line_forces: lines.lines.iter().map(|(line, _)| vec![0.0; line.on_bridge.len()]).collect(),
            to_supports: vec![0.0; supports],
            geometry_for: None,
            history_for: None,
            jacobian_for: None,
            prepared,
            lines,
            kinds,
            of_kind,
            ports,
            wheels,
            irregularity,
            loads,
        }
    }

    /// A state at rest.
    pub fn rest(&self) -> SpaceState {
        let orders: Vec<usize> = self.lines.lines.iter().map(|(line, _)| line.order()).collect();
        let ports = self.ports.iter().map(|car| car.n).sum();
        let inner = self.ports.iter().map(|car| car.elements.len()).sum();
        let track = &self.prepared.track;
        SpaceState::rest(track.order(), &orders, DOFS * self.of_kind.len(), ports, inner, track.bridge_supports())
    }

    /// Factors for one step size.
    ///
    /// # Errors
    /// A matrix that cannot be factored, as a message.
    pub fn matrices(&self, newmark: Newmark) -> Result<SpaceStep, String> {
        let speed = self.wheels.running.speed(0.0);
        let cars: Result<_, String> = self.kinds.iter().map(|kind| CarStep::new(kind, &newmark, speed)).collect();
        Ok(SpaceStep {
            track: self.prepared.factors(&newmark)?,
            lines: self.lines.factors(&newmark)?,
            cars: cars?,
            newmark,
        })
    }

    /// Finds every axle on the rails at time `t`, with what it meets there.
    ///
    /// # Errors
    /// A wheel beyond the ends of the rail.
    pub fn locate(&mut self, t: f64) -> Result<(), String> {
        self.geometry_for = None;
        self.wheels.locate(&self.prepared.track, t)?;
        for (axle, point) in self.wheels.points.iter().enumerate() {
            let xi = self.prepared.track.part_of_element(self.wheels.position(axle, t), point.element);
            for ((line, _), points) in self.lines.lines.iter().zip(&mut self.points) {
                points[axle] = line.point(point.element, xi, self.lines.local);
            }
        }
        self.meet(t);
        Ok(())
    }

    /// Irregularity, speed and curvature under every axle at time `t`, on the rails or before them.
    pub fn meet(&mut self, t: f64) {
        let speed = self.wheels.running.speed(t.max(0.0));
        for axle in 0..self.wheels.points.len() {
            let x = self.wheels.position(axle, t);
            let place = &mut self.ports[axle / AXLES].places[axle % AXLES];
            let rails = self.irregularity.at(x);
            place.irregularity = rails.map(|rail| [rail.lateral, rail.down]);
            (place.speed, place.curvature) = (speed, self.loads.curve_at(x)[0]);
        }
    }
}
