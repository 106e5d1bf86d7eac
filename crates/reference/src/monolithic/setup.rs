//! Axles, weights and matrices of the plain solver.

use ttb_scenario::GRAVITY;
use ttb_scenario::spec::TrainTrackSpec;

use super::contact::roughness;
use crate::assembly::{Matrix, Row, System};

/// One axle.
pub struct Axle {
    /// Its degree of freedom.
    pub dof: usize,
    /// Its distance behind the leading one, m.
    pub offset: f64,
    /// Its static load, N.
    pub load: f64,
}

/// v_j without the wheel, c_loc and r of an axle.
pub type Contact = (Row, f64, f64);

/// All axles from the front.
pub fn axles(spec: &TrainTrackSpec) -> Vec<Axle> {
    let (mut axles, mut front) = (Vec::new(), None);
    for (n, car) in spec.cars.iter().enumerate() {
        let overhang = 0.5 * (car.length - car.bogie_distance - car.wheelbase);
        let begin = front.unwrap_or(-overhang);
        let load = GRAVITY * (0.25 * car.body_mass + 0.5 * car.bogie_mass + car.wheelset_mass);
        let within = [0.0, car.wheelbase, car.bogie_distance, car.bogie_distance + car.wheelbase];
        axles.extend(within.iter().enumerate().map(|(i, o)| Axle {
            dof: 10 * n + 6 + i,
            offset: begin + overhang + o,
            load,
        }));
        front = Some(begin + car.length);
    }
    axles
}

/// Weight of every degree of freedom, N.
pub fn weight(spec: &TrainTrackSpec, order: usize) -> Vec<f64> {
    let mut weight = vec![0.0; order];
    for (n, car) in spec.cars.iter().enumerate() {
        let masses = [(0, car.body_mass), (2, car.bogie_mass), (4, car.bogie_mass)];
        let wheels = (6..10).map(|i| (i, car.wheelset_mass));
        masses.into_iter().chain(wheels).for_each(|(i, m)| weight[10 * n + i] = GRAVITY * m);
    }
    weight
}

/// K + a_M M + a_C C as entries, ready for the contacts to be added.
pub fn combine(system: &System, a_m: f64, a_c: f64) -> Vec<(usize, usize, f64)> {
    let scaled =
        |matrix: &Matrix, factor: f64| -> Vec<_> { matrix.0.iter().map(|(i, j, x)| (*i, *j, factor * x)).collect() };
    [scaled(&system.k, 1.0), scaled(&system.m, a_m), scaled(&system.c, a_c)].concat()
}

/// v_j without the wheel, c_loc and r of every axle after `run` metres.
pub fn place(system: &System, spec: &TrainTrackSpec, axles: &[Axle], run: f64) -> Result<Vec<Contact>, String> {
    let of = |axle: &Axle| {
        let x = spec.front_wheel + run - axle.offset;
        let (mut row, compliance) = system.rail_row(x);
        row.iter_mut().for_each(|(_, n)| *n = -*n);
        row.push((axle.dof, 1.0));
        Ok((
            row,
            if spec.local_compliance { compliance } else { 0.0 },
            roughness(&spec.irregularity, x)? * spec.irregularity_scale,
        ))
    };
    axles.iter().map(of).collect()
}
