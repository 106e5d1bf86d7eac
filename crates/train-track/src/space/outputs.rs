//! Outputs that only a run in space has, behind those of a plane one: supports, then wheels, then cars.
//!
//! ```text
//! Y   lateral force of a wheel on its rail, outwards;   Q vertical force;   ΣY = |Y_left,y + Y_right,y| of an axle
//! ```

use ttb_contract::names::support;
use ttb_contract::{Component, Variable};
use ttb_scenario::spec::TrainTrackSpec;

use super::axle::SIDES;
use super::car::{AXLES, DOFS, FIRST_WHEELSET, OF_BODY};
use super::state::SpaceState;
use super::system::SpaceSystem;

/// Of one wheel: name, unit, text.
const WHEEL: [(&str, &str, &str); 5] = [
    ("lateral_force", "N", "Lateral force Y of the wheel on its rail, outwards"),
    ("vertical_force", "N", "Vertical force Q of the wheel on its rail, down"),
    ("derailment_ratio", "1", "Y/Q; 0 for a wheel without load"),
    ("lateral_offset", "m", "Displacement D of the wheel relative to its rail, outwards"),
    ("contact_angle", "rad", "Angle of the patch that carries most against the horizontal"),
];
/// Of one axle.
const AXLE: [(&str, &str, &str); 3] = [
    ("lateral_displacement", "m", "Lateral displacement of the wheelset, to the right"),
    ("yaw", "rad", "Yaw of the wheelset, front to the right"),
    ("track_shift_force", "N", "Amount of the sum of both lateral forces on the track"),
];
/// Of one car.
const CAR: [(&str, &str, &str); 3] = [
    ("acceleration_y", "m/s2", "Lateral acceleration of the car body's centre, to the right"),
    ("roll_acceleration", "rad/s2", "Roll acceleration of the car body, right side down"),
    ("yaw_acceleration", "rad/s2", "Yaw acceleration of the car body, front to the right"),
];

/// The variables, in their order.
pub fn variables(spec: &TrainTrackSpec) -> Vec<Variable> {
    let mut variables = Vec::new();
    let ports = [Component::Lateral, Component::Roll];
    for port in ports {
        variables.extend((1..=spec.on_bridge.len()).map(|i| {
            let text = if port == Component::Roll {
                "Moment of the support on the deck about the track's axis at the rail's foot"
            } else {
                "Force of the support on the deck, to the right"
            };
            Variable { feed_through: true, ..Variable::output(support(i, port.force()), port.unit(), text) }
        }));
    }
    for port in ports {
        let name = |i| support(i, port.mean_force());
        let text = "Mean over the last step";
        variables.extend((1..=spec.on_bridge.len()).map(|i| Variable::output(name(i), port.unit(), text)));
    }
    for axle in 1..=spec.axle_count() {
        for side in ["left", "right"] {
            let of = |(name, unit, text)| Variable::output(format!("wheel[{axle}].{side}.{name}"), unit, text);
            variables.extend(WHEEL.map(of));
        }
        variables.extend(AXLE.map(|(name, unit, text)| Variable::output(format!("wheel[{axle}].{name}"), unit, text)));
    }
    for car in 1..=spec.axle_count() / AXLES {
        variables.extend(CAR.map(|(name, unit, text)| Variable::output(format!("car[{car}].{name}"), unit, text)));
    }
    variables
}

/// Fills them in; `means` are the mean forces of all supports, blocks of F_z, F_y, M_x.
pub fn write(system: &SpaceSystem, state: &SpaceState, means: &[f64], out: &mut [f64]) {
    let n = means.len() / 3;
    let (supports, rest) = out.split_at_mut(4 * n);
    supports[..2 * n].copy_from_slice(&state.supports[n..]);
    supports[2 * n..].copy_from_slice(&means[n..]);
    let axles = system.wheels.points.len();
    let per_axle = 2 * WHEEL.len() + AXLE.len();
    let (wheels, cars) = rest.split_at_mut(axles * per_axle);
    for (axle, out) in wheels.chunks_exact_mut(per_axle).enumerate() {
        let mut shift = 0.0;
        let (sides, whole) = out.split_at_mut(2 * WHEEL.len());
        for (side, out) in sides.chunks_exact_mut(WHEEL.len()).enumerate() {
            let (d, patches) = system.wheel(state, axle, side);
            let y = -(patches[0].across + patches[1].across);
            let q = -(patches[0].down + patches[1].down);
            let most = if patches[1].normal > patches[0].normal { patches[1] } else { patches[0] };
            shift += SIDES[side] * y;
            out.copy_from_slice(&[y, q, if q > 0.0 { y / q } else { 0.0 }, d, libm::atan(-most.slope)]);
        }
        let at = axle / AXLES * DOFS + FIRST_WHEELSET + axle % AXLES * OF_BODY;
        whole.copy_from_slice(&[state.cars.u[at], state.cars.u[at + 4], shift.abs()]);
    }
    for (car, out) in cars.chunks_exact_mut(CAR.len()).enumerate() {
        let a = &state.cars.a[car * DOFS..car * DOFS + OF_BODY];
        out.copy_from_slice(&[a[0], a[2], a[4]]);
    }
}
