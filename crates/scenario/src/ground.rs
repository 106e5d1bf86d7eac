//! Motion of the ground: accelerations on a grid, and the velocities and displacements that belong to them.
//!
//! ```text
//! a(t) linear between t_i      v(t) = v_i + a_i s + j s²/2       d(t) = d_i + v_i s + a_i s²/2 + j s³/6,   s = t − t_i
//! ```
//!
//! Displacement, velocity and acceleration are derivatives of each other exactly, so that supports, which need the first two,
//! and bearings, which need all three, move together. Before the first point and behind the last one a = 0: the ground rests
//! before, and goes on with the velocity of the end.

use serde::{Deserialize, Serialize};

/// Ground motion to the right and down.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GroundSeries {
    /// Rising times, s.
    pub times: Vec<f64>,
    /// Accelerations along y and z at these times, m/s².
    pub accelerations: Vec<[f64; 2]>,
    /// Velocities at these times, m/s.
    velocities: Vec<[f64; 2]>,
    /// Displacements at these times, m.
    displacements: Vec<[f64; 2]>,
}

/// Displacement, velocity, acceleration of one moment; along y and z each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GroundState {
    /// m.
    pub displacement: [f64; 2],
    /// m/s.
    pub velocity: [f64; 2],
    /// m/s².
    pub acceleration: [f64; 2],
}

impl GroundSeries {
    /// From accelerations at rising times, at rest before the first.
    #[must_use]
    pub fn new(times: Vec<f64>, accelerations: Vec<[f64; 2]>) -> Self {
        let (mut v, mut d) = ([0.0; 2], [0.0; 2]);
        let (mut velocities, mut displacements) = (vec![v; times.len().min(1)], vec![d; times.len().min(1)]);
        for (time, a) in times.windows(2).zip(accelerations.windows(2)) {
            let h = time[1] - time[0];
            for i in 0..2 {
                d[i] += h * v[i] + h * h * (a[0][i] / 3.0 + a[1][i] / 6.0);
                v[i] += 0.5 * h * (a[0][i] + a[1][i]);
            }
            velocities.push(v);
            displacements.push(d);
        }
        Self { times, accelerations, velocities, displacements }
    }

    /// The same with accelerations to which a line has been added, so that displacement and velocity are 0 at the end.
    ///
    /// With a' = c₀ + c₁ s over the length T: v gains c₀T + c₁T²/2, d gains c₀T²/2 + c₁T³/6.
    #[must_use]
    pub fn at_rest_in_the_end(self) -> Self {
        let [Some(first), Some(last)] = [self.times.first(), self.times.last()].map(Option::<&f64>::copied) else {
            return self;
        };
        let (length, end) = (last - first, self.times.len() - 1);
        let line = [0, 1].map(|i| {
            let (v, d) = (self.velocities[end][i], self.displacements[end][i]);
            let slope = (12.0 * d - 6.0 * length * v) / length.powi(3);
            [-v / length - 0.5 * slope * length, slope]
        });
        let moved = self.times.iter().zip(&self.accelerations);
        let moved = moved.map(|(t, a)| [0, 1].map(|i| a[i] + line[i][0] + line[i][1] * (t - first)));
        let accelerations = moved.collect();
        Self::new(self.times, accelerations)
    }

    /// The ground at a time, s.
    #[must_use]
    pub fn at(&self, t: f64) -> GroundState {
        let after = self.times.partition_point(|time| *time <= t);
        let Some(i) = after.checked_sub(1) else { return GroundState::default() };
        let (s, v, d, a) = (t - self.times[i], self.velocities[i], self.displacements[i], self.accelerations[i]);
        let Some(next) = self.times.get(after) else {
            let displacement = [0, 1].map(|k| d[k] + s * v[k]);
            return GroundState { displacement, velocity: v, acceleration: [0.0; 2] };
        };
        let jerk = [0, 1].map(|k| (self.accelerations[after][k] - a[k]) / (next - self.times[i]));
        GroundState {
            displacement: [0, 1].map(|k| d[k] + s * (v[k] + s * (0.5 * a[k] + s * jerk[k] / 6.0))),
            velocity: [0, 1].map(|k| v[k] + s * (a[k] + 0.5 * s * jerk[k])),
            acceleration: [0, 1].map(|k| a[k] + s * jerk[k]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// a = 6 t − 2 gives v = 3 t² − 2 t and d = t³ − t².
    #[test]
    fn velocities_and_displacements_belong_to_the_accelerations() {
        let times: Vec<f64> = [0.0, 0.3, 0.4, 1.0, 2.0].to_vec();
        let series = GroundSeries::new(times.clone(), times.iter().map(|t| [6.0 * t - 2.0, 0.0]).collect());
        for t in [0.0, 0.1, 0.35, 0.4, 0.9, 1.7] {
            let at = series.at(t);
            assert!((at.acceleration[0] - (6.0 * t - 2.0)).abs() < 1e-13, "{t}");
            assert!((at.velocity[0] - (3.0 * t * t - 2.0 * t)).abs() < 1e-13, "{t}");
            assert!((at.displacement[0] - (t.powi(3) - t * t)).abs() < 1e-13, "{t}");
        }
        assert_eq!(series.at(-1.0), GroundState::default());
        assert_eq!((series.at(3.0).velocity, series.at(3.0).acceleration), ([8.0, 0.0], [0.0; 2]));
    }

    #[test]
    fn a_corrected_series_ends_at_rest_where_it_began() {
        let times: Vec<f64> = (0..=50).map(|i| 0.02 * f64::from(i)).collect();
        let accelerations = times.iter().map(|t| [(9.0 * t).sin() + 0.3, (5.0 * t).cos()]).collect();
        let end = GroundSeries::new(times, accelerations).at_rest_in_the_end().at(2.0);
        assert!(end.displacement.iter().chain(&end.velocity).all(|x| x.abs() < 1e-14), "{end:?}");
    }
}
