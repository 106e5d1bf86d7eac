//! Single elements.

use nalgebra::DVector;

use super::*;
use crate::matrices::testing::{check, rigid, square};

const ENDS: [[f64; 3]; 2] = [[1.0, 2.0, 3.0], [3.0, 1.0, 3.5]];
const SECTION: BeamSection = BeamSection {
    modulus: 2.1e11,
    shear_modulus: 8e10,
    density: 7850.0,
    area: 0.02,
    inertia_2: 3e-4,
    inertia_3: 1e-4,
    torsion: 2e-5,
    shear_area_2: Some(0.008),
    shear_area_3: None,
    added_mass: 40.0,
};
const OFFSETS: [[f64; 3]; 2] = [[0.1, 0.0, 0.4], [0.0, -0.2, 0.5]];
const NONE: [[bool; 3]; 2] = [[false; 3]; 2];

fn beam(offsets: [[f64; 3]; 2], releases: [[bool; 3]; 2]) -> Beam3 {
    Beam3::new(ENDS, [0.0, 0.0, 1.0], SECTION, offsets, releases).unwrap()
}

#[test]
fn nothing_but_rigid_motion_is_free_of_energy() {
    check(&beam([[0.0; 3]; 2], NONE).matrices(), &ENDS, 0);
    check(&beam(OFFSETS, NONE).matrices(), &ENDS, 0);
    // Each release leaves one motion of the node without stiffness.
    check(&beam(OFFSETS, [[false, true, false], [true, false, true]]).matrices(), &ENDS, 3);
    check(&beam(OFFSETS, [[false, true, true], [true, true, true]]).matrices(), &ENDS, 5);
}

#[test]
fn rigid_motion_has_the_whole_mass() {
    for releases in [NONE, [[false, true, true], [true, true, true]]] {
        let beam = beam(OFFSETS, releases);
        let m = square(&beam.matrices().m);
        let mass = (SECTION.density * SECTION.area + SECTION.added_mass) * beam.length();
        for motion in &rigid(&ENDS)[..3] {
            assert!((motion.dot(&(&m * motion)) / mass - 1.0).abs() < 1e-12);
        }
    }
    // About its own middle: along the axis ρ(I₂ + I₃)l, across it ml³/12 and, in the plane with shear area, ρI₃l.
    let ends = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let beam = Beam3::new(ends, [0.0, 1.0, 0.0], SECTION, [[0.0; 3]; 2], NONE).unwrap();
    let m = square(&beam.matrices().m);
    let across = (SECTION.density * SECTION.area + SECTION.added_mass) * 8.0 / 12.0;
    let expected = [7850.0 * 4e-4 * 2.0, across, across + 7850.0 * 1e-4 * 2.0];
    for (motion, expected) in rigid(&ends)[3..].iter().zip(expected) {
        let inertia = motion.dot(&(&m * motion));
        assert!((inertia / expected - 1.0).abs() < 1e-12, "{inertia} {expected}");
    }
}

#[test]
fn axes_follow_the_orientation() {
    let beam = Beam3::new([[0.0; 3], [2.0, 0.0, 0.0]], [5.0, 3.0, 0.0], SECTION, [[0.0; 3]; 2], NONE).unwrap();
    assert_eq!(beam.axes(), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    // Bending in the plane 1–2 takes I₃, in the plane 1–3 I₂.
    let k = square(&beam.matrices().k);
    assert!((k[(2, 2)] / (12.0 * 2.1e11 * 3e-4 / 8.0) - 1.0).abs() < 1e-12);
    let phi = 12.0 * 2.1e11 * 1e-4 / (8e10 * 0.008 * 4.0);
    assert!((k[(1, 1)] / (12.0 * 2.1e11 * 1e-4 / 8.0 / (1.0 + phi)) - 1.0).abs() < 1e-12);
}

#[test]
fn a_release_is_the_static_condensation() {
    let ends = [[0.0; 3], [2.0, 0.0, 0.0]];
    let make = |releases| Beam3::new(ends, [0.0, 1.0, 0.0], SECTION, [[0.0; 3]; 2], releases).unwrap();
    let mut k = square(&make(NONE).matrices().k);
    // Places 4 (r₂ of end 1), 5, 11 and 9 (torsion at end 2), one after the other.
    let releases = [[false, true, true], [true, false, true]];
    for place in [4, 5, 11, 9] {
        k = &k - k.column(place) * k.row(place) / k[(place, place)];
    }
    let released = square(&make(releases).matrices().k);
    assert!((&k - &released).amax() < 1e-10 * k.amax(), "{}", (&k - &released).amax() / k.amax());
}

#[test]
fn an_element_laid_backwards_is_the_same() {
    let releases = [[false, true, false], [true, false, true]];
    let there = beam(OFFSETS, releases);
    let back =
        Beam3::new([ENDS[1], ENDS[0]], [0.0, 0.0, 1.0], SECTION, [OFFSETS[1], OFFSETS[0]], [releases[1], releases[0]]);
    let (a, b) = (there.matrices(), back.unwrap().matrices());
    for (a, b) in [(square(&a.k), square(&b.k)), (square(&a.m), square(&b.m))] {
        let error = (0..144).map(|p| (a[(p / 12, p % 12)] - b[((p / 12 + 6) % 12, (p % 12 + 6) % 12)]).abs());
        assert!(error.fold(0.0, f64::max) < 1e-11 * a.amax());
    }
}

/// The energy of an offset beam is that of the same beam between its true ends, moved as the arms move them.
#[test]
fn offsets_are_rigid_arms() {
    let offset = square(&beam(OFFSETS, NONE).matrices().k);
    let true_ends = [0, 1].map(|i| [0, 1, 2].map(|j| ENDS[i][j] + OFFSETS[i][j]));
    let direct = Beam3::new(true_ends, [0.0, 0.0, 1.0], SECTION, [[0.0; 3]; 2], NONE).unwrap();
    let q = DVector::from_fn(12, |i, _| ((i * i) as f64).sin());
    let mut moved = q.clone();
    for (node, arm) in OFFSETS.iter().enumerate() {
        let turn = Vector3::new(q[6 * node + 3], q[6 * node + 4], q[6 * node + 5]).cross(&Vector3::from(*arm));
        (0..3).for_each(|i| moved[6 * node + i] += turn[i]);
    }
    let (a, b) = (q.dot(&(offset * &q)), moved.dot(&(square(&direct.matrices().k) * &moved)));
    assert!((a / b - 1.0).abs() < 1e-11);
}

#[test]
fn interpolation_holds_rigid_motion_and_ends() {
    let (direction, arm) = ([0.2, -0.5, 0.8], [0.3, 0.1, -0.4]);
    for releases in [NONE, [[false, true, true], [true, true, true]]] {
        let beam = beam(OFFSETS, releases);
        let end = [0, 1, 2].map(|j| ENDS[1][j] + OFFSETS[1][j]);
        let begin = [0, 1, 2].map(|j| ENDS[0][j] + OFFSETS[0][j]);
        for xi in [0.0, 0.3, 1.0] {
            let at = [0, 1, 2].map(|j| begin[j] + xi * (end[j] - begin[j]) + arm[j]);
            let row = beam.interpolate(xi, direction, arm);
            for (motion, exact) in rigid(&ENDS).iter().zip(rigid(&[at])) {
                let value: f64 = row.iter().map(|(place, weight)| weight * motion[*place]).sum();
                let exact: f64 = direction.iter().zip(exact.iter()).map(|(d, u)| d * u).sum();
                assert!((value - exact).abs() < 1e-12, "{value} {exact}");
            }
            let (found, rest) = beam.closest([0, 1, 2].map(|j| at[j] - arm[j]));
            assert!((found - xi).abs() < 1e-12 && rest.iter().all(|r| r.abs() < 1e-12));
        }
    }
}

/// A force on the interpolated point turns the nodes' forces with the weights: the tip force of a loaded cantilever.
#[test]
fn interpolation_is_the_shape_of_the_stiffness() {
    let ends = [[0.0; 3], [2.0, 0.0, 0.0]];
    let section = BeamSection { shear_area_2: None, ..SECTION };
    let beam = Beam3::new(ends, [0.0, 1.0, 0.0], section, [[0.0; 3]; 2], NONE).unwrap();
    let row = beam.interpolate(0.5, [0.0, 1.0, 0.0], [0.0; 3]);
    let expected = [(1, 0.5), (5, 0.25), (7, 0.5), (11, -0.25)];
    assert!(row.iter().zip(expected).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 1e-15), "{row:?}");
    let row = beam.interpolate(0.5, [0.0, 0.0, 1.0], [0.0, 0.3, 0.0]);
    // r₂ lifts what lies ahead (z = −θ x); twist moves the arm.
    let expected = [(2, 0.5), (3, 0.15), (4, -0.25), (8, 0.5), (9, 0.15), (10, 0.25)];
    assert!(row.iter().zip(expected).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 1e-15), "{row:?}");
}

#[test]
fn what_is_no_beam_is_refused() {
    let new = |ends, orientation, section, releases| Beam3::new(ends, orientation, section, [[0.0; 3]; 2], releases);
    assert_eq!(new([ENDS[0]; 2], [0.0, 0.0, 1.0], SECTION, NONE), Err(ElementError::NoLength));
    assert_eq!(new(ENDS, [-4.0, 2.0, -1.0], SECTION, NONE), Err(ElementError::ParallelOrientation));
    assert_eq!(new(ENDS, [0.0; 3], SECTION, NONE), Err(ElementError::ParallelOrientation));
    assert_eq!(new(ENDS, [0.0, 0.0, 1.0], SECTION, [[true, false, false]; 2]), Err(ElementError::Twists));
    let hollow = BeamSection { area: 0.0, ..SECTION };
    assert!(matches!(new(ENDS, [0.0, 0.0, 1.0], hollow, NONE), Err(ElementError::Property { property: "area", .. })));
}
