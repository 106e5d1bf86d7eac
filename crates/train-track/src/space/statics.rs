//! Rest of train and track in space: vertical equilibrium with all lateral motions of bodies and bogies held and creep off.
//!
//! ```text
//! Q = N cos γ of both wheels of an axle, from the plane equilibrium with   F = 2 (δ/G′)^{3/2},  G′ = G/cos^{5/3}γ,  r + g(D)
//! D = −(v_d + φ_d h_h + (a_R − a_L)/2)                  the rails spread under the wheels' lateral forces Q g′
//! g(D) − φ_d (y_r − u_c)  in place of g(D)              and roll under contacts beside their axes
//! ```
//!
//! D and Q are found in turn; a few rounds, since the spread changes Q in the last digits only. Where cross-level, alignment or
//! the deck make both rails differ, wheelsets lean and stand between them as they do on straight track, so that both wheels of an
//! axle carry the same; bodies and bogies stay upright:
//!
//! ```text
//! φ = φ_s + (w_a + (r_R − r_L)/2 − φ_s y_r)/u_c,   y = φ r0 + v_s + φ_s h_h + (a_L + a_R)/2
//! ```

use super::axle::{PORTS, RAILS};
use super::car::{AXLES, DOFS, FIRST_WHEELSET, OF_BODY};
use super::state::SpaceState;
use super::system::SpaceSystem;
use crate::coupled::TrainTrackSystem;
use crate::law::Law;
use crate::state::State;
use crate::statics::equilibrium;

/// Rounds at most.
const ROUNDS: usize = 60;
/// Change of D between rounds that nothing notices, m.
const STEADY: f64 = 1e-13;

/// Plane degree of freedom of a car (z or θ) and where it stands among the 35.
pub const PLANE: [(usize, usize); 10] = {
    let mut map = [(0, 0); 10];
    let mut body = 0;
    while body < 3 {
        map[2 * body] = (2 * body, OF_BODY * body + 1);
        map[2 * body + 1] = (2 * body + 1, OF_BODY * body + 3);
        body += 1;
    }
    let mut axle = 0;
    while axle < AXLES {
        map[6 + axle] = (6 + axle, OF_BODY * (3 + axle) + 1);
        axle += 1;
    }
    map
};

/// Static equilibrium at t = 0 for the deck displacements in `deck`; `plane` is the plane train on the plane track.
///
/// # Errors
/// A wheel off the rail, or no equilibrium.
pub fn rest(
    system: &mut SpaceSystem,
    plane: &mut TrainTrackSystem,
    deck: &[f64],
    plane_state: &mut State,
    state: &mut SpaceState,
) -> Result<(), String> {
    system.locate(0.0)?;
    let supports = system.prepared.track.bridge_supports();
    let mut held = deck.to_vec();
    (0..3).for_each(|block| held[(2 * block + 1) * supports..(2 * block + 2) * supports].fill(0.0));
    let axles = system.wheels.points.len();
    let (mut d, mut roll) = (vec![0.0; axles], vec![0.0; axles]);
    let mut wheels = vec![[0.0; 4]; axles];
    let gauge = |system: &SpaceSystem, axle: usize| {
        let [left, right] = system.ports[axle / AXLES].places[axle % AXLES].irregularity;
        0.5 * (right[0] - left[0])
    };
    for _ in 0..ROUNDS {
        let mut laws = Vec::with_capacity(axles);
        for (axle, d) in d.iter().enumerate() {
            let tread = system.ports[axle / AXLES].contact.tread(*d);
            let cos = 1.0 / (1.0 + tread.slope * tread.slope).sqrt();
            let arm = system.ports[axle / AXLES].lever.rail - tread.across;
            plane.wheels.raised[axle] = tread.distance - roll[axle] * arm;
            laws.push(Law::of_wheels(tread.hertz * libm::pow(cos, -5.0 / 3.0), plane.contacts.laws()[axle].load()));
        }
        plane.contacts.replace(laws);
        equilibrium(plane, 0.0, &held[..2 * supports], plane_state)?;
        // Forces of one wheel: outwards, down, and with their arms.
        for (axle, wheel) in wheels.iter_mut().enumerate() {
            let tread = system.ports[axle / AXLES].contact.tread(d[axle]);
            let q = 0.5 * plane_state.forces[axle];
            *wheel = [q * tread.slope, -q, -q * tread.across, q * tread.slope * tread.radius];
        }
        let mut largest: f64 = 0.0;
        state.ports.iter_mut().for_each(|part| part.fill(0.0));
        press(system, &wheels, &held, state);
        for (axle, (d, roll)) in d.iter_mut().zip(&mut roll).enumerate() {
            let at = ports_before(system, axle);
            let head = system.ports[axle / AXLES].lever.head;
            let [v_d, phi_d] = [7, 8].map(|port| state.ports[1][at + port]);
            let new = -(v_d + phi_d * head + gauge(system, axle));
            largest = largest.max((new - *d).abs()).max((phi_d - *roll).abs());
            (*d, *roll) = (new, phi_d);
        }
        if largest <= STEADY {
            break;
        }
    }
    state.track.clone_from(&plane_state.track);
    for car in 0..system.of_kind.len() {
        for (from, to) in PLANE {
            state.cars.u[car * DOFS + to] = plane_state.cars.u[car * PLANE.len() + from];
        }
    }
    for axle in 0..axles {
        let at = ports_before(system, axle);
        let z = plane_state.cars.u[axle / AXLES * PLANE.len() + 6 + axle % AXLES];
        let point = &system.wheels.points[axle];
        let rail = system.prepared.track.deflection(point, &state.track.u);
        state.ports[1][at + 1] = z - rail - point.local_compliance * plane_state.forces[axle];
    }
    lean(system, state);
    system.support_forces(state, &held);
    state.deck.copy_from_slice(deck);
    Ok(())
}

/// Wheelsets lean and stand between their rails, wherever these are, so that both wheels of an axle carry the same.
pub fn lean(system: &SpaceSystem, state: &mut SpaceState) {
    for axle in 0..system.wheels.points.len() {
        let (at, ports) = (ports_before(system, axle), &system.ports[axle / AXLES]);
        let (lever, [left, right]) = (ports.lever, ports.places[axle % AXLES].irregularity);
        let dof = axle / AXLES * DOFS + FIRST_WHEELSET + axle % AXLES * OF_BODY;
        let (q, s) = (&mut state.cars.u[dof..dof + OF_BODY], &mut state.ports[1][at..at + PORTS]);
        let (sway, tilt, roll) = (q[0] - s[0], s[5], s[6]);
        let d = -(s[7] + s[8] * lever.head + 0.5 * (right[0] - left[0]));
        let twist = tilt + 0.5 * (right[1] - left[1]) - roll * lever.rail;
        q[2] = roll + twist / ports.contact.tread(d).across;
        q[0] = q[2] * lever.radius + sway + roll * lever.head + 0.5 * (left[0] + right[0]);
        (s[0], s[2]) = (q[0] - sway, q[2]);
    }
}

fn ports_before(system: &SpaceSystem, axle: usize) -> usize {
    system.ports[..axle / AXLES].iter().map(|car| car.n).sum::<usize>() + axle % AXLES * PORTS
}

/// The lines at rest under equal wheels on both rails and the deck, and the ports' forces and motions on the rails.
fn press(system: &SpaceSystem, wheels: &[[f64; 4]], deck: &[f64], state: &mut SpaceState) {
    let supports = system.prepared.track.bridge_supports();
    let across = |i: usize| [[deck[2 * supports + i], deck[4 * supports + i]], [0.0; 2]];
    for (axle, wheel) in wheels.iter().enumerate() {
        let lever = system.ports[axle / AXLES].lever;
        let at = ports_before(system, axle);
        let f = &mut state.ports[0][at..at + PORTS];
        f[1] = 2.0 * wheel[1];
        f[7] = -2.0 * wheel[0];
        f[8] = 2.0 * (lever.rail * wheel[1] - wheel[2] - lever.head * wheel[0]);
    }
    for (k, (line, ports)) in system.lines.lines.iter().enumerate() {
        let u = &mut state.lines[k].u;
        u.fill(0.0);
        line.add_deck(across, u);
        for axle in 0..wheels.len() {
            let at = ports_before(system, axle);
            for (own, port) in ports.iter().enumerate() {
                let (port, sign) = RAILS[*port];
                line.add_force(&system.points[k][axle], own, sign * state.ports[0][at + port], u);
            }
        }
        system.lines.statics[k].factor.solve(u);
        for axle in 0..wheels.len() {
            let at = ports_before(system, axle);
            let point = &system.points[k][axle];
            for (own, port) in ports.iter().enumerate() {
                let (port, sign) = RAILS[*port];
                let at = at + port;
                state.ports[1][at] = sign * line.at(point, own, u) + point.local[own] * state.ports[0][at];
            }
        }
    }
}
