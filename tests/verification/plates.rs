//! Plates: natural frequencies, order of convergence, shear deformation.

use std::f64::consts::PI;

use ttb_elements::Plate;

use crate::COMMAND;
use crate::structure::*;
use ttb_record::{Table, order};

const SHAPES: [Shape; 3] = [Shape::Quad, Shape::Triangle, Shape::OtherTriangle];
const THIN: Plate = Plate { modulus: 2.1e11, poisson: 0.3, thickness: 1e-3, mass: 7.85 };

fn rigidity(plate: &Plate) -> f64 {
    plate.modulus * plate.thickness.powi(3) / (12.0 * (1.0 - plate.poisson * plate.poisson))
}

fn supported(shape: Shape, plate: Plate, n: usize, b: f64) -> Structure {
    let mut s = Structure::surface([n, n], shape, plate, |u, v| [u, b * v, 0.0]);
    s.hold(|_| true, &[X, Y, RZ]);
    s.hold(|p| p[0] == 0.0 || p[0] == 1.0, &[Z, RX]);
    s.hold(|p| p[1] == 0.0 || p[1] == b, &[Z, RY]);
    s
}

/// Simply supported 1 × 1.5: ω = π² (i²/a² + j²/b²) √(D/(ρt)); the error falls with h².
#[test]
fn supported_plate_frequencies() {
    let mut table = Table::new("simply supported plate 1 × 1.5, 16 × 16", "closed form (Leissa 1973); rad/s", COMMAND);
    let wave = |i: f64, j: f64| PI * PI * (i * i + j * j / 2.25) * (rigidity(&THIN) / THIN.mass).sqrt();
    let mut exact = [wave(1.0, 1.0), wave(1.0, 2.0), wave(2.0, 1.0), wave(1.0, 3.0), wave(2.0, 2.0)];
    exact.sort_by(f64::total_cmp);
    for shape in SHAPES {
        let computed = |n| supported(shape, THIN, n, 1.5).frequencies(5);
        let (coarse, fine) = (computed(8), computed(16));
        for (j, exact) in exact.iter().enumerate() {
            table.row(format!("{shape:?}, mode {}", j + 1), *exact, fine[j], 0.02);
        }
        let order = order(coarse[0] / exact[0] - 1.0, fine[0] / exact[0] - 1.0, 2.0);
        table.row(format!("{shape:?}, mode 1, order of convergence"), 2.0, order, 0.2);
    }
    table.finish();
}

/// Clamped along one edge: ω a² √(ρt/D) = 3.4917, 8.5246, 21.429, 27.331, 31.111 (Leissa, J. Sound Vib. 31, 1973, 257–293,
/// Ritz's upper bounds; also Barton 1951).
#[test]
fn cantilever_plate_frequencies() {
    let mut table = Table::new("square cantilever plate, 16 × 16", "Leissa 1973; ω a² √(ρt/D)", COMMAND);
    for shape in SHAPES {
        let mut s = Structure::surface([16, 16], shape, THIN, |u, v| [u, v, 0.0]);
        s.hold(|_| true, &[X, Y, RZ]);
        s.hold(|p| p[0] == 0.0, &[Z, RX, RY]);
        let scale = (THIN.mass / rigidity(&THIN)).sqrt();
        for (exact, computed) in [3.4917, 8.5246, 21.429, 27.331, 31.111].into_iter().zip(s.frequencies(5)) {
            table.row(format!("{shape:?}"), exact, computed * scale, 0.015);
        }
    }
    table.finish();
}

/// Thick simply supported square plate, t/a = 0.1, κ = 5/6, k² = π² (i² + j²)/a² (Mindlin, J. Appl. Mech. 18, 1951, 31–38):
/// D k⁴ − ω² [ρt + k² (ρt³/12 + ρt D/(κGt))] + ω⁴ ρt³/12 ρt/(κGt) = 0.
#[test]
fn thick_plate_frequencies() {
    let mut table =
        Table::new("thick simply supported plate, t/a = 0.1, 16 × 16", "Mindlin 1951, closed form; rad/s", COMMAND);
    let plate = Plate { modulus: 1.0, poisson: 0.3, thickness: 0.1, mass: 0.1 };
    let (d, shear) = (rigidity(&plate), 5.0 / 6.0 * 0.1 / 2.6);
    let (m, rotary) = (plate.mass, plate.mass * 0.01 / 12.0);
    for shape in SHAPES {
        let computed = supported(shape, plate, 16, 1.0).frequencies(4);
        for (computed, k2) in computed.into_iter().zip([2.0, 5.0, 5.0, 8.0].map(|s: f64| s * PI * PI)) {
            let (a, b, c) = (rotary * m / shear, m + k2 * (rotary + m * d / shear), d * k2 * k2);
            let exact = (2.0 * c / (b + (b * b - 4.0 * a * c).sqrt())).sqrt();
            table.row(format!("{shape:?}"), exact, computed, 0.02);
        }
    }
    table.finish();
}

/// Clamped square plate under uniform load, w = 0.00126532 q a⁴/D (Taylor & Govindjee, Commun. Numer. Methods Eng. 20,
/// 2004, 757–765), a = 2: the error falls with h².
#[test]
fn plate_deflection_converges_with_h_squared() {
    let mut table = Table::new("clamped square plate, uniform load", "Taylor & Govindjee 2004; m", COMMAND);
    let exact = 1.265_32e-3 * THIN.mass * 16.0 / rigidity(&THIN);
    for shape in SHAPES {
        let computed = |n| {
            let mut s = Structure::surface([n, n], shape, THIN, |u, v| [u, v, 0.0]);
            s.hold(|_| true, &[X, Y, RZ]);
            s.hold(|p| p[0] == 0.0, &[RY]);
            s.hold(|p| p[1] == 0.0, &[RX]);
            s.hold(|p| p[0] == 1.0 || p[1] == 1.0, &[Z, RX, RY]);
            s.push_like_mass(Z, 1.0);
            s.solve()[0][Z]
        };
        let [coarse, middle, fine] = [8, 16, 32].map(computed);
        table.row(format!("{shape:?}, 16 × 16 a quarter"), exact, middle, 0.01);
        // From differences: the error on the finest mesh is near the reference's last digits.
        table.row(format!("{shape:?}, order of convergence"), 2.0, order(coarse - middle, middle - fine, 2.0), 0.15);
    }
    table.finish();
}
