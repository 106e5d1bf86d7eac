//! One axle between its ports and its two wheels.
//!
//! ```text
//! w_σ = w_s + σ w_a,  v_σ = v_s + σ v_d,  φ_σ = φ_s + σ φ_d            σ = +1 right rail, −1 left rail
//! s = (y − v_s, z − w_s, φ, θ, ψ of the wheelset;  w_a, φ_s, v_d, φ_d of the rails under it)
//! of the wheel on rail σ, outwards:
//!     D = σ (y − v − φ r0 − φ_r h_h − a)         ζ = z − w − r + σ φ_r y_r          ρ = σ (φ − φ_r)
//!     θ̇,  σψ̇,  σψ,   η = σ (ẏ − v̇ − φ̇_r h_h),   σφ̇
//! on the wheelset  σF_y, F_z, σ(Σu F_z − Σr F_y), −Σr T_x, −σ Σu T_x
//! on the rail      −σF_y, −F_z, σ(y_r F_z − Σu F_z − h_h F_y)
//! ```
//!
//! Sums and differences of both rails move apart from each other in a track that is the same on both sides, and a
//! mirrored run has the same numbers with other signs. Wheelset and sum of the rails meet in two ports, whose force acts on
//! both: the fewer the ports, the smaller Newton's matrices.

use ttb_wheel_rail::contact::Contact;
use ttb_wheel_rail::patch::{Contacting, Forces, Gradient, Motion, Running};

/// Ports of an axle.
pub const PORTS: usize = 9;
/// Motions of the rails under an axle: w_s, w_a, v_s, φ_s, v_d, φ_d.
pub const RAIL_PORTS: usize = 6;
/// Port of each of these, and its sign there: the rails' share of a port's motion, and of the force on it.
pub const RAILS: [(usize, f64); RAIL_PORTS] = [(1, -1.0), (5, 1.0), (0, -1.0), (6, 1.0), (7, 1.0), (8, 1.0)];
/// Whether a port turns: rad and N m.
pub const TURNS: [bool; PORTS] = [false, false, true, true, true, false, true, false, true];

/// What is constant for an axle.
#[derive(Clone, Copy, Debug)]
pub struct Lever {
    /// r0, m.
    pub radius: f64,
    /// h_h, m.
    pub head: f64,
    /// y_r, m.
    pub rail: f64,
}

/// What an axle meets at its place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    /// (a, r) of the left and the right rail, m.
    pub irregularity: [[f64; 2]; 2],
    /// v, m/s.
    pub speed: f64,
    /// κ to the right, 1/m.
    pub curvature: f64,
}

/// −1 for the left rail, 1 for the right one.
pub const SIDES: [f64; 2] = [-1.0, 1.0];

impl Lever {
    /// Motion of the wheel on one side from the ports `s` and their rates `v`.
    pub fn motion(&self, side: usize, s: &[f64], v: &[f64], place: &Place) -> Motion {
        let sign = SIDES[side];
        let [a, r] = place.irregularity[side];
        let (rail_phi, rate_phi) = (s[6] + sign * s[8], v[6] + sign * v[8]);
        [
            sign * (s[0] - sign * s[7] - s[2] * self.radius - rail_phi * self.head - a),
            s[1] - sign * s[5] - r + sign * rail_phi * self.rail,
            sign * (s[2] - rail_phi),
            v[3],
            sign * v[4],
            sign * s[4],
            sign * (v[0] - sign * v[7] - rate_phi * self.head),
            sign * v[2],
        ]
    }

    fn running(side: usize, place: &Place) -> Running {
        // A curve to the right turns outwards for the right wheel.
        Running { speed: place.speed, curvature: SIDES[side] * place.curvature }
    }

    /// Adds the forces of one wheel to those of the ports.
    fn add(&self, side: usize, c: &Forces, f: &mut [f64]) {
        let sign = SIDES[side];
        let roll = self.rail * c[1] - c[2] - self.head * c[0];
        f[0] += sign * c[0];
        f[1] += c[1];
        f[2] += sign * (c[2] - c[3]);
        f[3] -= c[5];
        f[4] -= sign * c[4];
        f[5] -= sign * c[1];
        f[6] += sign * roll;
        f[7] -= c[0];
        f[8] += roll;
    }

    /// Forces on all ports.
    pub fn forces(&self, contact: &Contact, s: &[f64], v: &[f64], place: &Place, f: &mut [f64]) {
        // Left and right are added up apart, so that a mirrored axle has the same sums.
        let mut sides = [[0.0; PORTS]; 2];
        for (side, own) in sides.iter_mut().enumerate() {
            let motion = self.motion(side, s, v, place);
            self.add(side, &contact.forces(&motion, Self::running(side, place)), own);
        }
        f.iter_mut().zip(sides[0]).zip(sides[1]).for_each(|((f, a), b)| *f = a + b);
    }

    /// The patches of one wheel, and D.
    pub fn patches(
        &self,
        contact: &Contact,
        side: usize,
        s: &[f64],
        v: &[f64],
        place: &Place,
    ) -> (f64, [Contacting; 2]) {
        let motion = self.motion(side, s, v, place);
        (motion[0], contact.patches(&motion, Self::running(side, place)))
    }

    /// ∂f/∂s and ∂f/∂ṡ.
    pub fn gradients(&self, contact: &Contact, s: &[f64], v: &[f64], place: &Place) -> [[[f64; PORTS]; PORTS]; 2] {
        let mut total = [[[[0.0; PORTS]; PORTS]; 2]; 2];
        let mut gradient: Gradient = [[0.0; 8]; 6];
        for (side, total) in total.iter_mut().enumerate() {
            let motion = self.motion(side, s, v, place);
            let _ = contact.forces_and_gradient(&motion, Self::running(side, place), &mut gradient);
            let sign = SIDES[side];
            let (r0, head, rail) = (self.radius, self.head, self.rail);
            let by_position = [
                (0, 0, sign),
                (0, 2, -sign * r0),
                (0, 7, -1.0),
                (0, 6, -sign * head),
                (0, 8, -head),
                (1, 1, 1.0),
                (1, 5, -sign),
                (1, 6, sign * rail),
                (1, 8, rail),
                (2, 2, sign),
                (2, 6, -sign),
                (2, 8, -1.0),
                (5, 4, sign),
            ];
            let by_rate = [
                (3, 3, 1.0),
                (4, 4, sign),
                (6, 0, sign),
                (6, 7, -1.0),
                (6, 6, -sign * head),
                (6, 8, -head),
                (7, 2, sign),
            ];
            for (part, entries) in [(0, &by_position[..]), (1, &by_rate[..])] {
                let mut columns = [[0.0; 6]; PORTS];
                for (from, port, factor) in entries {
                    for (column, row) in columns[*port].iter_mut().zip(&gradient) {
                        *column += row[*from] * factor;
                    }
                }
                for (port, column) in columns.iter().enumerate() {
                    let mut f = [0.0; PORTS];
                    self.add(side, column, &mut f);
                    (0..PORTS).for_each(|i| total[part][i][port] = f[i]);
                }
            }
        }
        let [left, right] = total;
        std::array::from_fn(|part| {
            std::array::from_fn(|i| std::array::from_fn(|j| left[part][i][j] + right[part][i][j]))
        })
    }
}
