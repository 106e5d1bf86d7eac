//! Where cars begin to hunt on rigid rails: eigenvalues of the linearised system, and the growth of time steps.

use nalgebra::DMatrix;
use ttb_scenario::spec::{SpaceBody, SpaceLink};
use ttb_train_track::space::axle::{PORTS, Place};
use ttb_train_track::space::car::{AXLES, Car, DOFS, FIRST_WHEELSET, OF_BODY};
use ttb_wheel_rail::contact::{Contact, Settings};
use ttb_wheel_rail::creep::Creep;
use ttb_wheel_rail::geometry::{Geometry, Pairing, of_profiles};
use ttb_wheel_rail::hertz::Material;
use ttb_wheel_rail::kalker::Coefficients;
use ttb_wheel_rail::profile::rail::{Placed, r60e1};
use ttb_wheel_rail::profile::wheel;

use super::alone::{Alone, depth, lever};
use super::*;

/// Largest growth 1/s of the oscillations of a car with the given loads of its wheels, and its frequency, Hz.
fn growth(car: &Car, contact: &Contact, load: f64, speed: f64) -> (f64, f64) {
    let place = Place { speed, ..Place::default() };
    let mut s = [0.0; PORTS];
    // r is linear between the nodes of the table: a touch beside D = 0 one wheel sees the interval before it, the other one
    // that behind it, and both together the slope there.
    (s[0], s[1]) = (1e-9, depth(car, contact, load));
    let [by_s, by_v] = lever(car).gradients(contact, &s, &[0.0; PORTS], &place);
    let (mut k, mut c) = (car.stiffness.clone(), car.damping_at(speed));
    for axle in 0..AXLES {
        let dof = FIRST_WHEELSET + OF_BODY * axle;
        for i in 0..OF_BODY {
            for j in 0..OF_BODY {
                k[(dof + i, dof + j)] -= by_s[i][j];
                c[(dof + i, dof + j)] -= by_v[i][j];
            }
        }
    }
    // (q, q̇/100) over time: entries of like size.
    // Straight ahead, y, φ and ψ do not know z and θ.
    let lateral: Vec<usize> = (0..DOFS).filter(|dof| matches!(dof % OF_BODY, 0 | 2 | 4)).collect();
    let n = lateral.len();
    let a = DMatrix::from_fn(2 * n, 2 * n, |i, j| match i.checked_sub(n) {
        None => 100.0 * f64::from(u8::from(j == i + n)),
        Some(i) => {
            let (row, column) = (lateral[i], lateral[j % n]);
            if j < n { -k[(row, column)] / (100.0 * car.mass[row]) } else { -c[(row, column)] / car.mass[row] }
        }
    });
    let mut most = (f64::NEG_INFINITY, 0.0);
    for value in a.complex_eigenvalues().iter().filter(|value| value.im > 2.0 && value.im < 100.0) {
        if value.re > most.0 {
            most = (value.re, value.im / std::f64::consts::TAU);
        }
    }
    most
}

/// The speed where a car begins to hunt, m/s.
fn critical(car: &Car, contact: &Contact, load: f64, [mut low, mut high]: [f64; 2]) -> f64 {
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if growth(car, contact, load, middle).0 < 0.0 { low = middle } else { high = middle }
    }
    low
}

pub fn settings(creep: Creep) -> Settings {
    Settings { radius: 0.46, material: Material::STEEL, hertz_constant: None, kalker: None, friction: 0.3, creep }
}

/// Four wheelsets that do not know each other, on springs to bodies that do not move.
fn wheelsets(k_y: f64, k_psi: f64, spin_inertia: f64) -> Car {
    let body = |mass: f64, inertia| SpaceBody { mass, inertia, x: 0.0, height: 0.46 };
    let mut bodies = vec![body(1e15, [1e15; 3]); 3];
    bodies.extend(vec![body(1813.0, [1120.0, spin_inertia, 1120.0]); 4]);
    let mut links = Vec::new();
    for axle in 3..7 {
        let between = [0, axle];
        let at = [[0.0; 3]; 2];
        let law = LinkLaw::Linear { stiffness: [0.0, k_y, 0.0], damping: [0.0; 3] };
        links.push(SpaceLink { between, at, law });
        links.push(SpaceLink { between, at, law: LinkLaw::Rotation { axis: 2, stiffness: k_psi, damping: 0.0 } });
    }
    Car::new(&SpaceCar { wheel_radius: 0.46, bodies, links }).unwrap()
}

fn cone(sloped: bool, c23: f64) -> Contact {
    let kalker = Some(Coefficients { c11: 4.2, c22: 3.7, c23 });
    let settings = Settings { hertz_constant: Some(4.22e-8), kalker, ..settings(Creep::Linear) };
    Contact::new(Geometry::cone(0.05, 0.75, 1.0 / 0.3, sloped), &settings).unwrap()
}

/// The closed form for a wheelset on a kinematic cone, and an independent program's full linearisation with more of it.
#[test]
fn a_wheelset_begins_to_hunt_where_it_is_known_to() {
    let (k_y, k_psi, load) = (3.884e5, 1.25564e6, 1e5);
    let source = "independent program's full linearisation; the closed form for the first is 68.1906 m/s";
    let mut table = Table::new("a wheelset on springs begins to hunt, m/s", source, crate::COMMAND);
    for (name, contact, spin, expected) in [
        ("kinematic cone", cone(false, 0.0), 1e-9, 68.1894),
        ("with contact angle", cone(true, 0.0), 1e-9, 68.851),
        ("with spin creepage", cone(true, 1.5), 1e-9, 68.578),
        ("with gyroscopic moment", cone(true, 1.5), 112.0, 70.449),
    ] {
        table.row(name, expected, critical(&wheelsets(k_y, k_psi, spin), &contact, load, [50.0, 90.0]), 8.5e-6);
    }
    table.finish();
}

/// An independent program's values: linear creep on rigid rails; cones with the curvature of the rail's head alone.
#[test]
fn whole_cars_begin_to_hunt_where_they_are_known_to() {
    let rail = Placed::new(r60e1().unwrap(), 0.025, 1435.0).unwrap();
    let mut table = Table::new("cars begin to hunt on rigid rails", "independent program", crate::COMMAND);
    for (name, conicity, car, expected, frequency) in [
        ("manchester, S1002", None, "manchester", 72.10, 5.82),
        ("manchester, cone 1:20", Some(0.05), "manchester", 95.99, 3.00),
        ("manchester, cone 1:40", Some(0.025), "manchester", 101.70, 2.18),
        ("emu-a, S1002", None, "emu-a", 151.19, 6.22),
    ] {
        let pairing = Pairing { spacing: 0.005, reach: 1.0, ..Pairing::default() };
        let profiles = || of_profiles(&wheel::s1002().unwrap(), &rail, &pairing).unwrap();
        let geometry = conicity.map_or_else(profiles, |cone| Geometry::cone(cone, 0.75, 1.0 / 0.3, true));
        let car = Car::new(&of_benchmark(car)).unwrap();
        let contact = Contact::new(geometry, &Settings { radius: car.radius, ..settings(Creep::Linear) }).unwrap();
        let load = car.weight.iter().sum::<f64>() / 4.0;
        let [below, above] = [0.997, 1.003].map(|factor| growth(&car, &contact, load, factor * expected));
        let speed = expected * (0.997 - 0.006 * below.0 / (above.0 - below.0));
        table.row(format!("{name}: speed, m/s"), expected, speed, 1.2e-3);
        table.row(format!("{name}: frequency, Hz"), frequency, below.1, 5e-3);
    }
    table.finish();
}

/// Growth of 1 ms steps 2 % below and above the critical speed.
#[test]
fn time_steps_grow_and_decay_as_the_eigenvalues_say() {
    let mut table =
        Table::new("growth of a wheelset's hunting in steps of 1 ms, 1/s", "independent program", crate::COMMAND);
    for (factor, expected) in [(0.98, -0.17973), (1.02, 0.18643)] {
        let car = wheelsets(3.884e5, 1.25564e6, 1e-6);
        let mut alone = Alone::wheelsets(car, cone(false, 0.0), factor * 68.1906, 0.0, 1e5, 1e-5);
        // Highest points, by the parabola through three steps.
        let (mut before, mut here, mut peaks) = (0.0, alone.y(), Vec::new());
        for n in 1..8000 {
            alone.advance();
            let after = alone.y();
            if here > before && here >= after && here > 0.0 && n > 2000 {
                let (slope, bend) = (0.5 * (after - before), after - 2.0 * here + before);
                peaks.push((1e-3 * (f64::from(n) - slope / bend), here - 0.5 * slope * slope / bend));
            }
            (before, here) = (here, after);
        }
        let ((t0, first), (t1, last)) = (peaks[0], peaks[peaks.len() - 1]);
        let growth = (last / first).ln() / (t1 - t0);
        table.row(format!("at {factor} of the critical speed"), expected, growth, 2e-5 / expected.abs());
    }
    table.finish();
}

/// L = 2π√(r0 a/λ) = 16.5046 m.
fn wavelength() -> f64 {
    let mut alone = Alone::wheelsets(wheelsets(0.0, 0.0, 1e-6), cone(false, 0.0), 10.0, 0.0, 1e5, 1e-3);
    let mut crossings = Vec::new();
    let mut before = alone.y();
    for n in 1..6000 {
        alone.advance();
        let y = alone.y();
        if before > 0.0 && y <= 0.0 {
            crossings.push(1e-3 * (f64::from(n) - y / (y - before)));
        }
        before = y;
    }
    10.0 * (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64
}

/// y = r0 a/(λR) outwards: a free wheelset in a curve to the right stands to the left and stays there.
#[test]
fn a_free_wheelset_runs_in_klingels_waves_and_rolls_without_creep_through_a_curve() {
    let source = "independent program, Klingel's closed form 16.5046 m; pure rolling, y = r0 a/λR, R = 1000 m";
    let mut table = Table::new("free wheelset on a cone", source, crate::COMMAND);
    table.row("wavelength at 10 m/s, m", 16.5053, wavelength(), 6e-5);
    let expected = -0.46 * 0.75 / (0.05 * 1000.0);
    let mut alone = Alone::wheelsets(wheelsets(0.0, 0.0, 1e-6), cone(false, 0.0), 10.0, 1e-3, 1e5, expected);
    for _ in 0..2000 {
        alone.advance();
        assert!((alone.y() / expected - 1.0).abs() < 1e-6, "{}", alone.y());
    }
    table.row("place in a curve to the right after 2 s, mm", 1e3 * expected, 1e3 * alone.y(), 1e-6);
    table.finish();
}
