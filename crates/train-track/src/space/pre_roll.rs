//! The pre-roll in space: the cars run alone over the irregularity before the start, on rails that answer statically.
//!
//! ```text
//! Y_s = R K̂_c⁻¹ Rᵀ + N K_t⁻¹ Nᵀ + diag c_loc,   Y_r = R K̂_c⁻¹ Rᵀ          N at the places of t = 0, rails without rates
//! ```

use std::sync::Arc;

use ttb_scenario::limits::pre_roll_steps;

use super::axle::RAIL_PORTS;
use super::car::AXLES;
use super::newton::{CarPorts, Of};
use super::rails::W_SUM;
use super::state::SpaceState;
use super::statics::lean;
use super::system::{SpaceStep, SpaceSystem};
use crate::compliance::RailCompliance;
use crate::prepared::TrackFactors;

/// Rolls the cars for `distance` metres up to t = 0. Starts from and writes to `state`.
///
/// # Errors
/// A train that stands or creeps, a wheel off the rail or beside it, contacts that do not converge.
pub fn pre_roll(
    system: &mut SpaceSystem,
    matrices: &SpaceStep,
    distance: f64,
    state: &mut SpaceState,
) -> Result<(), String> {
    let newmark = matrices.newmark;
    let steps = pre_roll_steps(distance, system.wheels.running.speed(0.0), newmark.h).map_err(|e| e.to_string())?;
    system.locate(0.0)?;
    let track = &system.prepared.track;
    let statics = TrackFactors {
        factor: matrices.track.factor.clone(),
        compliance: RailCompliance::new(track, &system.prepared.statics),
    };
    let lines = Arc::clone(&system.lines);
    system.fill(&matrices.cars, &statics, &lines.statics, false);
    let of = Of { a1: newmark.a[1], gamma: newmark.gamma, h: newmark.h, rails_move: false };
    let rails = rails_without_wheels(system, state);
    // The state stands on the rails of t = 0.
    system.meet(-(steps as f64) * newmark.h);
    lean(system, state);
    let (mut old, mut new) = (state.cars.clone(), state.cars.clone());
    system.begin_ports(state);
    // Only contacts and links change from step to step: J stands until a correction gains too little by it.
    system.begin_jacobians(&of, false)?;
    for step in (0..steps).rev() {
        let t = -(step as f64) * newmark.h;
        system.meet(t);
        system.free_cars(matrices, &old, t);
        system.free_car_ports(&newmark, &old);
        for (axle, rails) in rails.iter().enumerate() {
            system.ports[axle / AXLES].meet_rails(axle % AXLES, [*rails, [0.0; RAIL_PORTS]]);
        }
        system.ports.iter_mut().for_each(CarPorts::begin);
        system.solve_ports(&of, t).map_err(|e| format!("{e} (pre-roll of the cars)"))?;
        for ports in &mut system.ports {
            let [before, after] = &mut ports.inner;
            before.copy_from_slice(after);
        }
        system.finish_cars(matrices, &old, &mut new);
        std::mem::swap(&mut old, &mut new);
    }
    state.cars = old;
    system.end_ports(state);
    press_rails(system, state);
    let deck = state.deck.clone();
    system.support_forces(state, &deck);
    Ok(())
}

/// Motions of the rails under all axles by the deck's displacements alone.
fn rails_without_wheels(system: &SpaceSystem, state: &SpaceState) -> Vec<[f64; RAIL_PORTS]> {
    let supports = system.prepared.track.bridge_supports();
    let deck = &state.deck;
    let across = |i: usize| [[deck[2 * supports + i], deck[4 * supports + i]], [0.0; 2]];
    let mut down = deck[..2 * supports].to_vec();
    down[supports..].fill(0.0);
    let (mut forces, mut u) = (vec![0.0; supports], vec![0.0; system.prepared.track.order()]);
    system.prepared.track.deck_forces(&down, &mut forces);
    system.prepared.track.add_deck_forces(&forces, &mut u);
    system.prepared.statics.solve(&mut u);
    let lines: Vec<Vec<f64>> = system
        .lines
        .lines
        .iter()
        .zip(&system.lines.statics)
        .map(|((line, _), factors)| {
            let mut u = vec![0.0; line.order()];
            line.add_deck(across, &mut u);
            factors.factor.solve(&mut u);
            u
        })
        .collect();
    let under = |axle: usize| {
        let mut free = [0.0; RAIL_PORTS];
        free[W_SUM] = system.prepared.track.deflection(&system.wheels.points[axle], &u);
        for (k, (line, ports)) in system.lines.lines.iter().enumerate() {
            for (own, port) in ports.iter().enumerate() {
                free[*port] = line.at(&system.points[k][axle], own, &lines[k]);
            }
        }
        free
    };
    (0..system.wheels.points.len()).map(under).collect()
}

/// The track at rest under the ports' forces.
fn press_rails(system: &SpaceSystem, state: &mut SpaceState) {
    let supports = system.prepared.track.bridge_supports();
    let deck = state.deck.clone();
    let across = |i: usize| [[deck[2 * supports + i], deck[4 * supports + i]], [0.0; 2]];
    let mut down = deck[..2 * supports].to_vec();
    down[supports..].fill(0.0);
    let mut forces = vec![0.0; supports];
    system.prepared.track.deck_forces(&down, &mut forces);
    let u = &mut state.track.u;
    u.fill(0.0);
    system.prepared.track.add_deck_forces(&forces, u);
    for (axle, point) in system.wheels.points.iter().enumerate() {
        let f = system.ports[axle / AXLES].on_rails(axle % AXLES);
        system.prepared.track.add_force(point, f[W_SUM], u);
    }
    system.prepared.statics.solve(u);
    for (k, (line, ports)) in system.lines.lines.iter().enumerate() {
        let u = &mut state.lines[k].u;
        u.fill(0.0);
        line.add_deck(across, u);
        for axle in 0..system.wheels.points.len() {
            let f = system.ports[axle / AXLES].on_rails(axle % AXLES);
            for (own, port) in ports.iter().enumerate() {
                line.add_force(&system.points[k][axle], own, f[*port], u);
            }
        }
        system.lines.statics[k].factor.solve(u);
    }
}
