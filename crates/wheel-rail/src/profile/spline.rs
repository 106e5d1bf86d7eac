//! Measured points as a natural cubic spline.
//!
//! ```text
//! (h_i/6) M_{i−1} + (h_i + h_{i+1})/3 M_i + (h_{i+1}/6) M_{i+1} = (z_{i+1} − z_i)/h_{i+1} − (z_i − z_{i−1})/h_i,   M = z″
//! ```

use super::{Piece, Shape};

/// The shape through `points`, each (s, z) in mm, s increasing.
///
/// # Errors
/// Fewer than four points, a number that is not finite, or s that does not increase, with the point.
pub fn through(points: &[[f64; 2]]) -> Result<Shape, String> {
    let n = points.len();
    if n < 4 {
        return Err(format!("a measured profile has {n} points; it needs at least 4"));
    }
    for (i, point) in points.iter().enumerate() {
        if !point.iter().all(|x| x.is_finite()) {
            return Err(format!("point {} of a measured profile is {point:?}; both numbers must be finite", i + 1));
        }
        if i > 0 && point[0] <= points[i - 1][0] {
            let (s, before) = (point[0], points[i - 1][0]);
            return Err(format!(
                "point {} of a measured profile lies at {s} mm, which is not beyond {before} mm",
                i + 1
            ));
        }
    }
    let h: Vec<f64> = points.windows(2).map(|p| p[1][0] - p[0][0]).collect();
    let rise: Vec<f64> = points.windows(2).zip(&h).map(|(p, h)| (p[1][1] - p[0][1]) / h).collect();
    // Thomas' method; M is 0 at both ends.
    let (mut upper, mut bend) = (vec![0.0; n], vec![0.0; n]);
    for i in 1..n - 1 {
        let pivot = (h[i - 1] + h[i]) / 3.0 - h[i - 1] / 6.0 * upper[i - 1];
        upper[i] = h[i] / 6.0 / pivot;
        bend[i] = (rise[i] - rise[i - 1] - h[i - 1] / 6.0 * bend[i - 1]) / pivot;
    }
    for i in (1..n - 1).rev() {
        bend[i] -= upper[i] * bend[i + 1];
    }
    let pieces = (0..n - 1).map(|i| {
        let c1 = rise[i] - h[i] * (2.0 * bend[i] + bend[i + 1]) / 6.0;
        let c3 = (bend[i + 1] - bend[i]) / (6.0 * h[i]);
        let coefficients = vec![points[i][1], c1, 0.5 * bend[i], c3];
        (points[i + 1][0], Piece::Polynomial { origin: points[i][0], coefficients })
    });
    Shape::new(points[0][0], pieces.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spline_goes_through_its_points_without_a_kink_and_bends_like_an_arc() {
        let points: Vec<_> =
            (0..41).map(|i| f64::from(i) - 20.0).map(|s| [s, 80.0 - (6400.0 - s * s).sqrt()]).collect();
        let shape = through(&points).unwrap();
        assert!(shape.largest_step() < 1e-12);
        for s in [-10.3, 0.0, 7.77] {
            let here = shape.at(s);
            assert!((here.z - (80.0 - (6400.0 - s * s).sqrt())).abs() < 1e-6);
            assert!((here.curvature() * 80.0 - 1.0).abs() < 1e-3);
        }
        assert!((shape.at(3.0 - 1e-9).bend - shape.at(3.0 + 1e-9).bend).abs() < 1e-8);
    }

    #[test]
    fn points_that_are_no_profile_are_refused_with_their_number() {
        assert!(through(&[[0.0, 0.0]; 3]).unwrap_err().contains("3 points"));
        assert!(through(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [2.0, 0.0]]).unwrap_err().contains("point 3"));
        assert!(through(&[[0.0, 0.0], [1.0, f64::NAN], [2.0, 0.0], [3.0, 0.0]]).unwrap_err().contains("point 2"));
    }
}
