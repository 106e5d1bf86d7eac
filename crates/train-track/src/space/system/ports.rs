//! Ports of all cars: begin, Newton's matrices, solution, end; wheels that leave their rail.

use ttb_scenario::types::Creep;

use super::super::axle::PORTS;
use super::super::car::AXLES;
use super::super::error::StepError;
use super::super::newton::{Of, solve};
use super::super::state::SpaceState;
use super::SpaceSystem;

/// Why the linear law may have no solution, and what has one.
const UNBOUNDED: &str = ": linear creep forces have no bound at a flange, and where it begins to touch they may grow faster than \
                         the rail resists; space.contact.creep shen or fastsim has one";

impl SpaceSystem {
    /// Starts the ports from the forces, motions and inner states of a state.
    pub fn begin_ports(&mut self, old: &SpaceState) {
        let (mut at, mut inner) = (0, 0);
        for ports in &mut self.ports {
            let range = at..at + ports.n;
            ports.f.copy_from_slice(&old.ports[0][range.clone()]);
            ports.motion[0].copy_from_slice(&old.ports[1][range.clone()]);
            ports.motion[1].copy_from_slice(&old.ports[2][range]);
            let count = ports.elements.len();
            ports.inner[0].copy_from_slice(&old.inner[inner..inner + count]);
            ports.begin();
            (at, inner) = (at + ports.n, inner + count);
        }
    }

    /// Stores the ports' forces, motions and inner states.
    pub fn end_ports(&self, new: &mut SpaceState) {
        let (mut at, mut inner) = (0, 0);
        for ports in &self.ports {
            let range = at..at + ports.n;
            new.ports[0][range.clone()].copy_from_slice(&ports.f);
            new.ports[1][range.clone()].copy_from_slice(&ports.motion[0]);
            new.ports[2][range].copy_from_slice(&ports.motion[1]);
            let count = ports.elements.len();
            new.inner[inner..inner + count].copy_from_slice(&ports.inner[1]);
            (at, inner) = (at + ports.n, inner + count);
        }
    }

    /// J of all cars from the forces and motions that they begin with; `known`: it was made before for the same step.
    ///
    /// # Errors
    /// A matrix without factor.
    pub fn begin_jacobians(&mut self, of: &Of, known: bool) -> Result<(), String> {
        // Of a step that is tried again, J still stands where it was not renewed.
        match self.ports.iter_mut().position(|car| (car.renewed() || !known) && !car.prepare(of)) {
            None => Ok(()),
            Some(car) => Err(format!("the wheel–rail contacts of car {} have no stiffness", car + 1)),
        }
    }

    /// Solves the ports; the car that could not be solved becomes a message.
    ///
    /// # Errors
    /// No solution, or a wheel that has left its rail.
    pub fn solve_ports(&mut self, of: &Of, t: f64) -> Result<(), StepError> {
        solve(&mut self.ports, of).map_err(|error| {
            let car = error.car + 1;
            StepError::Unsolved(if error.not_finite {
                format!("a wheel–rail contact of car {car} is not a finite number in the step to t = {t} s")
            } else {
                let unbounded = if self.loads.contact.creep == Creep::Linear { UNBOUNDED } else { "" };
                format!("the wheel–rail contacts of car {car} did not converge in the step to t = {t} s{unbounded}")
            })
        })?;
        (0..self.wheels.points.len()).try_for_each(|axle| self.derailed(axle, t))
    }

    /// Whether a wheel of an axle has left its rail.
    fn derailed(&self, axle: usize, t: f64) -> Result<(), StepError> {
        let (ports, at) = (&self.ports[axle / AXLES], axle % AXLES * PORTS);
        let ([least, most], place) = (ports.contact.geometry().extent(), &ports.places[axle % AXLES]);
        let [s, v] = ports.motion.each_ref().map(|x| &x[at..at + PORTS]);
        let d = [0, 1].map(|side| ports.lever.motion(side, s, v, place)[0]);
        let Some(side) = d.iter().position(|d| *d < least || *d > most) else { return Ok(()) };
        let [left, right] = [0, 1].map(|side| {
            let (_, patches) = ports.lever.patches(&ports.contact, side, s, v, place);
            let (y, q) = patches.iter().fold((0.0, 0.0), |(y, q), p| (y - p.across, q - p.down));
            if q > 0.0 { format!("{:.2}", y / q) } else { "unloaded".into() }
        });
        let (wheel, x, mm) = (axle + 1, self.wheels.position(axle, t), 1e3 * d[side]);
        let (name, way) = (["left", "right"][side], if mm < 0.0 { "inwards" } else { "outwards" });
        Err(StepError::Derailed(format!(
            "the train derails: the {name} wheel of axle {wheel} leaves its rail at x = {x:.3} m, t = {t} s, {:.1} mm {way}; \
             last Y/Q {left} left, {right} right",
            mm.abs()
        )))
    }
}
