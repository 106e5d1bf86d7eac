//! Static equilibrium of train and track for given deck displacements.
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
use ttb_dynamics::newmark::Motion;

use crate::car::{DOFS, wheel};
use crate::coupled::TrainTrackSystem;
use crate::law::Law;
use crate::state::State;
use ttb_contract::finite::larger;

/// Newton iterations at most.
const ITERATIONS: usize = 40;
/// Out-of-balance force allowed, relative to an axle load.
const BALANCE: f64 = 1e-10;

/// Static equilibrium at time `t` for the deck displacements in `deck` = [d…, ḋ…] (velocities are ignored): rest, written
/// to `state`.
///
/// # Errors
/// A wheel off the rail, a number that is not finite, or no equilibrium within the iterations.
pub fn equilibrium(system: &mut TrainTrackSystem, t: f64, deck: &[f64], state: &mut State) -> Result<(), String> {
    system.locate(t)?;
    let rail = rail_without_wheels(system, deck);
    static_compliance(system);
    let (axles, n) = (system.wheels.points.len(), system.cars.len() * DOFS);
    let under = |i: usize| system.track().deflection(&system.wheels.points[i], &rail) + system.wheels.roughness[i];
    let offset: Vec<f64> = (0..axles).map(under).collect();
    if let Some(axle) = offset.iter().position(|under| !under.is_finite()) {
        return Err(format!("the rail under wheel {} is at {} m at t = {t} s", axle + 1, offset[axle]));
    }
    let weight =
        DVector::from_iterator(n, system.cars.iter().flat_map(|c| c.weight().iter().copied().collect::<Vec<_>>()));
    let mut stiffness = DMatrix::zeros(n, n);
    for (c, car) in system.cars.iter().enumerate() {
        stiffness.view_mut((c * DOFS, c * DOFS), (DOFS, DOFS)).copy_from(&car.stiffness);
    }
    let load = system.cars.iter().map(|c| c.axle_load).fold(0.0, larger);

    // First point of expansion: every axle under its static load.
    let mut delta: Vec<f64> = system.contacts.laws().iter().map(Law::static_approach).collect();
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
            let unbalanced = residual.iter().fold(0.0, |most, force| larger(most, force.abs()));
            if unbalanced <= BALANCE * load {
                write(system, rail, deck, q, &delta, &forces, state);
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
        contact.map_err(|error| format!("{error} in static equilibrium"))?;
        q = Some(next);
    }
    Err(format!("static equilibrium of the train was not found in {ITERATIONS} iterations"))
}

/// K_t⁻¹ k d.
pub(crate) fn rail_without_wheels(system: &TrainTrackSystem, deck: &[f64]) -> Vec<f64> {
    let mut displacements = deck.to_vec();
    displacements[deck.len() / 2..].fill(0.0);
    let (mut forces, mut u) = (vec![0.0; deck.len() / 2], vec![0.0; system.track().order()]);
    system.track().deck_forces(&displacements, &mut forces);
    system.track().add_deck_forces(&forces, &mut u);
    system.prepared.statics.solve(&mut u);
    u
}

/// u_deck + K_t⁻¹ Nᵀ F.
pub(crate) fn rail_under_wheels(system: &TrainTrackSystem, mut rail: Vec<f64>, forces: &[f64]) -> Vec<f64> {
    let mut pressed = vec![0.0; rail.len()];
    let points = system.wheels.points.iter();
    points.zip(forces).for_each(|(point, force)| system.track().add_force(point, *force, &mut pressed));
    system.prepared.statics.solve(&mut pressed);
    rail.iter_mut().zip(&pressed).for_each(|(u, p)| *u += p);
    rail
}

/// Y of the rail alone at the present wheel positions, by one static solve an axle.
pub(crate) fn static_compliance(system: &mut TrainTrackSystem) {
    let (prepared, points) = (&system.prepared, &system.wheels.points);
    let n = points.len();
    for j in 0..n {
        let mut column = vec![0.0; prepared.track.order()];
        prepared.track.add_force(&points[j], 1.0, &mut column);
        prepared.statics.solve(&mut column);
        for (i, point) in points.iter().enumerate() {
            system.compliance[i * n + j] = prepared.track.deflection(point, &column);
        }
        system.compliance[j * n + j] += points[j].local_compliance;
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
    rail: Vec<f64>,
    deck: &[f64],
    q: &DVector<f64>,
    delta: &[f64],
    forces: &[f64],
    state: &mut State,
) {
    state.cars = Motion { u: q.as_slice().to_vec(), ..Motion::rest(q.len()) };
    state.track = Motion { u: rail_under_wheels(system, rail, forces), ..Motion::rest(system.track().order()) };
    state.delta.copy_from_slice(delta);
    state.forces.copy_from_slice(forces);
    state.deck.copy_from_slice(deck);
    state.deck[deck.len() / 2..].fill(0.0);
    let State { track, deck, supports, .. } = state;
    system.track().support_forces(track, deck, supports);
}
