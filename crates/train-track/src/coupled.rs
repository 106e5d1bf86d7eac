//! The time-dependent train–track system, block by block, without refactorisation.
//!
//! Only the contact rows N(t) move. Everything else is constant for one step size: the rail's Newmark matrix K̂_t, each
//! car's K̂_c, their histories p (weight included) and the compliance table. One step to t₁:
//!
//! ```text
//! 1  u_p = K̂_t⁻¹ p_t                             rail without wheels and deck
//!    q_free = K̂_c⁻¹ p_c                          cars without rail
//! 2  δ_free = B q_free − N (u_p + K̂_t⁻¹ (k d₁ + c ḋ₁)) − r
//!    δ + Y F(δ) = δ_free                         Y = B K̂_c⁻¹ Bᵀ + N K̂_t⁻¹ Nᵀ + diag c_loc   (module `contact`)
//! 3  u₁ = K̂_t⁻¹ (p_t + k d₁ + c ḋ₁ + Nᵀ F),   q₁ = q_free − K̂_c⁻¹ Bᵀ F
//! 4  Newmark's velocities and accelerations, then the support forces
//! ```
//!
//! Line 1 belongs to the old state (held by pointer, never written again), wheel positions and compliances to t₁: all are
//! kept while the iteration repeats a step with other deck motions, so that a repetition costs one banded solve.

use std::ops::Range;
use std::sync::Arc;

use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_dynamics::twisted::TwistedFactor;

use crate::car::{AXLES, Car, DOFS, Matrix10, add_wheel_compliance, press, wheel};
use crate::compliance::RailCompliance;
use crate::contact::Contacts;
use crate::profile::Irregularity;
use crate::speed::Running;
use crate::track::{RailPoint, Track};

/// Dynamic state of the subsystem.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// The track's degrees of freedom.
    pub track: Motion,
    /// The cars', 10 each.
    pub cars: Motion,
    /// Approach of every axle, m.
    pub delta: Vec<f64>,
    /// Contact force of every axle, N.
    pub forces: Vec<f64>,
    /// Deck motion [d…, ḋ…] at the end of the step.
    pub deck: Vec<f64>,
    /// Support forces at the end of the step, N.
    pub supports: Vec<f64>,
}

impl State {
    /// At rest.
    pub fn rest(track_dofs: usize, cars: usize, supports: usize) -> Self {
        let axles = vec![0.0; cars * AXLES];
        Self {
            track: Motion::rest(track_dofs),
            cars: Motion::rest(cars * DOFS),
            delta: axles.clone(),
            forces: axles,
            deck: vec![0.0; 2 * supports],
            supports: vec![0.0; supports],
        }
    }

    /// All numbers, in a fixed order.
    pub fn numbers(&self) -> impl Iterator<Item = &f64> {
        let rest = self.delta.iter().chain(&self.forces).chain(&self.deck).chain(&self.supports);
        self.track.numbers().chain(self.cars.numbers()).chain(rest)
    }

    /// All numbers, writable, in the same order.
    pub fn numbers_mut(&mut self) -> impl Iterator<Item = &mut f64> {
        let rest = self.delta.iter_mut().chain(&mut self.forces).chain(&mut self.deck).chain(&mut self.supports);
        self.track.numbers_mut().chain(self.cars.numbers_mut()).chain(rest)
    }
}

/// What is constant for one step size.
#[derive(Clone, Debug)]
pub struct StepMatrices {
    /// Newmark's constants.
    pub newmark: Newmark,
    track: TwistedFactor,
    compliance: RailCompliance,
    pub(crate) cars: Vec<Matrix10>,
}

/// The subsystem: matrices, laws, profile, and the workspace of a step.
pub struct TrainTrackSystem {
    /// The track.
    pub track: Track,
    /// Cars from the front.
    pub cars: Vec<Car>,
    /// Contacts of all axles.
    pub contacts: Contacts,
    /// Distance of every axle behind the leading one, m.
    pub axle_offsets: Vec<f64>,
    /// Abscissa of the leading axle at t = 0, m.
    pub front_wheel: f64,
    /// Speed over time since the start.
    pub running: Running,
    /// Rail irregularity.
    pub irregularity: Irregularity,
    /// Wheel positions: rail points and r of every axle, and Y by rows, for (t₁, h).
    pub(crate) points: Vec<RailPoint>,
    pub(crate) roughness: Vec<f64>,
    pub(crate) compliance: Vec<f64>,
    /// N K̂⁻¹ e_s from every axle (rows) to the supports on the bridge, and which of them it reaches.
    to_supports: Vec<f64>,
    reached: Vec<Range<usize>>,
    geometry_for: Option<(u64, u64)>,
    /// p_t, u_p and q_free for (state, h).
    history: Vec<f64>,
    rail_free: Vec<f64>,
    cars_free: Vec<f64>,
    history_for: Option<(Arc<State>, u64)>,
    work: Vec<f64>,
    deck_forces: Vec<f64>,
    under_wheels: Vec<f64>,
    pub(crate) delta_free: Vec<f64>,
}

impl TrainTrackSystem {
    /// Joins the parts and makes the workspace.
    pub fn new(
        track: Track,
        cars: Vec<Car>,
        contacts: Contacts,
        axle_offsets: Vec<f64>,
        front_wheel: f64,
        running: Running,
        irregularity: Irregularity,
    ) -> Self {
        let (n, axles, supports) = (track.order(), cars.len() * AXLES, track.bridge_supports());
        Self {
            cars_free: vec![0.0; cars.len() * DOFS],
            track,
            cars,
            contacts,
            axle_offsets,
            front_wheel,
            running,
            irregularity,
            points: vec![RailPoint::default(); axles],
            roughness: vec![0.0; axles],
            compliance: vec![0.0; axles * axles],
            to_supports: vec![0.0; axles * supports],
            reached: vec![0..0; axles],
            geometry_for: None,
            history: vec![0.0; n],
            rail_free: vec![0.0; n],
            history_for: None,
            work: vec![0.0; n],
            deck_forces: vec![0.0; supports],
            under_wheels: vec![0.0; axles],
            delta_free: vec![0.0; axles],
        }
    }

    /// Factorises for one step size.
    ///
    /// # Errors
    /// A matrix that is not positive definite, as a message.
    pub fn matrices(&self, newmark: Newmark) -> Result<StepMatrices, String> {
        let effective = self.track.effective(newmark.a[0], newmark.a[1]);
        let not_held = |e| format!("track: {e}");
        let compliance = RailCompliance::new(&self.track, &effective.clone().factorise().map_err(not_held)?);
        let track = TwistedFactor::new(effective).map_err(not_held)?;
        let cars: Option<Vec<_>> = self.cars.iter().map(|c| c.effective_inverse(&newmark)).collect();
        let cars = cars.ok_or("a car's Newmark matrix is not positive definite: check its masses and stiffnesses")?;
        Ok(StepMatrices { newmark, track, compliance, cars })
    }

    /// Abscissa of an axle at time `t` after the start, m.
    pub fn axle_position(&self, axle: usize, t: f64) -> f64 {
        self.front_wheel + self.running.distance(t) - self.axle_offsets[axle]
    }

    /// Finds every axle on the rail at time `t`.
    ///
    /// # Errors
    /// A wheel beyond the ends of the rail.
    pub(crate) fn locate(&mut self, t: f64) -> Result<(), String> {
        for axle in 0..self.points.len() {
            let x = self.axle_position(axle, t);
            self.points[axle] = self.track.locate(x).ok_or_else(|| {
                let (from, to) = self.track.extent();
                format!(
                    "wheel {} leaves the rail at t = {t} s: x = {x} m, the rail lies from {from} m to {to} m",
                    axle + 1
                )
            })?;
            self.roughness[axle] = self.irregularity.at(x);
        }
        self.geometry_for = None;
        Ok(())
    }

    /// Wheel positions and compliance Y for a step that ends at `t`.
    fn place(&mut self, matrices: &StepMatrices, t: f64) -> Result<(), String> {
        let key = (t.to_bits(), matrices.newmark.h.to_bits());
        if self.geometry_for == Some(key) {
            return Ok(());
        }
        self.locate(t)?;
        let n = self.points.len();
        for i in 0..n {
            for j in 0..=i {
                let y = matrices.compliance.between(&self.points[i], &self.points[j]);
                self.compliance[i * n + j] = y;
                self.compliance[j * n + i] = y;
            }
            self.compliance[i * n + i] += self.points[i].local_compliance;
            let supports = self.deck_forces.len();
            let row = &mut self.to_supports[i * supports..(i + 1) * supports];
            self.reached[i] = matrices.compliance.to_supports(&self.points[i], row);
        }
        add_wheel_compliance(&matrices.cars, &mut self.compliance);
        self.geometry_for = Some(key);
        Ok(())
    }

    /// q_free of all cars from their old motion.
    pub(crate) fn free_cars(&mut self, matrices: &StepMatrices, old: &Motion) {
        for (c, (car, inverse)) in self.cars.iter().zip(&matrices.cars).enumerate() {
            let p = car.history(&matrices.newmark, old, c);
            self.cars_free[c * DOFS..(c + 1) * DOFS].copy_from_slice((inverse * p).as_slice());
        }
    }

    /// δ_free: wheel displacements of q_free, minus r, minus the rail's deflection under the wheels.
    pub(crate) fn free_approach(&mut self, under_wheels: &[f64]) {
        for (axle, (free, rail)) in self.delta_free.iter_mut().zip(under_wheels).enumerate() {
            *free = self.cars_free[wheel(axle)] - self.roughness[axle] - rail;
        }
    }

    /// q₁ = q_free − K̂_c⁻¹ Bᵀ F with its velocities and accelerations.
    pub(crate) fn finish_cars(&self, matrices: &StepMatrices, old: &Motion, forces: &[f64], new: &mut Motion) {
        press(&matrices.cars, &self.cars_free, forces, &mut new.u);
        matrices.newmark.finish_all(old, new);
    }

    /// One step from `old` to `new`, which ends at time `t` with the deck motion `deck` = [d₁…, ḋ₁…].
    ///
    /// # Errors
    /// A wheel beyond the rail, or contacts that do not converge; `new` is then undefined.
    pub fn step(
        &mut self,
        matrices: &StepMatrices,
        old: &Arc<State>,
        new: &mut State,
        deck: &[f64],
        t: f64,
    ) -> Result<(), String> {
        self.place(matrices, t)?;
        let h = matrices.newmark.h.to_bits();
        if !self.history_for.as_ref().is_some_and(|(state, size)| Arc::ptr_eq(state, old) && *size == h) {
            self.track.history(&matrices.newmark, &old.track, &mut self.history, &mut self.work);
            self.rail_free.copy_from_slice(&self.history);
            matrices.track.solve(&mut self.rail_free);
            self.free_cars(matrices, &old.cars);
            self.history_for = Some((Arc::clone(old), h));
        }
        // 2: contacts.
        self.track.deck_forces(deck, &mut self.deck_forces);
        let mut under_wheels = std::mem::take(&mut self.under_wheels);
        for (axle, rail) in under_wheels.iter_mut().enumerate() {
            let reached = self.reached[axle].clone();
            let row = &self.to_supports[axle * self.deck_forces.len()..][reached.clone()];
            let from_deck: f64 = row.iter().zip(&self.deck_forces[reached]).map(|(y, f)| y * f).sum();
            *rail = self.track.deflection(&self.points[axle], &self.rail_free) + from_deck;
        }
        self.free_approach(&under_wheels);
        self.under_wheels = under_wheels;
        new.delta.copy_from_slice(&old.delta);
        self.contacts.solve(&self.compliance, &self.delta_free, &mut new.delta, &mut new.forces).map_err(
            |iterations| {
                format!("the wheel–rail contacts did not converge in {iterations} iterations in the step to t = {t} s")
            },
        )?;
        // 3: rail and cars under the contact forces.
        let u = &mut new.track.u;
        u.copy_from_slice(&self.history);
        self.track.add_deck_forces(&self.deck_forces, u);
        for (point, force) in self.points.iter().zip(&new.forces) {
            self.track.add_force(point, *force, u);
        }
        matrices.track.solve(u);
        self.finish_cars(matrices, &old.cars, &new.forces, &mut new.cars);
        // 4: velocities, accelerations, support forces.
        matrices.newmark.finish_all(&old.track, &mut new.track);
        self.track.support_forces(&new.track, deck, &mut new.supports);
        new.deck.copy_from_slice(deck);
        Ok(())
    }
}
