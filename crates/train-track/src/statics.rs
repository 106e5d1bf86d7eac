//! Static equilibrium of train and track for given deck displacements, and the pre-roll of the cars.
//!
//! With the static rail compliance Y = N K_t⁻¹ Nᵀ + diag c_loc and s = B q − N u_deck − r, the contact forces are a function
//! F(s) (module `contact`), and the cars' equilibrium
//!
//! ```text
//! K_c q + Bᵀ F(B q − N u_deck − r) = w
//! ```
//!
//! is solved by Newton with the tangent K_c + Bᵀ T B, T = D (I + Y D)⁻¹: the stationary point of a convex energy. K_c alone
//! is singular, wheels are held by the contacts only.

use nalgebra::{DMatrix, DVector};
use ttb_dynamics::band::BandFactor;
use ttb_dynamics::newmark::Motion;

use crate::car::{AXLES, DOFS, FIRST_WHEEL, add_wheel_compliance};
use crate::coupled::{State, StepMatrices, TrainTrackSystem};

/// Newton iterations at most.
const ITERATIONS: usize = 40;
/// Out-of-balance force allowed, relative to an axle load.
const BALANCE: f64 = 1e-10;

/// Static equilibrium at time `t` for the deck displacements in `deck` = [d…, ḋ…] (velocities are ignored): rest, written
/// to `state`.
///
/// # Errors
/// A wheel off the rail, or no equilibrium within the iterations.
pub fn equilibrium(
    system: &mut TrainTrackSystem,
    factor: &BandFactor,
    t: f64,
    deck: &[f64],
    state: &mut State,
) -> Result<(), String> {
    system.locate(t)?;
    let rail = rail_without_wheels(system, factor, deck);
    static_compliance(system, factor);
    let (axles, n) = (system.points.len(), system.cars.len() * DOFS);
    let wheel = |axle: usize| axle / AXLES * DOFS + FIRST_WHEEL + axle % AXLES;
    let offset: Vec<f64> =
        (0..axles).map(|i| system.track.deflection(&system.points[i], &rail) + system.roughness[i]).collect();
    let weight =
        DVector::from_iterator(n, system.cars.iter().flat_map(|c| c.weight().iter().copied().collect::<Vec<_>>()));
    let mut stiffness = DMatrix::zeros(n, n);
    for (c, car) in system.cars.iter().enumerate() {
        stiffness.view_mut((c * DOFS, c * DOFS), (DOFS, DOFS)).copy_from(&car.stiffness);
    }
    let load = system.cars.iter().map(|c| c.axle_load).fold(0.0, f64::max);

    // First point of expansion: every axle under its static load.
    let mut delta: Vec<f64> = system.contacts.laws().iter().map(crate::contact::Law::static_approach).collect();
    let mut forces: Vec<f64> = delta.iter().zip(system.contacts.laws()).map(|(d, law)| law.force(*d).0).collect();
    let mut s: Vec<f64> = (0..axles)
        .map(|i| delta[i] + (0..axles).map(|j| system.compliance[i * axles + j] * forces[j]).sum::<f64>())
        .collect();
    let mut q: Option<DVector<f64>> = None;
    for _ in 0..ITERATIONS {
        // r = w − K q − Bᵀ F, and the tangent; the first time q is unknown and K q is left to the solution.
        let tangent = contact_tangent(system, &delta);
        let mut matrix = stiffness.clone();
        let mut residual = weight.clone();
        for i in 0..axles {
            residual[wheel(i)] -= forces[i];
            for j in 0..axles {
                matrix[(wheel(i), wheel(j))] += tangent[(i, j)];
                if q.is_none() {
                    residual[wheel(i)] += tangent[(i, j)] * (s[j] + offset[j]);
                }
            }
        }
        if let Some(q) = &q {
            residual -= &stiffness * q;
            if residual.amax() <= BALANCE * load {
                write(system, factor, rail, deck, q, &delta, &forces, state);
                return Ok(());
            }
        }
        let solved = matrix
            .cholesky()
            .ok_or("the train has no static equilibrium: a car stands on fewer than two axles")?
            .solve(&residual);
        let next = q.map_or_else(|| solved.clone(), |q| q + &solved);
        s = (0..axles).map(|i| next[wheel(i)] - offset[i]).collect();
        let compliance = std::mem::take(&mut system.compliance);
        let contact = system.contacts.solve(&compliance, &s, &mut delta, &mut forces);
        system.compliance = compliance;
        contact.map_err(|_| "the wheel–rail contacts have no static equilibrium".to_string())?;
        q = Some(next);
    }
    Err(format!("static equilibrium of the train was not found in {ITERATIONS} iterations"))
}

/// Rolls the cars alone over the irregularity, on the track's static compliance at their start positions, for `distance`
/// metres up to t = 0, so that they run in the state the profile has brought them into; then the track stands still under
/// their wheels. Starts from and writes to `state`.
///
/// # Errors
/// A wheel off the rail, or contacts that do not converge.
pub fn pre_roll(
    system: &mut TrainTrackSystem,
    factor: &BandFactor,
    matrices: &StepMatrices,
    distance: f64,
    state: &mut State,
) -> Result<(), String> {
    let (h, v) = (matrices.newmark.h, system.running.speed(0.0));
    let steps = (distance / (v * h)).ceil();
    if distance <= 0.0 || !steps.is_finite() {
        return Ok(());
    }
    system.locate(0.0)?;
    let rail = rail_without_wheels(system, factor, &state.deck);
    static_compliance(system, factor);
    add_wheel_compliance(&matrices.cars, &mut system.compliance);
    let under_wheels: Vec<f64> = system.points.iter().map(|point| system.track.deflection(point, &rail)).collect();
    let (mut old, mut new) = (state.cars.clone(), state.cars.clone());
    for step in (0..steps as u64).rev() {
        let t = -(step as f64) * h;
        for axle in 0..system.points.len() {
            system.roughness[axle] = system.irregularity.at(system.axle_position(axle, t));
        }
        system.free_cars(matrices, &old);
        system.free_approach(&under_wheels);
        let failed = |_| "the wheel–rail contacts did not converge in the pre-roll of the cars".to_string();
        system
            .contacts
            .solve(&system.compliance, &system.delta_free, &mut state.delta, &mut state.forces)
            .map_err(failed)?;
        system.finish_cars(matrices, &old, &state.forces, &mut new);
        std::mem::swap(&mut old, &mut new);
    }
    state.cars = old;
    state.track.u = rail_under_wheels(system, factor, rail, &state.forces);
    let State { track, deck, supports, .. } = state;
    system.track.support_forces(track, deck, supports);
    Ok(())
}

/// K_t⁻¹ k d.
fn rail_without_wheels(system: &TrainTrackSystem, factor: &BandFactor, deck: &[f64]) -> Vec<f64> {
    let mut displacements = deck.to_vec();
    displacements[deck.len() / 2..].fill(0.0);
    let (mut forces, mut u) = (vec![0.0; deck.len() / 2], vec![0.0; system.track.order()]);
    system.track.deck_forces(&displacements, &mut forces);
    system.track.add_deck_forces(&forces, &mut u);
    factor.solve(&mut u);
    u
}

/// u_deck + K_t⁻¹ Nᵀ F.
fn rail_under_wheels(system: &TrainTrackSystem, factor: &BandFactor, mut rail: Vec<f64>, forces: &[f64]) -> Vec<f64> {
    let mut pressed = vec![0.0; rail.len()];
    system.points.iter().zip(forces).for_each(|(point, force)| system.track.add_force(point, *force, &mut pressed));
    factor.solve(&mut pressed);
    rail.iter_mut().zip(&pressed).for_each(|(u, p)| *u += p);
    rail
}

/// Y of the rail alone at the present wheel positions, by one static solve an axle.
fn static_compliance(system: &mut TrainTrackSystem, factor: &BandFactor) {
    let n = system.points.len();
    for j in 0..n {
        let mut column = vec![0.0; system.track.order()];
        system.track.add_force(&system.points[j], 1.0, &mut column);
        factor.solve(&mut column);
        for i in 0..n {
            system.compliance[i * n + j] = system.track.deflection(&system.points[i], &column);
        }
        system.compliance[j * n + j] += system.points[j].local_compliance;
    }
}

/// T = S (I + S Y S)⁻¹ S, S = diag F′(δ)^{1/2}.
fn contact_tangent(system: &TrainTrackSystem, delta: &[f64]) -> DMatrix<f64> {
    let n = delta.len();
    let root: Vec<f64> = delta.iter().zip(system.contacts.laws()).map(|(d, law)| law.force(*d).1.sqrt()).collect();
    let symmetric = DMatrix::from_fn(n, n, |i, j| {
        let (i, j) = (i.max(j), i.min(j));
        root[i] * system.compliance[i * n + j] * root[j] + if i == j { 1.0 } else { 0.0 }
    });
    // I plus a positive semidefinite matrix always has a Cholesky factor; without one the state is not finite and the
    // caller's next Cholesky reports it.
    let inverse = symmetric.cholesky().map_or_else(|| DMatrix::from_element(n, n, f64::NAN), |c| c.inverse());
    DMatrix::from_fn(n, n, |i, j| root[i] * inverse[(i, j)] * root[j])
}

/// The state of rest under the found forces.
fn write(
    system: &TrainTrackSystem,
    factor: &BandFactor,
    rail: Vec<f64>,
    deck: &[f64],
    q: &DVector<f64>,
    delta: &[f64],
    forces: &[f64],
    state: &mut State,
) {
    state.cars = Motion { u: q.as_slice().to_vec(), ..Motion::rest(q.len()) };
    state.track = Motion { u: rail_under_wheels(system, factor, rail, forces), ..Motion::rest(system.track.order()) };
    state.delta.copy_from_slice(delta);
    state.forces.copy_from_slice(forces);
    state.deck.copy_from_slice(deck);
    state.deck[deck.len() / 2..].fill(0.0);
    let State { track, deck, supports, .. } = state;
    system.track.support_forces(track, deck, supports);
}
