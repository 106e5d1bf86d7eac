//! How far the train has run: speed v(t) piecewise linear, constant outside its points.

use ttb_scenario::travel::speed_at;

/// Speed over time, scaled.
#[derive(Clone, Debug)]
pub struct Running {
    /// (t, v).
    points: Vec<[f64; 2]>,
    /// Distance run since t = 0 at every point: summed once, asked for by every wheel of every step.
    run: Vec<f64>,
}

impl Running {
    /// From points (time s, speed m/s), times increasing; all speeds are multiplied by `factor`.
    pub fn new(points: &[[f64; 2]], factor: f64) -> Self {
        let points: Vec<_> = points.iter().map(|[t, v]| [*t, v * factor]).collect();
        let mut running = Self { run: vec![0.0; points.len()], points };
        for i in 1..running.points.len() {
            let ([t0, v0], [t1, v1]) = (running.points[i - 1], running.points[i]);
            running.run[i] = running.run[i - 1] + 0.5 * (v0 + v1) * (t1 - t0);
        }
        // Distances count from t = 0.
        let at_zero = running.distance(0.0);
        running.run.iter_mut().for_each(|s| *s -= at_zero);
        running
    }

    /// v(t), m/s.
    pub fn speed(&self, t: f64) -> f64 {
        speed_at(&self.points, t)
    }

    /// Distance run since t = 0, m; negative before.
    pub fn distance(&self, t: f64) -> f64 {
        let i = self.points.partition_point(|p| p[0] <= t).saturating_sub(1);
        let (Some([t0, v0]), Some(s0)) = (self.points.get(i), self.run.get(i)) else { return 0.0 };
        s0 + 0.5 * (v0 + self.speed(t)) * (t - t0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_braking_train_runs_the_area_under_its_speed() {
        let running = Running::new(&[[1.0, 20.0], [3.0, 10.0]], 2.0);
        assert_eq!(running.distance(0.0), 0.0);
        assert_eq!(running.distance(-1.0), -40.0);
        assert_eq!(running.distance(1.0), 40.0);
        assert_eq!(running.distance(2.0), 40.0 + 35.0);
        assert_eq!(running.distance(4.0), 40.0 + 60.0 + 20.0);
        assert_eq!(running.speed(2.0), 30.0);
    }
}
