//! Derivatives against differences, Nadal's limit, and what energy forbids.

use super::*;
use crate::geometry::{Pairing, of_profiles};
use crate::profile::rail::{Placed, r60e1};
use crate::profile::wheel::s1002;

const SETTINGS: Settings = Settings {
    radius: 0.46,
    material: Material::STEEL,
    hertz_constant: None,
    kalker: None,
    friction: 0.3,
    creep: Creep::Shen,
};
const RUNNING: Running = Running { speed: 40.0, curvature: 1e-3 };

fn geometry() -> Geometry {
    static MADE: std::sync::OnceLock<Geometry> = std::sync::OnceLock::new();
    MADE.get_or_init(make).clone()
}

fn make() -> Geometry {
    let rail = Placed::new(r60e1().unwrap(), 1.0 / 40.0, 1435.0).unwrap();
    of_profiles(&s1002().unwrap(), &rail, &Pairing::default()).unwrap()
}

fn contact(change: impl Fn(&mut Settings)) -> Contact {
    let mut settings = SETTINGS;
    change(&mut settings);
    Contact::new(geometry(), &settings).unwrap()
}

/// A wheel pressed by about 80 µm at D.
fn motion(contact: &Contact, d: f64) -> Motion {
    let nearest = Region::ALL.map(|region| contact.geometry().region(region).distance(d)[0]);
    [d, nearest[0].min(nearest[1]) + 80e-6, 1e-6, 0.02, 0.01, 1e-3, 0.05, 0.02]
}

#[test]
fn derivatives_are_those_of_the_forces() {
    let steps = [1e-9, 1e-9, 1e-9, 1e-5, 1e-5, 1e-8, 1e-6, 1e-6];
    for creep in [Creep::Shen, Creep::Linear, Creep::None, Creep::Fastsim] {
        let contact = contact(|settings| settings.creep = creep);
        // Between nodes: the table's straight lines have no kink there. 6.5 mm: both regions carry.
        for d in [-2.01e-3, 0.51e-3, 6.51e-3, 8.012e-3] {
            let at = motion(&contact, d);
            let mut gradient = [[0.0; 8]; 6];
            let forces = contact.forces_and_gradient(&at, RUNNING, &mut gradient);
            assert_eq!(forces, contact.forces(&at, RUNNING));
            for (j, step) in steps.into_iter().enumerate() {
                let moved = |by: f64| {
                    let mut motion = at;
                    motion[j] += by;
                    contact.forces(&motion, RUNNING)
                };
                let (before, after) = (moved(-step), moved(step));
                for i in 0..6 {
                    let numeric = (after[i] - before[i]) / (2.0 * step);
                    let size = gradient[i].iter().zip(steps).map(|(g, s)| (g * s).abs()).fold(0.0, f64::max) / step;
                    let tolerance = if creep == Creep::Fastsim { 0.02 } else { 2e-5 };
                    let miss = (numeric - gradient[i][j]).abs();
                    assert!(
                        miss <= tolerance * (size + gradient[i][j].abs()) + 1e-3,
                        "{creep:?} D {d}: dF{i}/dx{j} is {} and not {numeric}",
                        gradient[i][j]
                    );
                }
            }
        }
    }
}

/// Nadal: full slip up the flange.
#[test]
fn a_flange_that_slips_upwards_has_nadals_ratio() {
    for friction in [0.1, 0.25, 0.3, 0.36] {
        let contact = contact(|settings| settings.friction = friction);
        // Beyond the play, pressed on the flange alone, as if it ran up: friction holds the wheel up.
        let d = 7.5e-3;
        let g = contact.geometry().region(Region::Flange).distance(d);
        let motion = [d, g[0] + 30e-6, 0.0, 0.0, 0.0, 0.0, -40.0, 0.0];
        let [tread, flange] = contact.patches(&motion, Running { speed: 40.0, curvature: 0.0 });
        assert_eq!(tread.normal, 0.0);
        let tan = -g[1];
        let limit = (tan - friction) / (1.0 + friction * tan);
        // Spin leaves a trace of ξ_x of none; the ratio is exact when T = μN along y.
        assert!((flange.tangential - friction * flange.normal).abs() < 1e-4 * flange.normal, "{flange:?}");
        let ratio = flange.across / flange.down;
        let direction = flange.along.hypot(flange.tangential) / flange.tangential.abs();
        assert!((ratio - limit).abs() < 1e-3 * direction, "μ = {friction}: {ratio} instead of {limit}");
    }
    let nadal = |friction: f64| {
        let tan = 70_f64.to_radians().tan();
        (tan - friction) / (1.0 + friction * tan)
    };
    for (friction, limit) in [(0.36, 1.2003), (0.3, 1.3416), (0.25, 1.4805)] {
        assert!((nadal(friction) - limit).abs() < 5e-5);
    }
}

#[test]
fn creep_without_spin_takes_power_from_the_wheel() {
    let mut contact = contact(|settings| settings.kalker = Some(Coefficients { c11: 4.0, c22: 3.7, c23: 0.0 }));
    for creep in [Creep::Shen, Creep::Linear] {
        contact.set_creep(creep);
        for i in 0..200 {
            let x = f64::from(i);
            let mut motion = motion(&contact, 7e-3 * (0.71 * x).sin());
            motion[3] = 0.2 * (1.3 * x).sin();
            motion[5] = 4e-3 * (2.1 * x).cos();
            motion[6] = 0.2 * (0.37 * x).cos();
            for patch in contact.patches(&motion, RUNNING) {
                let power = patch.along * patch.creepages[0] + patch.tangential * patch.creepages[1];
                assert!(power <= 0.0, "{patch:?}");
            }
        }
    }
}

/// With constant G and γ the normal force has a potential: no work around a closed path in (D, ζ).
#[test]
fn normal_forces_do_no_work_around_a_closed_path() {
    const POINTS: usize = 4000;
    let settings = Settings { creep: Creep::None, hertz_constant: Some(4.5e-8), ..SETTINGS };
    let contact = Contact::new(Geometry::cone(0.3, 0.75, 2.0, true), &settings).unwrap();
    let (mut work, mut turned_over) = (0.0, 0.0);
    let place = |i: usize| {
        let angle = std::f64::consts::TAU * i as f64 / POINTS as f64;
        let d = 0.3e-3 * angle.cos();
        [d, contact.geometry().region(Region::Tread).distance(d)[0] + 60e-6 + 30e-6 * angle.sin()]
    };
    for i in 0..POINTS {
        let ([d0, z0], [d1, z1]) = (place(i), place(i + 1));
        let f = contact.forces(&[0.5 * (d0 + d1), 0.5 * (z0 + z1), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], RUNNING);
        let step = f[0] * (d1 - d0) + f[1] * (z1 - z0);
        (work, turned_over) = (work + step, turned_over + step.abs());
    }
    assert!(work.abs() < 1e-9 * turned_over, "{work} of {turned_over} J");
}

#[test]
fn a_wheel_in_the_air_has_no_force_and_no_derivative() {
    let contact = contact(|_| ());
    let mut motion = motion(&contact, 0.3e-3);
    motion[1] -= 1e-3;
    let mut gradient = [[1.0; 8]; 6];
    assert_eq!(contact.forces_and_gradient(&motion, RUNNING, &mut gradient), [0.0; 6]);
    assert_eq!(gradient, [[0.0; 8]; 6]);
    motion[1] = f64::NAN;
    assert!(contact.forces(&motion, RUNNING)[1].is_nan());
}

#[test]
fn settings_without_sense_are_refused_with_their_value() {
    let bad = |change: fn(&mut Settings)| {
        let mut settings = SETTINGS;
        change(&mut settings);
        Contact::new(Geometry::cone(0.05, 0.75, 2.0, true), &settings).unwrap_err()
    };
    assert!(bad(|s| s.radius = 0.0).contains("rolling radius"));
    assert!(bad(|s| s.friction = f64::NAN).contains("friction"));
    assert!(bad(|s| s.material.poisson = 0.7).contains("0.7"));
}
