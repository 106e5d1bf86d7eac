//! S1002 on 60E1 against the table of an independent program, ε = 20 µm.

use super::*;
use crate::conicity::equivalent_conicity;
use crate::profile::rail::{Placed, r60e1};
use crate::profile::spline::through;
use crate::profile::wheel::{cone, s1002};

fn table(gauge: f64, softness: f64) -> Geometry {
    let rail = Placed::new(r60e1().unwrap(), 1.0 / 40.0, gauge).unwrap();
    of_profiles(&s1002().unwrap(), &rail, &Pairing { softness, ..Pairing::default() }).unwrap()
}

/// D mm: g mm, g′, u_c mm, r − r0 mm, B₂ 1/m.
const REFERENCE: [[f64; 6]; 9] = [
    [-4.0, 0.0720, -0.01117, 757.17, -0.2170, 2.602],
    [-2.0, 0.0458, -0.01598, 755.74, -0.1675, 1.771],
    [0.0, 0.0, -0.03418, 750.66, 0.0234, 1.228],
    [1.0, -0.0442, -0.05498, 745.73, 0.2720, 2.494],
    [2.0, -0.1091, -0.07390, 742.35, 0.5207, 4.396],
    [3.0, -0.1905, -0.08847, 740.65, 0.7263, 5.320],
    [4.0, -0.2864, -0.10402, 739.30, 0.9506, 5.091],
    [5.0, -0.4028, -0.14031, 736.62, 1.4402, 4.969],
    [6.0, -0.6834, -0.39180, 725.71, 4.0509, 27.08],
];

#[test]
fn the_tread_of_s1002_on_60e1_has_the_values_of_an_independent_program() {
    let table = table(1435.0, 0.02);
    let tread = table.region(Region::Tread);
    for [d, g, slope, across, radius, curvature] in REFERENCE {
        let d = 1e-3 * d;
        let [own, own_slope, _] = tread.distance(d);
        let row = [1e3 * own, own_slope, 1e3 * tread.across(d), 1e3 * tread.radius_change(d), tread.curvature(d)];
        // Half of the last digit, and what 1.5 µm of D change: that program puts the rail's points elsewhere by as much.
        let rounding = [0.5e-4, 0.5e-5, 0.005, 0.5e-4];
        let step = 1e-5;
        let moved = [
            1e3 * tread.distance(d + step)[0],
            tread.distance(d + step)[1],
            1e3 * tread.across(d + step),
            1e3 * tread.radius_change(d + step),
        ];
        for (k, expected) in [g, slope, across, radius].into_iter().enumerate() {
            let tolerance = rounding[k] + 0.15 * (moved[k] - row[k]).abs();
            assert!((row[k] - expected).abs() < tolerance, "D = {d}: {} instead of {expected}", row[k]);
        }
        // Curvatures jump where sections of the profile meet; there it takes differences.
        assert!((row[4] / curvature - 1.0).abs() < 0.05, "D = {d}: B₂ {} instead of {curvature}", row[4]);
    }
}

#[test]
fn the_slope_is_the_derivative_of_the_distance() {
    let table = table(1435.0, 0.02);
    for region in Region::ALL {
        let part = table.region(region);
        for d in [-3.01e-3, 0.37e-3, 5.99e-3, 6.61e-3, 9.03e-3] {
            let h = 1e-7;
            let [before, here, after] = [d - h, d, d + h].map(|d| part.distance(d));
            let numeric = (after[0] - before[0]) / (2.0 * h);
            assert!((numeric - here[1]).abs() < 1e-5 * here[1].abs().max(0.1), "{region:?} {d}: {numeric} {here:?}");
        }
    }
}

#[test]
fn the_flange_touches_from_its_play_on_with_its_angle() {
    let table = table(1435.0, 0.02);
    let [tread, flange] = Region::ALL.map(|region| table.region(region));
    let touches = |d: f64| flange.distance(d)[0] < tread.distance(d)[0];
    assert!(!touches(6.2e-3) && touches(6.8e-3));
    let steepest = flange.nodes.iter().map(|node| node.slope).fold(0.0, f64::min);
    assert!((steepest + 2.7475).abs() < 1e-3, "{steepest}");
    let [least, most] = table.extent();
    assert!(least < -0.02 && most > 0.012, "{least} {most}");
}

#[test]
fn equivalent_conicities_are_those_of_an_independent_program() {
    for (softness, expected) in
        [(0.02, [0.184, 0.173, 0.159, 0.149, 0.150]), (0.002, [0.333, 0.214, 0.172, 0.153, 0.147])]
    {
        let table = table(1435.16, softness);
        let own: Vec<f64> = (1..=5).map(|y| equivalent_conicity(&table, 0.46, 1e-3 * f64::from(y))).collect();
        for (own, expected) in own.iter().zip(expected) {
            assert!((own - expected).abs() < 1.01e-3, "ε = {softness} mm: {own} instead of {expected}");
        }
    }
}

#[test]
fn measured_points_make_nearly_the_table_of_the_formula() {
    let of = |shape: &crate::profile::Shape, from: f64, to: f64| {
        let count = ((to - from) / 0.25) as usize;
        let points: Vec<_> = (0..=count).map(|i| from + 0.25 * i as f64).map(|s| [s, shape.at(s).z]).collect();
        through(&points).unwrap()
    };
    let rail = Placed::new(of(&r60e1().unwrap(), -37.0, 37.0), 1.0 / 40.0, 1435.0).unwrap();
    let measured = of_profiles(&of(&s1002().unwrap(), -69.75, 60.0), &rail, &Pairing::default()).unwrap();
    let exact = table(1435.0, 0.02);
    for d in [-2e-3, 0.0, 3e-3] {
        let [measured, exact] = [&measured, &exact].map(|table| table.region(Region::Tread).distance(d));
        assert!((measured[0] - exact[0]).abs() < 2e-6 && (measured[1] - exact[1]).abs() < 1e-3, "{d}");
    }
    assert_ne!(measured.fingerprint(), exact.fingerprint());
}

#[test]
fn a_cone_keeps_its_slope_until_the_flange_comes() {
    let rail = Placed::new(r60e1().unwrap(), 1.0 / 40.0, 1435.0).unwrap();
    let table = of_profiles(&cone(0.05).unwrap(), &rail, &Pairing::default()).unwrap();
    let tread = table.region(Region::Tread);
    for d in [-5e-3, 0.0, 4e-3] {
        assert!((tread.distance(d)[1] + 0.05).abs() < 1e-3, "{d}: {:?}", tread.distance(d));
    }
}

#[test]
fn settings_without_sense_are_refused() {
    let rail = Placed::new(r60e1().unwrap(), 1.0 / 40.0, 1435.0).unwrap();
    let wheel = s1002().unwrap();
    let bad = |pairing: Pairing| of_profiles(&wheel, &rail, &pairing).unwrap_err();
    assert!(bad(Pairing { softness: 0.0, ..Pairing::default() }).contains("softness"));
    assert!(bad(Pairing { spacing: 1e-6, ..Pairing::default() }).contains("too large"));
    assert!(bad(Pairing { back_to_back: 900.0, ..Pairing::default() }).contains("does not lie on the rail"));
}
