//! Where the wheels are: their places in the train, the distance the train has run, the abscissae they ever reach.

use crate::spec::TrainTrackSpec;
use crate::types::Car;

/// Distance of every wheelset behind the leading one, m, in order from the front; four per car.
///
/// Cars stand buffer to buffer: from the centre of one to that of the next is half the length of each.
#[must_use]
pub fn wheel_offsets(cars: &[Car]) -> Vec<f64> {
    let mut offsets = Vec::with_capacity(4 * cars.len());
    let mut front = 0.0; // of the car, behind the front of the train
    for car in cars {
        let centre = front + 0.5 * car.length;
        let (bogie, axle) = (0.5 * car.bogie_distance, 0.5 * car.wheelbase);
        offsets.extend([-bogie - axle, -bogie + axle, bogie - axle, bogie + axle].map(|arm| centre + arm));
        front += car.length;
    }
    let leading = offsets.first().copied().unwrap_or(0.0);
    offsets.iter().map(|offset| offset - leading).collect()
}

/// Speed in m/s at time `t` in s for points (time, speed): linear in between, constant outside.
#[must_use]
pub fn speed_at(points: &[[f64; 2]], t: f64) -> f64 {
    let after = points.partition_point(|point| point[0] <= t);
    match (after.checked_sub(1).map(|i| points[i]), points.get(after)) {
        (Some([t0, v0]), Some([t1, v1])) => v0 + (v1 - v0) * (t - t0) / (t1 - t0),
        (Some([_, v]), None) | (None, Some(&[_, v])) => v,
        (None, None) => 0.0,
    }
}

/// Distance in m run from time 0 to `t` ≥ 0 in s; exact for the piecewise linear speed.
#[must_use]
pub fn distance(points: &[[f64; 2]], t: f64) -> f64 {
    let inner = points.iter().map(|point| point[0]).filter(|time| (0.0..t).contains(time));
    let mut run = 0.0;
    let mut from = 0.0;
    for to in inner.chain([t]) {
        run += 0.5 * (speed_at(points, from) + speed_at(points, to)) * (to - from);
        from = to;
    }
    run
}

impl TrainTrackSpec {
    /// The abscissae between which wheels are during the pre-roll and the run, m.
    #[must_use]
    pub fn passage(&self) -> [f64; 2] {
        let last = wheel_offsets(&self.cars).last().copied().unwrap_or(0.0);
        [self.front_wheel - last - self.pre_roll, self.front_wheel + distance(&self.speed, self.end)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bundled;

    /// docs/theory.md 15: one trailer car, leading wheel at 30 m, wheels at 30, 27.5, 12.625, 10.125 m.
    #[test]
    fn wheels_stand_in_order_from_the_front_car_behind_car() {
        let car = bundled::cars("ice3-trailer").unwrap();
        assert_eq!(wheel_offsets(&car), [0.0, 2.5, 17.375, 19.875]);
        let two = wheel_offsets(&[car.clone(), car].concat());
        assert_eq!(two.len(), 8);
        assert!((two[4] - 24.775).abs() < 1e-12 && (two[7] - 44.65).abs() < 1e-12);
        // the gap between two different cars is half of each one's overhang
        let mixed = [bundled::cars("ice3-trailer").unwrap(), bundled::cars("manchester").unwrap()].concat();
        let offsets = wheel_offsets(&mixed);
        assert!((offsets[4] - offsets[3] - (2.45 + 2.42)).abs() < 1e-12);
    }

    #[test]
    fn the_distance_at_a_piecewise_linear_speed_is_exact() {
        let points = [[1.0, 10.0], [3.0, 20.0], [4.0, 0.0]];
        for (t, v, run) in [(0.0, 10.0, 0.0), (1.0, 10.0, 10.0), (2.0, 15.0, 22.5), (3.0, 20.0, 40.0), (9.0, 0.0, 50.0)]
        {
            assert_eq!((speed_at(&points, t), distance(&points, t)), (v, run), "t = {t}");
        }
        // points before the start count for the speed at the start only
        assert_eq!(distance(&[[-2.0, 0.0], [2.0, 20.0]], 2.0), 30.0);
    }
}
