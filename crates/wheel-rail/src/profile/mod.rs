//! Profiles as curves z(s): s to the field side, z down, both in millimetres as drawings give them.
//!
//! A [`Shape`] is a row of [`Piece`]s, each an arc or a polynomial; measured points become the polynomials of a [`spline`].

pub mod rail;
pub mod spline;
pub mod wheel;

/// A point of a profile: z, dz/ds, d²z/ds².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// z, mm.
    pub z: f64,
    /// dz/ds.
    pub slope: f64,
    /// d²z/ds², 1/mm.
    pub bend: f64,
}

impl Point {
    /// Curvature of the curve, positive where z grows on both sides, 1/mm.
    #[must_use]
    pub fn curvature(&self) -> f64 {
        self.bend / libm::pow(1.0 + self.slope * self.slope, 1.5)
    }
}

/// A part of a profile.
#[derive(Clone, Debug)]
pub enum Piece {
    /// Σ c_i (s − origin)^i.
    Polynomial {
        /// Where the powers count from, mm.
        origin: f64,
        /// c₀, c₁ …, z in mm.
        coefficients: Vec<f64>,
    },
    /// z = z_m ∓ √(R² − (s − s_m)²): `above` its centre (smaller z) or below.
    Arc {
        /// (s_m, z_m), mm.
        centre: [f64; 2],
        /// R, mm.
        radius: f64,
        /// Whether the arc lies above its centre.
        above: bool,
    },
}

impl Piece {
    fn at(&self, s: f64) -> Point {
        match self {
            Self::Polynomial { origin, coefficients } => {
                let x = s - origin;
                let (mut z, mut slope, mut half_bend) = (0.0, 0.0, 0.0);
                for c in coefficients.iter().rev() {
                    half_bend = half_bend * x + slope;
                    slope = slope * x + z;
                    z = z * x + c;
                }
                Point { z, slope, bend: 2.0 * half_bend }
            }
            Self::Arc { centre, radius, above } => {
                let x = s - centre[0];
                let sign = if *above { 1.0 } else { -1.0 };
                let root = (radius * radius - x * x).max(1e-12).sqrt();
                Point {
                    z: centre[1] - sign * root,
                    slope: sign * x / root,
                    bend: sign * radius * radius / (root * root * root),
                }
            }
        }
    }
}

/// A whole profile.
#[derive(Clone, Debug)]
pub struct Shape {
    start: f64,
    /// Every piece with its end, ends increasing, mm.
    pieces: Vec<(f64, Piece)>,
}

impl Shape {
    /// Pieces one after the other from `start`, each up to its end, mm.
    ///
    /// # Errors
    /// No piece, or ends that do not increase.
    pub fn new(start: f64, pieces: Vec<(f64, Piece)>) -> Result<Self, String> {
        let mut last = start;
        if pieces.is_empty() {
            return Err("a profile needs at least one piece".into());
        }
        for (i, (end, _)) in pieces.iter().enumerate() {
            if end.is_nan() || *end <= last {
                let piece = i + 1;
                return Err(format!(
                    "piece {piece} of a profile ends at {end} mm, which is not beyond its begin {last} mm"
                ));
            }
            last = *end;
        }
        Ok(Self { start, pieces })
    }

    /// First and last s, mm.
    #[must_use]
    pub fn extent(&self) -> [f64; 2] {
        [self.start, self.pieces.last().map_or(self.start, |(end, _)| *end)]
    }

    /// The profile at s; beyond its ends the end pieces go on.
    #[must_use]
    pub fn at(&self, s: f64) -> Point {
        let i = self.pieces.partition_point(|(end, _)| *end < s).min(self.pieces.len() - 1);
        self.pieces[i].1.at(s)
    }

    /// The largest gap in z between neighbouring pieces, mm.
    #[must_use]
    pub fn largest_step(&self) -> f64 {
        let joints = self.pieces.windows(2).map(|pair| (pair[0].1.at(pair[0].0).z - pair[1].1.at(pair[0].0).z).abs());
        joints.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_and_bends_are_those_of_the_curve() {
        let arc = Piece::Arc { centre: [1.0, 20.0], radius: 13.0, above: true };
        let polynomial = Piece::Polynomial { origin: 2.0, coefficients: vec![1.0, -0.5, 0.25, 0.1] };
        for piece in [arc, polynomial] {
            let (s, h) = (4.0, 1e-4);
            let [before, here, after] = [s - h, s, s + h].map(|s| piece.at(s));
            assert!((here.slope - (after.z - before.z) / (2.0 * h)).abs() < 1e-7, "{piece:?}");
            assert!((here.bend - (after.slope - before.slope) / (2.0 * h)).abs() < 1e-7, "{piece:?}");
        }
        assert!(
            (Piece::Arc { centre: [1.0, 20.0], radius: 13.0, above: true }.at(5.0).curvature() - 1.0 / 13.0).abs()
                < 1e-12
        );
    }

    #[test]
    fn pieces_that_do_not_follow_each_other_are_refused() {
        let line = || Piece::Polynomial { origin: 0.0, coefficients: vec![0.0] };
        assert!(Shape::new(0.0, vec![(1.0, line()), (1.0, line())]).unwrap_err().contains("piece 2"));
        assert!(Shape::new(0.0, Vec::new()).is_err());
    }
}
