//! Single elements.

use super::*;
use crate::matrices::testing::check;

const PLATE: Plate = Plate { modulus: 2e5, poisson: 0.3, thickness: 0.1, mass: 3.0 };
const QUAD: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [2.0, 0.3, 0.5], [1.8, 1.4, 0.9], [-0.2, 1.1, 0.3]];
const TRIANGLE: [[f64; 3]; 3] = [[0.1, 0.0, 0.3], [2.0, 0.3, 0.5], [0.7, 1.4, 0.9]];

#[test]
fn nothing_but_rigid_motion_is_free_of_energy() {
    for poisson in [0.0, 0.3, 0.499] {
        let plate = Plate { poisson, ..PLATE };
        check(&Shell4::new(QUAD, plate).unwrap().matrices(), &QUAD, 0);
        check(&Shell3::new(TRIANGLE, plate).unwrap().matrices(), &TRIANGLE, 0);
    }
}
