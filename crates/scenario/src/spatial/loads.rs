//! Curve, wind and ground motion.

use std::path::Path;

use super::columns;
use crate::ground::GroundSeries;
use crate::problem::Report;
use crate::spec::{WindSpec, WindSpeed};
use crate::types::{Curve, GroundMotion, Wind};

/// Distance of the wheels' contact points that cant is given over, m.
const BASE_OF_CANT: f64 = 1.5;
/// Below this radius the model has not been tried, m.
const LEAST_RADIUS: f64 = 150.0;

/// Points (x, curvature, cant angle).
pub(super) fn curve(curve: &Curve, report: &mut Report) -> Option<Vec<[f64; 3]>> {
    let base = "$.space.curve";
    if curve.radius.abs() < LEAST_RADIUS {
        let rule = format!("a radius must have at least {LEAST_RADIUS} m, positive to the right");
        report.problem(format!("{base}.radius"), rule, format!("{} m", curve.radius));
        return None;
    }
    if let Some(end) = curve.end
        && end < curve.begin + 2.0 * curve.transition
    {
        let rule = "the curve must be at least as long as both transitions";
        let found = format!("{} to {end} m with transitions of {} m", curve.begin, curve.transition);
        report.problem(format!("{base}.end"), rule, found);
        return None;
    }
    let full = [1.0 / curve.radius, curve.radius.signum() * libm::asin(curve.cant / BASE_OF_CANT)];
    let mut points = vec![[curve.begin, 0.0, 0.0], [curve.begin + curve.transition, full[0], full[1]]];
    if let Some(end) = curve.end {
        let back = end - curve.transition;
        if back > points[1][0] {
            points.push([back, full[0], full[1]]);
        }
        points.push([end, 0.0, 0.0]);
    }
    Some(points)
}

pub(super) fn wind(wind: &Wind, base_dir: &Path, report: &mut Report) -> Option<WindSpec> {
    let base = "$.space.wind";
    let (speed, key) = match (&wind.over_time, &wind.over_place) {
        (Some(points), None) => (Some(WindSpeed::Time(points.clone())), "over_time"),
        (None, Some(points)) => (Some(WindSpeed::Place(points.clone())), "over_place"),
        (both, _) => {
            let found = if both.is_some() { "both" } else { "neither" };
            report.problem(base, "must have exactly one of the keys over_time, over_place", found);
            (None, "")
        }
    };
    if let Some(WindSpeed::Time(points) | WindSpeed::Place(points)) = &speed {
        for (i, pair) in points.windows(2).enumerate().filter(|(_, pair)| pair[1][0] <= pair[0][0]) {
            let found = format!("{} after {}", pair[1][0], pair[0][0]);
            report.problem(format!("{base}.{key}[{}][0]", i + 1), "must increase", found);
        }
    }
    let path = format!("{base}.coefficients");
    let asked: [&[&str]; 2] = [&["beta_deg", "side", "lift", "roll"], &[]];
    let columns = columns(&wind.coefficients, base_dir, asked, &path, report)?;
    let [angle, side, lift, roll] = <[_; 4]>::try_from(columns).ok()?;
    let (angle, side, lift, roll) = (angle?, side?, lift?, roll?);
    if angle.first().is_some_and(|angle| *angle != 0.0) || angle.last().is_some_and(|angle| *angle > 90.0) {
        let found = format!("{:?} to {:?}", angle.first(), angle.last());
        report.problem(path, "beta_deg must begin at 0 and end at 90 at the most", found);
        return None;
    }
    let rows = angle.iter().zip(side).zip(lift).zip(roll);
    Some(WindSpec {
        speed: speed?,
        density: wind.density,
        area: wind.area,
        length: wind.length,
        height: wind.moment_height,
        coefficients: rows.map(|(((angle, side), lift), roll)| [angle.to_radians(), side, lift, roll]).collect(),
    })
}

pub(super) fn ground(ground: &GroundMotion, base_dir: &Path, report: &mut Report) -> Option<GroundSeries> {
    let path = "$.space.ground_motion.file";
    let asked: [&[&str]; 2] = [&["t"], &["acceleration_y", "acceleration_z"]];
    let columns = columns(&ground.file, base_dir, asked, path, report)?;
    let [times, y, z] = <[_; 3]>::try_from(columns).ok()?;
    if y.is_none() && z.is_none() {
        report.problem(path, "must have a column acceleration_y or acceleration_z", &ground.file);
        return None;
    }
    let times = times?;
    let at = |list: &Option<Vec<f64>>, i: usize| list.as_ref().map_or(0.0, |list| ground.scale * list[i]);
    let accelerations = (0..times.len()).map(|i| [at(&y, i), at(&z, i)]).collect();
    let series = GroundSeries::new(times.iter().map(|t| t + ground.start).collect(), accelerations);
    Some(if ground.baseline { series.at_rest_in_the_end() } else { series })
}
