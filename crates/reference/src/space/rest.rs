//! Rest of the whole: creep is off, the cars stand straight, and every wheel carries half of its axle's load.
//!
//! ```text
//! track and bridge under Q g′ across, Q down at u_c, and their arms, at D = −σ(v_σ + φ_σ h_h + a) of the wheels: in turn
//! z of a wheelset from δ(Q) over its rails;  bodies and bogies on wheelsets that are held
//! ```

use nalgebra::{DMatrix, DVector};
use ttb_train_track::space::car::{AXLES, Car, DOFS, FIRST_WHEELSET, OF_BODY};
use ttb_wheel_rail::contact::Contact;

use super::assembly::System;
use super::wheels::{FORCES, Wheel};

/// Rounds, in which what is left shrinks a hundredfold and more.
const ROUNDS: usize = 12;

/// Displacements, and the forces of all wheels, at rest.
///
/// # Errors
/// A track or a car that stands on nothing.
pub fn rest(
    system: &System,
    cars: &[Car],
    contacts: &[Contact],
    wheels: &[Wheel],
) -> Result<(DVector<f64>, DVector<f64>), String> {
    let (order, first) = (system.k.nrows(), system.rails);
    let below = system.k.view((first, first), (order - first, order - first)).into_owned();
    let below = below.cholesky().ok_or("the track stands on nothing")?;
    let load = |wheel: usize| cars[wheel / (2 * AXLES)].weight.iter().sum::<f64>() / (2 * AXLES) as f64;
    let (mut u, mut x) = (DVector::zeros(order), DVector::zeros(FORCES * wheels.len()));
    for _ in 0..ROUNDS {
        let mut p = DVector::zeros(order);
        let mut local = Vec::new();
        for (i, wheel) in wheels.iter().enumerate() {
            let q = load(i);
            let moved = |k: usize, x: &DVector<f64>| -> f64 {
                let own: f64 = (0..FORCES).map(|f| wheel.local[k][f] * x[FORCES * i + f]).sum();
                wheel.motion[k].iter().filter(|(dof, _)| *dof >= first).map(|(dof, n)| n * u[*dof]).sum::<f64>()
                    + wheel.offset[k]
                    + own
            };
            let tread = contacts[i / (2 * AXLES)].tread(moved(0, &x));
            let forces = [q * tread.slope, -q, -q * tread.across, q * tread.slope * tread.radius, 0.0, 0.0];
            for (row, force) in wheel.force.iter().zip(forces) {
                row.iter().filter(|(dof, _)| *dof >= first).for_each(|(dof, n)| p[*dof] += n * force);
            }
            // Depth of the wheel over rail and irregularity.
            let cos = 1.0 / (1.0_f64 + tread.slope * tread.slope).sqrt();
            let approach = tread.hertz * (q / cos).powf(2.0 / 3.0) / cos;
            local.push(approach + tread.distance - moved(1, &x) - moved(2, &x) * tread.across);
            x.rows_mut(FORCES * i, FORCES).copy_from_slice(&forces);
        }
        u.rows_mut(first, order - first).copy_from(&below.solve(&p.rows(first, order - first).into_owned()));
        for (axle, depth) in local.chunks_exact(2).enumerate() {
            u[axle / AXLES * DOFS + FIRST_WHEELSET + axle % AXLES * OF_BODY + 1] = 0.5 * (depth[0] + depth[1]);
        }
    }
    for (n, car) in cars.iter().enumerate() {
        let (k, own) = (&car.stiffness, FIRST_WHEELSET);
        let held = |i: usize| (own..DOFS).map(|j| k[(i, j)] * u[n * DOFS + j]).sum::<f64>();
        let p = DVector::from_fn(own, |i, _| car.weight[i] - held(i));
        let body = DMatrix::from_fn(own, own, |i, j| k[(i, j)]).cholesky().ok_or("a car stands on nothing")?;
        u.rows_mut(n * DOFS, own).copy_from(&body.solve(&p));
    }
    Ok((u, x))
}
