//! All wheels on both rails, as rows and columns of the whole system.
//!
//! ```text
//! of the wheel on rail σ, outwards (docs/theory.md 17, 18):
//!     D = σ(y − φ r0 − v_σ − φ_σ h_h − a),   ζ = z − w_σ − r + σ φ_σ y_r,   ρ = σ(φ − φ_σ),   ψ                positions
//!     θ̇,   σψ̇,   η = σ(ẏ − v̇_σ − φ̇_σ h_h),   σφ̇                                                                rates
//! x = (F_y, F_z, Σu F_z, Σr F_y, Σu T_x, Σr T_x) of the wheel
//! ```

use ttb_train_track::space::car::{DOFS, FIRST_WHEELSET, OF_BODY};
use ttb_wheel_rail::contact::Contact;
use ttb_wheel_rail::patch::{Forces, Gradient, Motion, Running};

use super::assembly::{SIDES, Under, sum};
use crate::assembly::Row;

/// Components of a wheel's motion.
pub const MOTIONS: usize = 8;
/// Forces of a wheel.
pub const FORCES: usize = 6;
/// Which components are rates.
pub const RATE: [bool; MOTIONS] = [false, false, false, true, true, false, true, true];

/// One wheel at its place.
pub struct Wheel {
    /// Rows of its motion over displacements, or over velocities for rates.
    pub motion: [Row; MOTIONS],
    /// What irregularity takes off of it.
    pub offset: Motion,
    /// Where its forces act.
    pub force: [Row; FORCES],
    /// ∂ motion / ∂ force through the local compliance of its rail.
    pub local: [[f64; FORCES]; MOTIONS],
}

/// Lengths r0, h_h and y_r, m.
pub type Arms = [f64; 3];

/// The wheel of an axle (position in the train) on one side, over the irregularity (a, r) of its rail.
pub fn wheel(axle: usize, side: usize, [r0, head, rail]: Arms, under: &Under, [a, r]: [f64; 2], local: bool) -> Wheel {
    let first = axle / 4 * DOFS + FIRST_WHEELSET + axle % 4 * OF_BODY;
    let [y, z, roll, pitch, yaw]: [Row; 5] = std::array::from_fn(|i| vec![(first + i, 1.0)]);
    let ([w, v, tilt], sign) = (&under.rows[side], SIDES[side]);
    let motion = [
        sum(&[(&y, sign), (&roll, -sign * r0), (v, -sign), (tilt, -sign * head)]),
        sum(&[(&z, 1.0), (w, -1.0), (tilt, sign * rail)]),
        sum(&[(&roll, sign), (tilt, -sign)]),
        pitch.clone(),
        sum(&[(&yaw, sign)]),
        sum(&[(&yaw, sign)]),
        sum(&[(&y, sign), (v, -sign), (tilt, -sign * head)]),
        sum(&[(&roll, sign)]),
    ];
    let force = [
        sum(&[(&y, sign), (v, -sign), (tilt, -sign * head)]),
        sum(&[(&z, 1.0), (w, -1.0), (tilt, sign * rail)]),
        sum(&[(&roll, sign), (tilt, -sign)]),
        sum(&[(&roll, -sign)]),
        sum(&[(&yaw, -sign)]),
        sum(&[(&pitch, -1.0)]),
    ];
    // (w, v, φ) of the rail in positions, and forces on them: the same coefficients.
    let of_rail = [[0.0, -sign, -sign * head], [-1.0, 0.0, sign * rail], [0.0, 0.0, -sign]];
    let mut compliance = [[0.0; FORCES]; MOTIONS];
    if local {
        for (row, by) in compliance.iter_mut().zip(of_rail) {
            for (entry, from) in row.iter_mut().zip(of_rail) {
                *entry = (0..3).map(|i| by[i] * under.local[i] * from[i]).sum();
            }
        }
    }
    let mut offset = [0.0; MOTIONS];
    (offset[0], offset[1]) = (-sign * a, -r);
    Wheel { motion, offset, force, local: compliance }
}

/// Forces of a wheel and their derivatives.
pub fn answer(contact: &Contact, speed: f64, motion: &Motion) -> (Forces, Gradient) {
    let mut gradient: Gradient = [[0.0; MOTIONS]; FORCES];
    let forces = contact.forces_and_gradient(motion, Running { speed, curvature: 0.0 }, &mut gradient);
    (forces, gradient)
}
