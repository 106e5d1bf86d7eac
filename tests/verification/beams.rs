//! Beams, trusses and cables against closed forms.

use std::f64::consts::PI;

use ttb_elements::{Beam3, BeamSection, Truss3};

use crate::COMMAND;
use crate::structure::*;
use ttb_record::{Table, order};

const LENGTH: f64 = 8.0;
/// Axes 1, 2, 3 of the inclined beam are x, y, z turned.
const SECTION: BeamSection = BeamSection {
    modulus: 2.1e11,
    shear_modulus: 8e10,
    density: 7850.0,
    area: 0.08,
    inertia_2: 1.2e-3,
    inertia_3: 4e-4,
    torsion: 6e-4,
    shear_area_2: None,
    shear_area_3: None,
    added_mass: 0.0,
};
const THICK: BeamSection = BeamSection { shear_area_2: Some(0.04), shear_area_3: Some(0.03), ..SECTION };

/// `n` elements along `direction` (unit).
fn beam(n: usize, direction: [f64; 3], orientation: [f64; 3], section: BeamSection) -> Structure {
    let nodes = (0..=n).map(|i| direction.map(|d| d * LENGTH * i as f64 / n as f64)).collect();
    let mut s = Structure::new(nodes);
    for i in 0..n {
        let ends = [s.nodes[i], s.nodes[i + 1]];
        let element = Beam3::new(ends, orientation, section, [[0.0; 3]; 2], [[false; 3]; 2]).unwrap();
        s.element(&[i, i + 1], element.matrices());
    }
    s
}

fn along_x(n: usize, section: BeamSection, hold: &[usize], ends: &[usize]) -> Structure {
    let mut s = beam(n, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], section);
    s.hold(|_| true, hold);
    s.hold(|p| p[0] == 0.0 || p[0] == LENGTH, ends);
    s
}

/// Simply supported, both planes: ω = (jπ/l)² √(EI/m); errors fall with h⁴ (Strang & Fix, An Analysis of the Finite Element
/// Method, 1973).
#[test]
fn euler_bernoulli_frequencies() {
    let mut table = Table::new("Euler–Bernoulli beam, simply supported", "closed form; rad/s", COMMAND);
    for (name, inertia, hold, across) in
        [("1–3", SECTION.inertia_2, [X, Y, RX, RZ], Z), ("1–2", SECTION.inertia_3, [X, Z, RX, RY], Y)]
    {
        let computed = |n| along_x(n, SECTION, &hold, &[across]).frequencies(3);
        let (coarse, fine) = (computed(6), computed(12));
        for j in 0..3 {
            let k = (j + 1) as f64 * PI / LENGTH;
            let exact = k * k * (2.1e11 * inertia / (7850.0 * 0.08)).sqrt();
            table.row(format!("plane {name}, mode {}, 12 elements", j + 1), exact, fine[j], 1e-3);
            let order = order(coarse[j] / exact - 1.0, fine[j] / exact - 1.0, 2.0);
            table.row(format!("plane {name}, mode {}, order of convergence", j + 1), 4.0, order, 0.05);
        }
    }
    table.finish();
}

/// Timoshenko, simply supported, k = jπ/l (Timoshenko, Phil. Mag. 43, 1922, 125–131):
/// EI k⁴ − ω² [m + k² (ρI + m EI/(κGA))] + ω⁴ ρI m/(κGA) = 0.
/// Errors fall with h²: the shapes hold the shear strain constant in each element.
#[test]
fn timoshenko_frequencies() {
    let mut table = Table::new("Timoshenko beam, simply supported", "closed form; rad/s", COMMAND);
    for (name, inertia, area, hold, across) in
        [("1–3", THICK.inertia_2, 0.03, [X, Y, RX, RZ], Z), ("1–2", THICK.inertia_3, 0.04, [X, Z, RX, RY], Y)]
    {
        let computed = |n| along_x(n, THICK, &hold, &[across]).frequencies(3);
        let (coarse, fine) = (computed(32), computed(64));
        for j in 0..3 {
            let k = (j + 1) as f64 * PI / LENGTH;
            let (ei, ga, m, rho_i) = (2.1e11 * inertia, 8e10 * area, 7850.0 * 0.08, 7850.0 * inertia);
            let (a, b, c) = (rho_i * m / ga, m + k * k * (rho_i + m * ei / ga), ei * k.powi(4));
            let exact = (2.0 * c / (b + (b * b - 4.0 * a * c).sqrt())).sqrt();
            table.row(format!("plane {name}, mode {}, 64 elements", j + 1), exact, fine[j], 1e-3);
            let order = order(coarse[j] / exact - 1.0, fine[j] / exact - 1.0, 2.0);
            table.row(format!("plane {name}, mode {}, order of convergence", j + 1), 2.0, order, 0.05);
        }
    }
    table.finish();
}

/// Fixed–free: ω = (2j − 1)π/(2l) √(E/ρ) along, √(GJ/(ρ(I₂+I₃))) about; errors fall with h².
#[test]
fn axial_and_torsional_frequencies() {
    let mut table = Table::new("bar and shaft, fixed–free", "closed form; rad/s", COMMAND);
    let wave = [(2.1e11_f64 / 7850.0).sqrt(), (8e10_f64 * 6e-4 / (7850.0 * 1.6e-3)).sqrt()];
    for (name, hold, wave) in [("axial", [Y, Z, RX, RY, RZ], wave[0]), ("torsion", [X, Y, Z, RY, RZ], wave[1])] {
        let computed = |n| {
            let mut s = along_x(n, SECTION, &hold, &[]);
            s.hold(|p| p[0] == 0.0, &ALL);
            s.frequencies(2)
        };
        let (coarse, fine) = (computed(16), computed(32));
        for j in 0..2 {
            let exact = (2 * j + 1) as f64 * PI / (2.0 * LENGTH) * wave;
            table.row(format!("{name}, mode {}, 32 elements", j + 1), exact, fine[j], 2e-3);
            let order = order(coarse[j] / exact - 1.0, fine[j] / exact - 1.0, 2.0);
            table.row(format!("{name}, mode {}, order of convergence", j + 1), 2.0, order, 0.05);
        }
    }
    table.finish();
}

/// A cantilever inclined in space, nothing held but its root: (1.875104², 4.694091²)/l² √(EI/m) in both planes.
#[test]
fn inclined_cantilever_frequencies() {
    let mut table = Table::new("inclined cantilever", "closed form (Blevins 1979, table 8-1); rad/s", COMMAND);
    let mut s = beam(16, [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0], [0.3, 0.9, 0.1], SECTION);
    s.hold(|p| p[0] == 0.0, &ALL);
    let computed = s.frequencies(4);
    let mut exact: Vec<f64> = [SECTION.inertia_2, SECTION.inertia_3]
        .iter()
        .flat_map(|i| [1.875_104_f64, 4.694_091].map(|l| (l / LENGTH).powi(2) * (2.1e11 * i / 628.0).sqrt()))
        .collect();
    exact.sort_by(f64::total_cmp);
    for (j, (exact, computed)) in exact.iter().zip(computed).enumerate() {
        table.row(format!("mode {}", j + 1), *exact, computed, 1e-4);
    }
    table.finish();
}

/// Tip of a cantilever: P l³/(3EI) + P l/(κGA), exact with one element.
#[test]
fn timoshenko_cantilever() {
    let mut table = Table::new("Timoshenko cantilever, tip deflection", "closed form; m", COMMAND);
    for (motion, inertia, area) in [(Y, THICK.inertia_3, 0.04), (Z, THICK.inertia_2, 0.03)] {
        for n in [1, 5] {
            let mut s = beam(n, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], THICK);
            s.hold(|p| p[0] == 0.0, &ALL);
            s.push(n, motion, 1e5);
            let exact = 1e5 * (LENGTH.powi(3) / (3.0 * 2.1e11 * inertia) + LENGTH / (8e10 * area));
            let name = if motion == Y { "1–2" } else { "1–3" };
            table.row(format!("plane {name}, {n} elements"), exact, s.solve()[n][motion], 1e-9);
        }
    }
    table.finish();
}

/// Chord stiffness of a level cable between supports a span L apart (elastic catenary, Irvine, Cable Structures, 1981), S₀ its length without stress, w its weight:
///
/// ```text
/// L(H) = H S₀/(EA) + (2H/w) asinh(w S₀/(2H)),   k = 1/(dL/dH)
/// ```
#[test]
fn cable_stiffness() {
    let mut table = Table::new("cable: Ernst's modulus against the elastic catenary", "Irvine 1981; N/m", COMMAND);
    let (modulus, area, mass, unstressed): (f64, f64, f64, f64) = (1.65e11, 5e-3, 39.25, 150.0);
    let w = mass * ttb_contract::GRAVITY;
    for stress in [1e8, 2e8, 4e8] {
        let h = stress * area;
        let r = 0.5 * w * unstressed / h;
        let span = h * unstressed / (modulus * area) + 2.0 * h / w * r.asinh();
        let flexibility = unstressed / (modulus * area) + 2.0 / w * (r.asinh() - r / (1.0 + r * r).sqrt());
        let ends = [[0.0; 3], [span, 0.0, 0.0]];
        let cable = Truss3::cable(ends, [0.0, 0.0, 1.0], modulus, area, mass, h).unwrap();
        table.row(format!("{:.0} N/mm²", 1e-6 * stress), 1.0 / flexibility, cable.matrices().k[0], 0.01);
    }
    table.finish();
}
