//! The strongly coupled method: Newmark on the whole system, Newton on the contacts, everything refactorised every time.
//!
//! ```text
//! K̂ u₁ + Σ_j v_j F_j(s_j) = w + p(u, u̇, ü),   s_j = v_jᵀ u₁ − r(x_j),   v_j = e(z_w) − N(x_j)
//! ```
//!
//! F(s) is the contact in series with the rail's local compliance, δ + c_loc F(δ) = s. Constant speed, one smooth or wavy
//! profile: what the comparisons need, written as plainly as possible.

use std::f64::consts::{PI, TAU};

use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_scenario::GRAVITY;
use ttb_scenario::spec::{BridgeSpec, Profile, TrainTrackSpec};
use ttb_scenario::types::{ContactLaw, RampShape, Tread};
use ttb_sparse::Assembly;

use crate::assembly::{Row, System};

/// Results over time, row 0 at t = 0.
#[derive(Clone, Debug, Default)]
pub struct History {
    /// Displacement of every monitored deck point, m.
    pub points: Vec<Vec<f64>>,
    /// Acceleration of every monitored deck point, m/s².
    pub point_accelerations: Vec<Vec<f64>>,
    /// Acceleration of every car body, m/s².
    pub cars: Vec<Vec<f64>>,
    /// Contact force of every axle, N.
    pub wheels: Vec<Vec<f64>>,
}

/// One axle: its degree of freedom, its distance behind the leading one, its static load.
struct Axle {
    dof: usize,
    offset: f64,
    load: f64,
}

/// Runs the whole case with steps of the specification's size.
///
/// # Errors
/// A case this plain solver does not know, or an iteration that does not converge.
pub fn run(spec: &TrainTrackSpec, bridge: &BridgeSpec) -> Result<History, String> {
    let system = System::new(spec, bridge)?;
    let axles = axles(spec);
    let (v, h) = (spec.speed[0][1], spec.step);
    let newmark = Newmark::new(spec.newmark.gamma, spec.newmark.beta, h);
    let weight = weight(spec, system.order);
    let statics = combine(&system, 0.0, 0.0);
    let dynamics = combine(&system, newmark.a[0], newmark.a[1]);

    let mut motion = Motion::rest(system.order);
    let contacts = place(&system, spec, &axles, 0.0)?;
    let mut forces = vec![0.0; axles.len()];
    solve(&statics, spec, &axles, &contacts, &weight, None, &mut motion.u, &mut forces)?;
    let points: Vec<Row> = bridge.points.iter().filter_map(|p| p.x).map(|x| system.deck_row(x)).collect();
    let mut history = History::default();
    record(&mut history, &points, &motion, &forces, spec.cars.len());
    for n in 1..=(spec.end / h).round() as usize {
        let contacts = place(&system, spec, &axles, v * n as f64 * h)?;
        let mut load = weight.clone();
        let terms = |f: &dyn Fn(f64, f64, f64) -> f64| -> Vec<f64> {
            (0..system.order).map(|i| f(motion.u[i], motion.v[i], motion.a[i])).collect()
        };
        system.m.multiply_add(&terms(&|u, v, a| newmark.inertia(u, v, a)), &mut load);
        system.c.multiply_add(&terms(&|u, v, a| newmark.damping(u, v, a)), &mut load);
        let mut next = motion.clone();
        solve(&dynamics, spec, &axles, &contacts, &load, Some(&motion.u), &mut next.u, &mut forces)?;
        newmark.finish_all(&motion, &mut next);
        motion = next;
        record(&mut history, &points, &motion, &forces, spec.cars.len());
    }
    Ok(history)
}

fn axles(spec: &TrainTrackSpec) -> Vec<Axle> {
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

fn weight(spec: &TrainTrackSpec, order: usize) -> Vec<f64> {
    let mut weight = vec![0.0; order];
    for (n, car) in spec.cars.iter().enumerate() {
        let masses = [(0, car.body_mass), (2, car.bogie_mass), (4, car.bogie_mass)];
        let wheels = (6..10).map(|i| (i, car.wheelset_mass));
        masses.into_iter().chain(wheels).for_each(|(i, m)| weight[10 * n + i] = GRAVITY * m);
    }
    weight
}

/// K + a_M M + a_C C as entries, ready for the contacts to be added.
fn combine(system: &System, a_m: f64, a_c: f64) -> Vec<(usize, usize, f64)> {
    let scaled = |matrix: &crate::assembly::Matrix, factor: f64| -> Vec<_> {
        matrix.0.iter().map(|(i, j, x)| (*i, *j, factor * x)).collect()
    };
    [scaled(&system.k, 1.0), scaled(&system.m, a_m), scaled(&system.c, a_c)].concat()
}

/// v_j without the wheel, c_loc and r of every axle after `run` metres.
fn place(system: &System, spec: &TrainTrackSpec, axles: &[Axle], run: f64) -> Result<Vec<(Row, f64, f64)>, String> {
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

fn roughness(profile: &Profile, x: f64) -> Result<f64, String> {
    let Profile::Waves { waves, origin, ramp } = profile else {
        return if *profile == Profile::None { Ok(0.0) } else { Err("the reference solver knows waves only".into()) };
    };
    let grown = ramp.as_ref().map_or(1.0, |ramp| {
        let s = ((x - ramp.start) / ramp.length).clamp(0.0, 1.0);
        match ramp.shape {
            RampShape::Cosine => 0.5 * (1.0 - (PI * s).cos()),
            RampShape::Quintic => s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s),
        }
    });
    Ok(grown * waves.iter().map(|w| w.amplitude * (TAU * (x - origin) / w.wavelength + w.phase).sin()).sum::<f64>())
}

/// F(s) and F′(s) of the contact in series with c_loc, by scalar Newton from the stiff side.
fn contact(spec: &TrainTrackSpec, load: f64, compliance: f64, s: f64) -> (f64, f64) {
    let (contact, r) = (&spec.contact, spec.contact.wheel_radius);
    let wheels = f64::from(contact.wheels_per_axle);
    let g = contact.hertz_constant.unwrap_or(match contact.tread {
        Tread::Worn => 3.86e-8 * r.powf(-0.115),
        Tread::Conical => 4.57e-8 * r.powf(-0.149),
    });
    let law = |delta: f64| match contact.law {
        ContactLaw::Hertz if delta > 0.0 => (wheels * (delta / g).powf(1.5), 1.5 * wheels * (delta / g).sqrt() / g),
        ContactLaw::Hertz => (0.0, 0.0),
        ContactLaw::Linear => {
            let (p, k) = (load / wheels, 1.5 * (load / wheels).cbrt() / g);
            let force = wheels * (p + k * (delta - g * p.powf(2.0 / 3.0)));
            if force > 0.0 { (force, wheels * k) } else { (0.0, 0.0) }
        }
    };
    let mut delta = s;
    for _ in 0..60 {
        let (force, slope) = law(delta);
        delta -= (delta + compliance * force - s) / (1.0 + compliance * slope);
    }
    let (force, slope) = law(delta);
    (force, slope / (1.0 + compliance * slope))
}

/// Newton on A u + Σ v F = load, from `start`; without one from every axle under its static load.
fn solve(
    entries: &[(usize, usize, f64)],
    spec: &TrainTrackSpec,
    axles: &[Axle],
    contacts: &[(Row, f64, f64)],
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

fn static_approach(spec: &TrainTrackSpec, load: f64, compliance: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1e-2);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if contact(spec, load, compliance, middle).0 < load { low = middle } else { high = middle }
    }
    low
}

fn record(history: &mut History, points: &[Row], motion: &Motion, forces: &[f64], cars: usize) {
    let push = |columns: &mut Vec<Vec<f64>>, values: Vec<f64>| {
        columns.resize(values.len(), Vec::new());
        columns.iter_mut().zip(values).for_each(|(c, x)| c.push(x));
    };
    let at = |row: &Row, of: &[f64]| row.iter().map(|(i, n)| n * of[*i]).sum::<f64>();
    push(&mut history.points, points.iter().map(|p| at(p, &motion.u)).collect());
    push(&mut history.point_accelerations, points.iter().map(|p| at(p, &motion.a)).collect());
    push(&mut history.cars, (0..cars).map(|c| motion.a[10 * c]).collect());
    push(&mut history.wheels, forces.to_vec());
}
