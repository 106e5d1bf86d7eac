//! Rules of runs in space between the sections, and what is plausible.

use crate::pieces::Pieces;
use crate::problem::Report;
use crate::ranges::judge;
use crate::resolve::Resolved;
use crate::spatial::sigma_of;
use crate::spec::SpaceSpec;
use crate::types::CarChoice;

pub(super) fn check(pieces: &Pieces, resolved: &Resolved, report: &mut Report) {
    if !pieces.has_space {
        for (i, choice) in pieces.cars.iter().enumerate() {
            if let Some(CarChoice::Data(car)) = choice
                && car.space.is_some()
            {
                let rule = "belongs to a run in space: the scenario needs a key `space` at its top";
                report.problem(format!("$.train.cars[{i}].space"), rule, "a plane run");
            }
        }
        return;
    }
    if let Some(train) = pieces.train.as_ref().filter(|train| !train.heading.is_forward()) {
        let rule =
            "must be forward in space: a train from the other end has its right side where the bridge has its left";
        report.problem("$.train.heading", rule, format!("{:?}", train.heading).to_lowercase());
    }
    if let Some(spatial) = &resolved.spatial {
        plausible(&spatial.spec, report);
    }
}

/// What engineers mistype; data that come with the program pass.
fn plausible(space: &SpaceSpec, report: &mut Report) {
    let mut positive = |what: &str, path: &str, value: f64| value <= 0.0 || judge(what, path, value, report);
    let (contact, track) = (&space.contact, &space.track);
    for (what, path, value) in [
        ("space.friction", "$.space.contact.friction", contact.friction),
        ("space.softness", "$.space.contact.softness", contact.softness),
        ("contact.hertz_constant", "$.space.contact.hertz_constant", contact.hertz_constant.unwrap_or(0.0)),
        ("section.modulus", "$.space.contact.modulus", contact.modulus),
        ("space.gauge", "$.space.track.gauge", track.gauge),
        ("space.back_to_back", "$.space.contact.back_to_back", contact.back_to_back),
        ("space.half_distance", "$.space.contact.taping_line", contact.taping_line),
        ("space.half_distance", "$.space.track.half_distance", track.half_distance),
        ("space.rail_lateral", "$.space.track.rail.lateral_bending_stiffness", track.lateral_bending_stiffness),
        ("space.rail_torsion", "$.space.track.rail.torsional_stiffness", track.torsional_stiffness),
        ("space.rail_polar", "$.space.track.rail.polar_inertia", track.polar_inertia),
        ("space.lateral_spring", "$.space.track.lateral.stiffness", track.lateral.stiffness),
        ("space.rolling_spring", "$.space.track.rolling.stiffness", track.rolling.stiffness),
    ] {
        positive(what, path, value);
    }
    for (path, profile) in [
        ("$.space.irregularity.alignment", &space.irregularity.alignment),
        ("$.space.irregularity.cross_level", &space.irregularity.cross_level),
        ("$.space.irregularity.gauge", &space.irregularity.gauge),
    ] {
        positive("irregularity.sigma", path, sigma_of(profile));
    }
    if let Some(wind) = &space.wind {
        use crate::spec::WindSpeed::{Place, Time};
        let (Time(points) | Place(points)) = &wind.speed;
        let fastest = points.iter().map(|[_, speed]| speed.abs()).fold(0.0, f64::max);
        positive("space.wind_speed", "$.space.wind", fastest);
        positive("space.wind_area", "$.space.wind.area", wind.area);
    }
    if let Some(ground) = &space.ground {
        let strongest = ground.accelerations.iter().flatten().map(|a| a.abs()).fold(0.0, f64::max);
        positive("space.ground_acceleration", "$.space.ground_motion", strongest);
    }
    // What cars have in common is said of the first.
    let Some(car) = space.cars.first() else { return };
    let path = "$.train.cars[0].space";
    let gyration = |i: usize, axis: usize| (car.bodies[i].inertia[axis] / car.bodies[i].mass).sqrt();
    positive("space.roll_gyration", &format!("{path}.body.roll"), gyration(0, 0));
    positive("space.roll_gyration", &format!("{path}.bogie.roll"), gyration(1, 0));
    positive("space.roll_gyration", &format!("{path}.wheelset.roll"), gyration(3, 0));
    positive("space.body_height", &format!("{path}.body_height"), car.bodies[0].height);
    positive("space.bogie_height", &format!("{path}.bogie_height"), car.bodies[1].height);
}
