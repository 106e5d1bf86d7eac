//! Forces of all ports of the train: Newton's method car by car.
//!
//! ```text
//! f = F(s, ṡ),   s = s_free + Y_s f,   ṡ = ṡ_free + a₁ Y_r f
//! Y_s = R K̂_c⁻¹ Rᵀ ⊕ N K̂_t⁻¹ Nᵀ + diag c_loc,   Y_r the same without c_loc
//! J = I − (∂F/∂s) Y_s − a₁ (∂F/∂ṡ) Y_r                       LU, 36 and the links that are not linear
//! ```
//!
//! c_loc belongs to positions only: a₁ c_loc F would be a velocity that grows with 1/h. Neighbouring cars meet through the
//! rails; what one does to the other stands on the right side, and sweeps over the train are repeated until nothing moves.
//! The first J of a step is that of the forces before it, at the new place: it is the same for all deck motions that a step is
//! tried with. What corrections have shown of it is added by Broyden's method (module `secants`), and it is renewed where one
//! gains less than a factor 5.

mod iteration;
mod ports;
mod secants;

use ttb_contract::finite::larger;

use super::axle::{PORTS, RAIL_PORTS, RAILS};
use super::car::AXLES;

pub use ports::{CarPorts, Neighbour, RailBlock};

/// Corrections at most.
const ITERATIONS: usize = 100;
/// Sweeps over the train at most.
const SWEEPS: usize = 50;
/// A correction of the positions below this ends the iteration, m; rotations count at [`ARM`].
const CORRECTION: f64 = 2e-14;
/// The same while neighbours have still to be met, m.
const ROUGHLY: f64 = 1e-11;
/// Corrections by a new J that no longer shrink end it below this, m: rounding.
const FLOOR: f64 = 1e-11;
/// J is renewed where the residual shrinks by less than this.
const GAIN: f64 = 0.2;
/// The least part of a correction that is tried.
const LEAST: f64 = 1e-4;
/// Stages in which a step is tried where Newton's method fails in one.
const STAGES: [usize; 3] = [4, 16, 64];
/// Arm by which rotations and moments are compared with displacements and forces, m.
const ARM: f64 = 0.75;

/// What a solution needs to know of the step.
#[derive(Clone, Copy, Debug)]
pub struct Of {
    /// a₁, 1/s.
    pub a1: f64,
    /// γ and h.
    pub gamma: f64,
    /// Step, s.
    pub h: f64,
    /// Whether the rails' ports have rates: not in the pre-roll, where they answer statically.
    pub rails_move: bool,
}

/// Why no forces were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotSolved {
    /// Car, counted from 0.
    pub car: usize,
    /// Whether a number was not finite.
    pub not_finite: bool,
}

/// Solves all cars; `f` of each is where it begins, J has been prepared. Sweeps until neighbours do not move each other.
///
/// # Errors
/// The car whose ports were not solved.
pub fn solve(cars: &mut [CarPorts], of: &Of) -> Result<(), NotSolved> {
    for sweep in 0..SWEEPS {
        let mut moved = 0.0;
        for car in 0..cars.len() {
            let news = meet(cars, car);
            let (first, ports) = (sweep == 0, &mut cars[car]);
            let alone = ports.neighbours.is_empty();
            if !first && news <= 0.1 * CORRECTION && (sweep > 1 || alone) {
                continue;
            }
            ports.follow(of);
            let mut solved = ports.solve(of, if first && !alone { ROUGHLY } else { CORRECTION });
            for stages in STAGES {
                if solved.is_err() {
                    solved = ports.solve_in_stages(of, stages);
                }
            }
            let solved = solved.map_err(|not_finite| NotSolved { car, not_finite })?;
            if !first {
                moved = larger(moved, solved);
            }
        }
        if sweep > 0 && moved <= CORRECTION {
            return Ok(());
        }
    }
    Err(NotSolved { car: 0, not_finite: false })
}

/// What neighbours do to the rails' ports of a car now; the largest change since the last time, m.
fn meet(cars: &mut [CarPorts], car: usize) -> f64 {
    let mut met = std::mem::take(&mut cars[car].met);
    let mut change: f64 = 0.0;
    for axle in 0..AXLES {
        let mut sum = [0.0; RAIL_PORTS];
        for neighbour in cars[car].neighbours.iter().filter(|neighbour| neighbour.axles[0] == axle) {
            let other = neighbour.axles[1];
            let f = cars[other / AXLES].on_rails(other % AXLES);
            for (sum, row) in sum.iter_mut().zip(&neighbour.block) {
                *sum += row.iter().zip(f).map(|(y, f)| y * f).sum::<f64>();
            }
        }
        for ((port, sign), sum) in RAILS.into_iter().zip(sum) {
            let (port, sum) = (axle * PORTS + port, sign * sum);
            change = larger(change, (sum - met[port]).abs() * CarPorts::arm(port));
            met[port] = sum;
        }
    }
    cars[car].met = met;
    change
}
