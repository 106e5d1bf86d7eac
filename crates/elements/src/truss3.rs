//! Truss and cable in space: axial force only; the mass moves with it in all directions.

use nalgebra::{Matrix3, Vector3};
use ttb_dynamics::frame::ernst_modulus;

use crate::error::{ElementError, exceeds, not_negative, positive};
use crate::matrices::Matrices;

/// A straight truss.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truss3 {
    direction: Vector3<f64>,
    length: f64,
    axial_stiffness: f64,
    mass: f64,
}

impl Truss3 {
    /// Between nodes at `ends`, from EA (N) and mass per length (kg/m).
    ///
    /// # Errors
    /// No length, no stiffness, negative mass.
    pub fn new(ends: [[f64; 3]; 2], axial_stiffness: f64, mass: f64) -> Result<Self, ElementError> {
        positive("axial stiffness", axial_stiffness)?;
        not_negative("mass", mass)?;
        let (begin, end) = (Vector3::from(ends[0]), Vector3::from(ends[1]));
        let length = (end - begin).norm();
        if !exceeds(length, 1e-9 * (1.0 + begin.amax())) {
            return Err(ElementError::NoLength);
        }
        Ok(Self { direction: (end - begin) / length, length, axial_stiffness, mass })
    }

    /// A cable under `tension` (N) with Ernst's equivalent modulus, from E (N/m²), A (m²) and mass per length (kg/m).
    /// `vertical` is the direction of gravity's axis: the sag depends on the length across it.
    ///
    /// # Errors
    /// As [`Truss3::new`]; no tension.
    pub fn cable(
        ends: [[f64; 3]; 2],
        vertical: [f64; 3],
        modulus: f64,
        area: f64,
        mass: f64,
        tension: f64,
    ) -> Result<Self, ElementError> {
        positive("modulus", modulus)?;
        positive("area", area)?;
        positive("tension", tension)?;
        let (chord, up) = (Vector3::from(ends[1]) - Vector3::from(ends[0]), Vector3::from(vertical).normalize());
        let horizontal = (chord - up * up.dot(&chord)).norm();
        Self::new(ends, ernst_modulus(modulus, area, mass, tension, horizontal) * area, mass)
    }

    /// Length l, m.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// K and consistent M; nothing on the rotations.
    pub fn matrices(&self) -> Matrices {
        let k = self.direction * self.direction.transpose() * (self.axial_stiffness / self.length);
        let m = Matrix3::identity() * (self.mass * self.length / 6.0);
        let mut both = Matrices::zeros(12);
        for (row, column) in [(0, 0), (0, 6), (6, 0), (6, 6)] {
            let (sign, share) = if row == column { (1.0, 2.0) } else { (-1.0, 1.0) };
            for i in 0..3 {
                for j in 0..3 {
                    let place = (row + i) * 12 + column + j;
                    both.k[place] = sign * k[(i, j)];
                    both.m[place] = share * m[(i, j)];
                }
            }
        }
        both
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrices::testing::{check, rigid, square};

    const ENDS: [[f64; 3]; 2] = [[1.0, 2.0, 3.0], [3.0, -1.0, 3.5]];

    #[test]
    fn only_the_way_between_the_ends_has_stiffness() {
        let truss = Truss3::new(ENDS, 2e6, 3.0).unwrap();
        let matrices = truss.matrices();
        // Of twelve motions one stretches; the others are the six rigid ones and five loose.
        check(&matrices, &ENDS, 5);
        let (k, chord) = (square(&matrices.k), truss.direction);
        let mut stretch = nalgebra::DVector::zeros(12);
        stretch.fixed_rows_mut::<3>(6).copy_from(&chord);
        assert!((stretch.dot(&(k * &stretch)) / (2e6 / truss.length()) - 1.0).abs() < 1e-12);
        let m = square(&matrices.m);
        for motion in &rigid(&ENDS)[..3] {
            assert!((motion.dot(&(&m * motion)) / (3.0 * truss.length()) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_cable_takes_its_length_across_the_vertical() {
        let cable = Truss3::cable(ENDS, [0.0, 0.0, 1.0], 1.6e11, 5e-3, 40.0, 2e6).unwrap();
        let horizontal = 13.0_f64.sqrt();
        assert_eq!(cable.axial_stiffness, ernst_modulus(1.6e11, 5e-3, 40.0, 2e6, horizontal) * 5e-3);
    }

    #[test]
    fn what_is_no_truss_is_refused() {
        assert_eq!(Truss3::new([ENDS[0]; 2], 1.0, 1.0), Err(ElementError::NoLength));
        assert!(matches!(Truss3::new(ENDS, 0.0, 1.0), Err(ElementError::Property { .. })));
        assert!(matches!(Truss3::new(ENDS, 1.0, f64::NAN), Err(ElementError::Property { .. })));
        assert!(Truss3::cable(ENDS, [0.0, 0.0, 1.0], 1e11, 1e-3, 8.0, -1.0).is_err());
    }
}
