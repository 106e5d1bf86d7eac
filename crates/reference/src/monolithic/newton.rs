//! Newton's method on the whole system, refactorised in every iteration.

use ttb_scenario::spec::TrainTrackSpec;
use ttb_sparse::Assembly;

use super::contact::{contact, static_approach};
use super::setup::{Axle, Contact};

/// Newton on A u + Σ v F = load, from `start`; without one from every axle under its static load.
pub fn solve(
    entries: &[(usize, usize, f64)],
    spec: &TrainTrackSpec,
    axles: &[Axle],
    contacts: &[Contact],
    load: &[f64],
    start: Option<&Vec<f64>>,
    u: &mut [f64],
    forces: &mut [f64],
) -> Result<(), String> {
    let mut base = Assembly::new(load.len());
    for (i, j, x) in entries.iter().filter(|(i, j, _)| i >= j) {
        let (i, j, x) = (Some(*i as u32), Some(*j as u32), *x);
        if i == j {
            base.add(&[i], &[[x]], &[[0.0]]);
        } else {
            base.add(&[i, j], &[[0.0, x], [x, 0.0]], &[[0.0; 2]; 2]);
        }
    }
    let mut known = start.is_some();
    for _ in 0..60 {
        let (mut matrix, mut residual) = (base.clone(), load.to_vec());
        for (((row, compliance, r), axle), force) in contacts.iter().zip(axles).zip(&mut *forces) {
            // Unknown u: expand about the approach under the static load, found by bisection on F(s) = P0.
            let s = if known {
                row.iter().map(|(i, n)| n * u[*i]).sum::<f64>() - r
            } else {
                static_approach(spec, axle.load, *compliance)
            };
            let (f, tangent) = contact(spec, axle.load, *compliance, s);
            *force = f;
            let dofs: Vec<Option<u32>> = row.iter().map(|(i, _)| Some(*i as u32)).collect();
            let outer: Vec<Vec<f64>> =
                row.iter().map(|(_, a)| row.iter().map(|(_, b)| tangent * a * b).collect()).collect();
            matrix.add(&dofs, &outer, &vec![vec![0.0; row.len()]; row.len()]);
            let pull = if known { f } else { f - tangent * (s + r) };
            row.iter().for_each(|(i, n)| residual[*i] -= n * pull);
        }
        if known {
            entries.iter().for_each(|(i, j, x)| residual[*i] -= x * u[*j]);
        } else {
            u.fill(0.0);
        }
        let factor = matrix.finish().and_then(|p| p.factor(1.0, 0.0, 0.0)).map_err(|e| e.to_string())?;
        factor.solve_in_place(&mut residual, &mut vec![0.0; load.len()]);
        u.iter_mut().zip(&residual).for_each(|(u, r)| *u += r);
        if known && residual.iter().all(|r| r.abs() < 1e-13) {
            return Ok(());
        }
        known = true;
    }
    Err("the monolithic Newton iteration does not converge".into())
}
