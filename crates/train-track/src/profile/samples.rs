//! A measured profile.

use super::hermite::hermite;

/// Measured values, joined by cubics with continuous slope, constant outside.
#[derive(Clone, Debug)]
pub struct Samples {
    x: Vec<f64>,
    /// (r in m, r′).
    points: Vec<[f64; 2]>,
}

impl Samples {
    /// The slope at a sample is that of the parabola through it and its neighbours (Catmull and Rom's, for any spacing), at
    /// the ends 0, so that the constant outside goes on without a kink.
    pub fn new(x: &[f64], r: &[f64]) -> Self {
        let chord = |i: usize| (r[i + 1] - r[i]) / (x[i + 1] - x[i]);
        let slope = |i: usize| {
            if i == 0 || i + 1 == x.len() {
                return 0.0;
            }
            let (before, after) = (x[i] - x[i - 1], x[i + 1] - x[i]);
            (after * chord(i - 1) + before * chord(i)) / (before + after)
        };
        Self { x: x.to_vec(), points: (0..x.len()).map(|i| [r[i], slope(i)]).collect() }
    }

    /// r(x), m.
    pub fn at(&self, x: f64) -> f64 {
        let after = self.x.partition_point(|sample| *sample <= x);
        match (after.checked_sub(1), self.points.get(after)) {
            (Some(i), Some(next)) => {
                let step = self.x[after] - self.x[i];
                hermite((x - self.x[i]) / step, step, self.points[i], *next)
            }
            (Some(i), None) => self.points[i][0],
            (None, next) => next.map_or(0.0, |point| point[0]),
        }
    }
}
