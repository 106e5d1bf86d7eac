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

use ttb_contract::finite::not_finite;
use ttb_dynamics::newmark::{Motion, Newmark};

use crate::contact::Contacts;
use crate::fleet::{Fleet, Inverse};
use crate::prepared::{Prepared, TrackFactors};
use crate::state::State;
use crate::track::Track;
use crate::wheels::Wheels;

/// What is constant for one step size.
#[derive(Clone, Debug)]
pub struct StepMatrices {
    /// Newmark's constants.
    pub newmark: Newmark,
    track: Arc<TrackFactors>,
    /// K̂⁻¹ of every vehicle.
    pub(crate) cars: Vec<Inverse>,
}

/// The subsystem: matrices, laws, profile, and the workspace of a step.
pub struct TrainTrackSystem {
    /// The track and its factors, shared with other runs over it.
    pub prepared: Arc<Prepared>,
    /// Vehicles from the front.
    pub fleet: Fleet,
    /// Contacts of all axles.
    pub contacts: Contacts,
    /// Where all axles stand at t₁.
    pub wheels: Wheels,
    /// Y by rows, for (t₁, h).
    pub(crate) compliance: Vec<f64>,
    /// The first axle before each axle that Y couples it with.
    pub(crate) coupled_from: Vec<usize>,
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
    pub fn new(prepared: Arc<Prepared>, fleet: Fleet, contacts: Contacts, wheels: Wheels) -> Self {
        let (n, supports) = (prepared.track.order(), prepared.track.bridge_supports());
        let axles = fleet.axles();
        Self {
            cars_free: vec![0.0; fleet.order()],
            prepared,
            fleet,
            contacts,
            wheels,
            compliance: vec![0.0; axles * axles],
            coupled_from: vec![0; axles],
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

    /// The track.
    pub fn track(&self) -> &Track {
        &self.prepared.track
    }

    /// Factors for one step size; those of the track are made once for all that share it.
    ///
    /// # Errors
    /// A matrix that is not positive definite, as a message.
    pub fn matrices(&self, newmark: Newmark) -> Result<StepMatrices, String> {
        let track = self.prepared.factors(&newmark)?;
        let cars = self.fleet.effective_inverses(&newmark);
        let cars = cars.ok_or("a car's Newmark matrix is not positive definite: check its masses and stiffnesses")?;
        Ok(StepMatrices { newmark, track, cars })
    }

    /// Finds every axle on the rail at time `t`.
    ///
    /// # Errors
    /// A wheel beyond the ends of the rail.
    pub(crate) fn locate(&mut self, t: f64) -> Result<(), String> {
        self.geometry_for = None;
        self.wheels.locate(&self.prepared.track, t)
    }

    /// Wheel positions and compliance Y for a step that ends at `t`.
    fn place(&mut self, matrices: &StepMatrices, t: f64) -> Result<(), String> {
        let key = (t.to_bits(), matrices.newmark.h.to_bits());
        if self.geometry_for == Some(key) {
            return Ok(());
        }
        self.locate(t)?;
        let points = &self.wheels.points;
        let n = points.len();
        for i in 0..n {
            // Axles stand in order: before the first that is out of reach so are all, but a vehicle couples its own.
            let table = &matrices.track.compliance;
            let near = (0..i).rev().take_while(|j| table.reaches(&points[i], &points[*j])).count();
            let from = (i - near).min(self.fleet.first_axle(i));
            for j in self.coupled_from[i]..from {
                self.compliance[i * n + j] = 0.0;
                self.compliance[j * n + i] = 0.0;
            }
            self.coupled_from[i] = from;
            for j in from..=i {
                let y = table.between(&points[i], &points[j]);
                self.compliance[i * n + j] = y;
                self.compliance[j * n + i] = y;
            }
            self.compliance[i * n + i] += points[i].local_compliance;
            let supports = self.deck_forces.len();
            let row = &mut self.to_supports[i * supports..(i + 1) * supports];
            self.reached[i] = matrices.track.compliance.to_supports(&points[i], row);
        }
        self.fleet.add_wheel_compliance(&matrices.cars, &mut self.compliance);
        self.geometry_for = Some(key);
        Ok(())
    }

    /// q_free of all cars from their old motion.
    pub(crate) fn free_cars(&mut self, matrices: &StepMatrices, old: &Motion) {
        self.fleet.free(&matrices.cars, &matrices.newmark, old, &mut self.cars_free);
    }

    /// δ_free: wheel displacements of q_free, minus r, minus the rail's deflection under the wheels.
    pub(crate) fn free_approach(&mut self, under_wheels: &[f64]) {
        for (axle, (free, rail)) in self.delta_free.iter_mut().zip(under_wheels).enumerate() {
            let wheel = self.fleet.wheel(axle).map_or(0.0, |wheel| self.cars_free[wheel]);
            *free = wheel - self.wheels.roughness[axle] - rail;
        }
    }

    /// q₁ = q_free − K̂_c⁻¹ Bᵀ F with its velocities and accelerations.
    pub(crate) fn finish_cars(&self, matrices: &StepMatrices, old: &Motion, forces: &[f64], new: &mut Motion) {
        self.fleet.press(&matrices.cars, &self.cars_free, forces, &mut new.u);
        matrices.newmark.finish_all(old, new);
    }

    /// One step from `old` to `new`, which ends at time `t` with the deck motion `deck` = [d₁…, ḋ₁…].
    ///
    /// # Errors
    /// A wheel beyond the rail, contacts that do not converge, a number that is not finite, each with its place and `t`;
    /// `new` is then undefined.
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
            self.prepared.track.history(&matrices.newmark, &old.track, &mut self.history, &mut self.work);
            self.rail_free.copy_from_slice(&self.history);
            matrices.track.factor.solve(&mut self.rail_free);
            self.free_cars(matrices, &old.cars);
            self.history_for = Some((Arc::clone(old), h));
        }
        // 2: contacts.
        let track = &self.prepared.track;
        track.deck_forces(deck, &mut self.deck_forces);
        let mut under_wheels = std::mem::take(&mut self.under_wheels);
        for (axle, rail) in under_wheels.iter_mut().enumerate() {
            let reached = self.reached[axle].clone();
            let row = &self.to_supports[axle * self.deck_forces.len()..][reached.clone()];
            let from_deck: f64 = row.iter().zip(&self.deck_forces[reached]).map(|(y, f)| y * f).sum();
            *rail = track.deflection(&self.wheels.points[axle], &self.rail_free) + from_deck;
        }
        self.free_approach(&under_wheels);
        self.under_wheels = under_wheels;
        new.delta.copy_from_slice(&old.delta);
        let solved = self.contacts.solve(&self.compliance, &self.delta_free, &mut new.delta, &mut new.forces);
        solved.map_err(|error| format!("{error} in the step to t = {t} s"))?;
        // 3: rail and cars under the contact forces.
        let u = &mut new.track.u;
        u.copy_from_slice(&self.history);
        let track = &self.prepared.track;
        track.add_deck_forces(&self.deck_forces, u);
        for (point, force) in self.wheels.points.iter().zip(&new.forces) {
            track.add_force(point, *force, u);
        }
        matrices.track.factor.solve(u);
        self.finish_cars(matrices, &old.cars, &new.forces, &mut new.cars);
        // 4: velocities, accelerations, support forces.
        matrices.newmark.finish_all(&old.track, &mut new.track);
        self.prepared.track.support_forces(&new.track, deck, &mut new.supports);
        new.deck.copy_from_slice(deck);
        match not_finite(&new.supports) {
            None => Ok(()),
            Some(i) => Err(format!("the force of support {} is {} at t = {t} s", i + 1, new.supports[i])),
        }
    }
}
