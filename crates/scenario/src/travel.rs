//! Where the wheels are: their places in the train, the distance the train has run, the abscissae they ever reach.

use crate::spec::{TrainTrackSpec, Vehicle};
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

/// As [`wheel_offsets`], of vehicles with any wheels.
#[must_use]
pub fn vehicle_offsets(vehicles: &[Vehicle]) -> Vec<f64> {
    let mut offsets = Vec::new();
    let mut front = 0.0; // of the vehicle, behind the front of the train
    for vehicle in vehicles {
        match vehicle {
            // Sums in the order of `wheel_offsets`, whose bits these are.
            Vehicle::Car(car) => {
                let centre = front + 0.5 * car.length;
                let (bogie, axle) = (0.5 * car.bogie_distance, 0.5 * car.wheelbase);
                offsets.extend([-bogie - axle, -bogie + axle, bogie - axle, bogie + axle].map(|arm| centre + arm));
            }
            Vehicle::Bodies(vehicle) => offsets.extend(vehicle.wheels.iter().map(|wheel| front + wheel.x)),
        }
        front += vehicle.length();
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

/// Over which a random irregularity fades in if the scenario does not say, m.
pub const DEFAULT_RAMP: f64 = 20.0;

/// Where a random irregularity begins to fade in if the scenario does not say, m: where the pre-roll of a train of this whole
/// `length` begins, or, without pre-roll, so that it has grown when the train's last wheel stands on it at the start.
/// `front` is the leading wheel, `wheels` the distance to the last one, m.
#[must_use]
pub fn fade_in(front: f64, wheels: f64, length: f64, pre_roll: f64) -> f64 {
    if pre_roll > 0.0 { front - (pre_roll + length) } else { front - wheels - DEFAULT_RAMP }
}

/// The time in s after which a train has run `way` m; `None` if it comes to a stop before. A `way` of 0 or less takes no time.
#[must_use]
pub fn time_of(points: &[[f64; 2]], way: f64) -> Option<f64> {
    if way <= 0.0 {
        return Some(0.0);
    }
    let mut run = 0.0;
    let mut from = 0.0;
    let later = points.iter().map(|point| point[0]).filter(|time| *time > 0.0);
    for to in later.chain([f64::INFINITY]) {
        let (v, length) = (speed_at(points, from), to - from);
        let acceleration = if to.is_finite() { (speed_at(points, to) - v) / length } else { 0.0 };
        let part = if to.is_finite() { (v + 0.5 * acceleration * length) * length } else { f64::INFINITY };
        if run + part >= way {
            // way − run = v t + a t²/2, in the form that is exact for a = 0 as well
            let rest = way - run;
            let t = 2.0 * rest / (v + (v * v + 2.0 * acceleration * rest).max(0.0).sqrt());
            return Some(from + t).filter(|t| t.is_finite());
        }
        (run, from) = (run + part, to);
    }
    None
}

impl TrainTrackSpec {
    /// Distance of every wheelset behind the leading one, m, in order from the front.
    #[must_use]
    pub fn offsets(&self) -> Vec<f64> {
        vehicle_offsets(&self.consist())
    }

    /// The abscissae between which wheels are during the pre-roll and the run, m.
    #[must_use]
    pub fn passage(&self) -> [f64; 2] {
        let last = self.offsets().last().copied().unwrap_or(0.0);
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
        // half a second after 1 s: 10 m, and 10 · 0.5 + 5 · 0.5²/2 m
        for (way, t) in [(0.0, 0.0), (-3.0, 0.0), (10.0, 1.0), (15.625, 1.5), (22.5, 2.0), (47.5, 3.5)] {
            let found = time_of(&points, way).unwrap();
            assert!((distance(&points, found) - way.max(0.0)).abs() < 1e-9, "{way}: {found}");
            assert!(way == 47.5 || (found - t).abs() < 1e-12, "{way}: {found}");
        }
        assert_eq!(time_of(&points, 50.1), None);
        assert_eq!(time_of(&[[0.0, 20.0]], 50.0), Some(2.5));
        assert_eq!(time_of(&[[0.0, 0.0]], 50.0), None);
        // points before the start count for the speed at the start only
        assert_eq!(distance(&[[-2.0, 0.0], [2.0, 20.0]], 2.0), 30.0);
    }
}
