//! Curved shells and Cook's membrane.

use std::f64::consts::FRAC_PI_2;

use ttb_elements::Plate;

use crate::structure::*;
use crate::table::Table;

const SHAPES: [Shape; 3] = [Shape::Quad, Shape::Triangle, Shape::OtherTriangle];

/// Scordelis–Lo roof: R = 25, L = 50, t = 0.25, 80°, E = 4.32e8, ν = 0, 90 per area; the free edge sinks by 0.3024.
fn roof(shape: Shape, n: usize) -> f64 {
    let plate = Plate { modulus: 4.32e8, poisson: 0.0, thickness: 0.25, mass: 90.0 };
    let angle = 40.0_f64.to_radians();
    // x along the axis from the middle to the diaphragm, crown at y = 0.
    let mut s = Structure::surface([n, n], shape, plate, |u, v| {
        [25.0 * u, 25.0 * (angle * v).sin(), 25.0 - 25.0 * (angle * v).cos()]
    });
    s.hold(|p| p[0] == 25.0, &[Y, Z]);
    s.hold(|p| p[0] == 0.0, &[X, RY, RZ]);
    s.hold(|p| p[1] == 0.0, &[Y, RX, RZ]);
    s.push_like_mass(Z, 1.0);
    s.solve()[n * (n + 1)][Z]
}

#[test]
fn scordelis_lo_roof() {
    let mut table = Table::new("Scordelis–Lo roof", "MacNeal & Harder 1985");
    for shape in SHAPES {
        for n in [4, 8, 16, 32] {
            table.row(format!("{shape:?} {n}"), 0.3024, roof(shape, n), 0.03);
        }
    }
    table.finish();
}

/// R = 300, L = 600, t = 3, E = 3e6, ν = 0.3, P = 1 with end diaphragms; an eighth.
#[test]
fn pinched_cylinder() {
    let mut table = Table::new("pinched cylinder", "1.8248e-5");
    let plate = Plate { modulus: 3e6, poisson: 0.3, thickness: 3.0, mass: 0.0 };
    for shape in SHAPES {
        for n in [4, 8, 16, 32] {
            let mut s = Structure::surface([n, n], shape, plate, |u, v| {
                [300.0 * u, 300.0 * (FRAC_PI_2 * v).sin(), -300.0 * (FRAC_PI_2 * v).cos()]
            });
            s.hold(|p| p[0] == 300.0, &[Y, Z]);
            s.hold(|p| p[0] == 0.0, &[X, RY, RZ]);
            s.hold(|p| p[1] == 0.0, &[Y, RX, RZ]);
            s.hold(|p| p[2].abs() < 1e-9, &[Z, RX, RY]);
            s.push(0, Z, 0.25);
            table.row(format!("{shape:?} {n}"), 1.8248e-5, s.solve()[0][Z], if n < 16 { 0.5 } else { 0.05 });
        }
    }
    table.finish();
}

/// R = 10, t = 0.04, hole of 18°, E = 6.825e7, ν = 0.3, F = 2; a quarter.
#[test]
fn hemisphere() {
    let mut table = Table::new("hemisphere", "MacNeal & Harder 1985: 0.0940");
    let plate = Plate { modulus: 6.825e7, poisson: 0.3, thickness: 0.04, mass: 0.0 };
    for shape in SHAPES {
        for n in [4, 8, 16, 32] {
            let mut s = Structure::surface([n, n], shape, plate, |u, v| {
                let (a, b) = (FRAC_PI_2 * u, 72.0_f64.to_radians() * v);
                [10.0 * a.cos() * b.cos(), 10.0 * a.sin() * b.cos(), 10.0 * b.sin()]
            });
            s.hold(|p| p[1].abs() < 1e-9, &[Y, RX, RZ]);
            s.hold(|p| p[0].abs() < 1e-9, &[X, RY, RZ]);
            s.prescribe(0, Z, 0.0);
            s.push(0, X, 1.0);
            s.push(n, Y, -1.0);
            table.row(format!("{shape:?} {n}"), 0.0940, s.solve()[0][X], if n < 16 { 0.5 } else { 0.05 });
        }
    }
    table.finish();
}

/// Cook, J. Struct. Div. ASCE 100, 1974, 1851–1863; 23.96.
#[test]
fn cooks_membrane() {
    let mut table = Table::new("Cook's membrane", "23.96");
    let plate = Plate { modulus: 1.0, poisson: 1.0 / 3.0, thickness: 1.0, mass: 0.0 };
    for shape in SHAPES {
        for n in [2, 4, 8, 16, 32] {
            let mut s =
                Structure::surface([n, n], shape, plate, |u, v| [48.0 * u, 44.0 * u + v * (44.0 - 28.0 * u), 0.0]);
            s.hold(|_| true, &[Z, RX, RY]);
            s.hold(|p| p[0] == 0.0, &ALL);
            for j in 0..=n {
                let share = if j == 0 || j == n { 0.5 } else { 1.0 };
                s.push(j * (n + 1) + n, Y, share / n as f64);
            }
            table.row(format!("{shape:?} {n}"), 23.96, s.solve()[n / 2 * (n + 1) + n][Y], 0.1);
        }
    }
    table.finish();
}
