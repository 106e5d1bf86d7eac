//! Single elements.

use nalgebra::{DVector, Matrix3, Rotation3, Vector3};

use super::*;
use crate::error::ElementError;
use crate::matrices::testing::{check, rigid, square};
use crate::matrices::{Matrices, Weights};

const PLATE: Plate = Plate { modulus: 2e5, poisson: 0.3, thickness: 0.1, mass: 3.0 };
const QUAD: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [2.0, 0.3, 0.5], [1.8, 1.4, 0.9], [-0.2, 1.1, 0.3]];
const PLANE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [2.0, 0.3, 0.0], [1.8, 1.4, 0.0], [-0.2, 1.1, 0.0]];
const TRIANGLE: [[f64; 3]; 3] = [[0.1, 0.0, 0.3], [2.0, 0.3, 0.5], [0.7, 1.4, 0.9]];

fn both() -> [(Matrices, Vec<[f64; 3]>); 2] {
    let (quad, triangle) = (Shell4::new(QUAD, PLATE).unwrap(), Shell3::new(TRIANGLE, PLATE).unwrap());
    [(quad.matrices(), QUAD.to_vec()), (triangle.matrices(), TRIANGLE.to_vec())]
}

#[test]
fn nothing_but_rigid_motion_is_free_of_energy() {
    for poisson in [0.0, 0.3, 0.499] {
        let plate = Plate { poisson, ..PLATE };
        check(&Shell4::new(QUAD, plate).unwrap().matrices(), &QUAD, 0);
        check(&Shell4::new(PLANE, plate).unwrap().matrices(), &PLANE, 0);
        check(&Shell3::new(TRIANGLE, plate).unwrap().matrices(), &TRIANGLE, 0);
    }
}

#[test]
fn rigid_motion_has_the_whole_mass_and_rotary_inertia() {
    let nodes = [[-1.0, -0.5, 0.0], [1.0, -0.5, 0.0], [1.0, 0.5, 0.0], [-1.0, 0.5, 0.0]];
    let m = square(&Shell4::new(nodes, PLATE).unwrap().matrices().m);
    let mass = 2.0 * PLATE.mass;
    let t2 = PLATE.thickness * PLATE.thickness;
    let expected = [mass, mass, mass, mass / 12.0 * (1.0 + t2), mass / 12.0 * (4.0 + t2), mass / 12.0 * 5.0];
    for (motion, expected) in rigid(&nodes).iter().zip(expected) {
        let inertia = motion.dot(&(&m * motion));
        assert!((inertia / expected - 1.0).abs() < 1e-12, "{inertia} {expected}");
    }
    for (matrices, nodes) in both() {
        let m = square(&matrices.m);
        let masses: Vec<f64> = rigid(&nodes)[..3].iter().map(|u| u.dot(&(&m * u))).collect();
        assert!(masses.iter().all(|m| (m / masses[0] - 1.0).abs() < 1e-12));
    }
    let triangle = Shell3::new(TRIANGLE, PLATE).unwrap();
    let m = square(&triangle.matrices().m);
    let u = &rigid(&TRIANGLE)[0];
    assert!((u.dot(&(&m * u)) / (PLATE.mass * triangle.area()) - 1.0).abs() < 1e-12);
}

/// Stiffness and mass seen by a motion that turns with the element.
#[test]
fn the_element_does_not_know_the_axes() {
    let turn = Rotation3::from_euler_angles(0.4, -1.1, 2.3);
    let place = |p: [f64; 3]| (turn * Vector3::from(p) + Vector3::new(3.0, -2.0, 5.0)).into();
    let turned = [
        Shell4::new(QUAD.map(place), PLATE).unwrap().matrices(),
        Shell3::new(TRIANGLE.map(place), PLATE).unwrap().matrices(),
    ];
    for ((here, _), there) in both().into_iter().zip(turned) {
        let mut t = nalgebra::DMatrix::zeros(here.n, here.n);
        let block: Matrix3<f64> = turn.into_inner();
        (0..here.n / 3).for_each(|i| t.fixed_view_mut::<3, 3>(3 * i, 3 * i).copy_from(&block));
        for (a, b) in [(&here.k, &there.k), (&here.m, &there.m)] {
            let (a, b) = (&t * square(a) * t.transpose(), square(b));
            assert!((&a - &b).amax() < 1e-11 * b.amax(), "{}", (&a - &b).amax() / b.amax());
        }
    }
}

#[test]
fn the_element_does_not_know_where_its_numbering_begins() {
    for first in 1..4 {
        let nodes = [0, 1, 2, 3].map(|i| QUAD[(i + first) % 4]);
        let turned = Shell4::new(nodes, PLATE).unwrap().matrices();
        same(&both()[0].0, &turned, |i| (i + first) % 4);
    }
    // In the opposite order: the normal turns over.
    let turned = Shell4::new([QUAD[0], QUAD[3], QUAD[2], QUAD[1]], PLATE).unwrap().matrices();
    same(&both()[0].0, &turned, |i| (4 - i) % 4);
    let turned = Shell3::new([TRIANGLE[1], TRIANGLE[2], TRIANGLE[0]], PLATE).unwrap().matrices();
    same(&both()[1].0, &turned, |i| (i + 1) % 3);
    let turned = Shell3::new([TRIANGLE[0], TRIANGLE[2], TRIANGLE[1]], PLATE).unwrap().matrices();
    same(&both()[1].0, &turned, |i| (3 - i) % 3);
}

/// Node i of `b` is node `node(i)` of `a`.
fn same(a: &Matrices, b: &Matrices, node: impl Fn(usize) -> usize) {
    let place = |i: usize| 6 * node(i / 6) + i % 6;
    for (a, b) in [(&a.k, &b.k), (&a.m, &b.m)] {
        let (a, b) = (square(a), square(b));
        for i in 0..b.nrows() {
            for j in 0..b.nrows() {
                let error = (b[(i, j)] - a[(place(i), place(j))]).abs();
                assert!(error < 1e-11 * a.amax(), "{i} {j}: {error} of {}", a.amax());
            }
        }
    }
}

/// Two optimal triangles hold the energy of pure in-plane bending exactly, whatever the rectangle's aspect ratio.
#[test]
fn in_plane_bending_of_a_rectangle_of_triangles_is_exact() {
    let plate = Plate { poisson: 0.0, thickness: 1.0, ..PLATE };
    for length in [1.0, 4.0, 16.0] {
        let field = |p: &[f64; 2]| [p[0] * p[1], -0.5 * p[0] * p[0], -p[0]];
        let (a, b, c, d) = ([0.0, -0.5], [length, -0.5], [length, 0.5], [0.0, 0.5]);
        let energy: f64 = [[a, b, c], [a, c, d]].iter().map(|corners| energy3(corners, &plate, field)).sum();
        let exact = 0.5 * plate.modulus * length / 12.0;
        assert!((energy / exact - 1.0).abs() < 1e-10, "{length}: {}", energy / exact);
    }
}

fn energy3(corners: &[[f64; 2]; 3], plate: &Plate, field: impl Fn(&[f64; 2]) -> [f64; 3]) -> f64 {
    let k = membrane3::stiffness(corners, plate);
    let q: Vec<f64> = corners.iter().flat_map(field).collect();
    0.5 * k.iter().zip(&q).map(|(k, q1)| q1 * k.iter().zip(&q).map(|(k, q2)| k * q2).sum::<f64>()).sum::<f64>()
}

fn apply(row: &Weights, q: &DVector<f64>) -> f64 {
    row.iter().map(|(place, weight)| weight * q[*place]).sum()
}

#[test]
fn interpolation_holds_rigid_motion_with_an_arm() {
    let (quad, triangle) = (Shell4::new(QUAD, PLATE).unwrap(), Shell3::new(TRIANGLE, PLATE).unwrap());
    let arm = [0.1, -0.2, -0.6];
    let direction = [0.0, 0.3, 0.9];
    let (p4, l4) = (quad.point([0.3, -0.7]), [0.3, -0.7]);
    let (p3, l3) = (triangle.point([0.2, 0.5, 0.3]), [0.2, 0.5, 0.3]);
    for (row, point, nodes) in [
        (quad.interpolate(l4, direction, arm), p4, QUAD.to_vec()),
        (triangle.interpolate(l3, direction, arm), p3, TRIANGLE.to_vec()),
    ] {
        let at = [0, 1, 2].map(|i| point[i] + arm[i]);
        for (motion, exact) in rigid(&nodes).iter().zip(rigid(&[at])) {
            let exact: f64 = direction.iter().zip(exact.iter()).map(|(d, u)| d * u).sum();
            assert!((apply(&row, motion) - exact).abs() < 1e-13);
        }
    }
    let down = quad.interpolate(l4, [0.0, 0.0, 1.0], [0.0; 3]);
    let sum = |freedom: usize| down.iter().filter(|(place, _)| place % 6 == freedom).map(|(_, w)| w).sum::<f64>();
    assert!(sum(0) == 0.0 && sum(1) == 0.0 && (sum(2) - 1.0).abs() < 1e-15);
    // In the middle of an edge a beam's: half of each end, an eighth of the length of the turns' difference.
    let flat = Shell4::new([[0.0; 3], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]], PLATE).unwrap();
    let row = flat.interpolate([0.0, -1.0], [0.0, 0.0, 1.0], [0.0; 3]);
    assert_eq!(row, [(2, 0.5), (4, -0.25), (8, 0.5), (10, 0.25)]);
}

#[test]
fn a_point_is_found_in_plan() {
    let (quad, triangle) = (Shell4::new(QUAD, PLATE).unwrap(), Shell3::new(TRIANGLE, PLATE).unwrap());
    for local in [[0.3, -0.7], [1.0, 1.0], [-1.0, 0.2], [0.0, 0.0]] {
        let [x, y, _] = quad.point(local);
        let found = quad.contains_in_plan(x, y, 1e-9).unwrap();
        assert!(found.iter().zip(local).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {local:?}");
    }
    let [x, y, _] = triangle.point([0.2, 0.5, 0.3]);
    let found = triangle.contains_in_plan(x, y, 1e-9).unwrap();
    assert!(found.iter().zip([0.2, 0.5, 0.3]).all(|(a, b)| (a - b).abs() < 1e-13));
    assert_eq!(quad.contains_in_plan(3.0, 0.5, 1e-9), None);
    assert_eq!(quad.contains_in_plan(1e3, -1e3, 1e-9), None);
    assert_eq!(triangle.contains_in_plan(0.0, 1.0, 1e-9), None);
    let web = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0]];
    assert_eq!(Shell4::new(web, PLATE).unwrap().contains_in_plan(0.5, 0.0, 1e-9), None);
}

#[test]
fn what_is_no_shell_is_refused() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let with = |corner: usize, p: [f64; 3]| {
        let mut nodes = square;
        nodes[corner] = p;
        Shell4::new(nodes, PLATE)
    };
    let crossed = Shell4::new([square[0], square[1], square[3], square[2]], PLATE);
    assert!(matches!(crossed, Err(ElementError::NoArea | ElementError::Corner { .. })), "{crossed:?}");
    assert!(matches!(with(2, [0.2, 0.2, 0.0]), Err(ElementError::Corner { corner: 3, .. })));
    assert!(matches!(with(2, [0.5, 0.5, 0.0]), Err(ElementError::Corner { .. })));
    assert!(matches!(with(1, square[0]), Err(ElementError::Corner { .. } | ElementError::NoArea)));
    assert!(matches!(with(2, [1.0, 1.0, 1.5]), Err(ElementError::Warped { .. })));
    assert_eq!(Shell4::new([square[0]; 4], PLATE), Err(ElementError::NoArea));
    assert!(matches!(with(2, [f64::NAN; 3]), Err(ElementError::NoArea)));
    let line = [[0.0; 3], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]];
    assert_eq!(Shell3::new(line, PLATE), Err(ElementError::NoArea));
    let sliver = [[0.0; 3], [1.0, 0.0, 0.0], [0.5, 1e-4, 0.0]];
    assert!(matches!(Shell3::new(sliver, PLATE), Err(ElementError::Sliver { .. })));
    let thin = Plate { thickness: 0.0, ..PLATE };
    assert!(matches!(Shell3::new(TRIANGLE, thin), Err(ElementError::Property { property: "thickness", .. })));
}

/// Shapes at the edge of what is accepted: long, skew, one corner nearly straight.
#[test]
fn poor_shapes_still_give_sound_matrices() {
    let long = [[0.0, 0.0, 0.0], [1000.0, 0.0, 0.0], [1000.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let skew = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [11.0, 0.5, 0.0], [10.0, 0.5, 0.0]];
    let blunt = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.51, 0.51, 0.0], [0.0, 1.0, 0.0]];
    for nodes in [long, skew, blunt] {
        let matrices = Shell4::new(nodes, PLATE).unwrap().matrices();
        let k = square(&matrices.k);
        assert!(k.iter().all(|k| k.is_finite()));
        for motion in rigid(&nodes) {
            assert!((&k * &motion).amax() < 1e-9 * k.amax() * motion.amax());
        }
        assert!(k.clone().symmetric_eigenvalues().min() > -1e-10 * k.amax());
    }
}
