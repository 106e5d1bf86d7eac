//! The pre-roll: the cars run alone over the irregularity before the start, so that they begin in the state the profile
//! brings them into and do not ring from a start at rest.
//!
//! ```text
//! δ_free = B q_free − N u_rest − r,   δ + Y F(δ) = δ_free,   q₁ = q_free − K̂_c⁻¹ Bᵀ F     r at the places of t < 0
//! Y = B K̂_c⁻¹ Bᵀ + N K_t⁻¹ Nᵀ + diag c_loc                                                N at the places of t = 0
//! ```
//!
//! The track answers with its static compliance at the start positions; at the end it stands still under the wheels.

use ttb_scenario::limits::pre_roll_steps;

use crate::coupled::{StepMatrices, TrainTrackSystem};
use crate::state::State;
use crate::statics::{rail_under_wheels, rail_without_wheels, static_compliance};

/// Rolls the cars for `distance` metres up to t = 0, at the speed they start with. Starts from and writes to `state`.
///
/// # Errors
/// A train that stands or creeps, a wheel off the rail, contacts that do not converge.
pub fn pre_roll(
    system: &mut TrainTrackSystem,
    matrices: &StepMatrices,
    distance: f64,
    state: &mut State,
) -> Result<(), String> {
    let h = matrices.newmark.h;
    let steps = pre_roll_steps(distance, system.wheels.running.speed(0.0), h).map_err(|e| e.to_string())?;
    system.locate(0.0)?;
    let rail = rail_without_wheels(system, &state.deck);
    static_compliance(system);
    system.fleet.add_wheel_compliance(&matrices.cars, &mut system.compliance);
    let points = system.wheels.points.iter();
    let under_wheels: Vec<f64> = points.map(|point| system.track().deflection(point, &rail)).collect();
    let (mut old, mut new) = (state.cars.clone(), state.cars.clone());
    for step in (0..steps).rev() {
        let t = -(step as f64) * h;
        system.wheels.roll_over(t);
        system.free_cars(matrices, &old);
        system.free_approach(&under_wheels);
        let solved = system.contacts.solve(&system.compliance, &system.delta_free, &mut state.delta, &mut state.forces);
        solved.map_err(|error| format!("{error} in the pre-roll of the cars, {} s before the start", -t))?;
        system.finish_cars(matrices, &old, &state.forces, &mut new);
        std::mem::swap(&mut old, &mut new);
    }
    state.cars = old;
    state.track.u = rail_under_wheels(system, rail, &state.forces);
    let State { track, deck, supports, .. } = state;
    system.track().support_forces(track, deck, supports);
    Ok(())
}
