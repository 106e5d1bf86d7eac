//! A car's data in space → bodies and links.
//!
//! ```text
//! primary    (±L_t, ±b_p, h_b − h_p) on the bogie    to (0, ±b_p, r0 − h_p) on the wheelset
//! secondary  (±L_c, ±b_s, h_c − h_s) on the body     to (0, ±b_s, h_b − h_s) on the bogie; dampers at places of their own
//! ```
//!
//! Vertical values are half of the plane ones. A shear spring acts at one height, the mean of its two ends.

use crate::problem::Report;
use crate::spec::{LinkLaw, SpaceBody, SpaceCar, SpaceLink};
use crate::types::{Car, CarInSpace};

/// `path` is that of the data, unless they are bundled.
pub(super) fn resolve(
    car: &Car,
    space: &CarInSpace,
    radius: f64,
    path: Option<&str>,
    report: &mut Report,
) -> Option<SpaceCar> {
    if let Some(path) = path
        && !check(space, path, report)
    {
        return None;
    }
    let radius = space.wheel_radius.unwrap_or(radius);
    let (half_base, half_pivots) = (0.5 * car.wheelbase, 0.5 * car.bogie_distance);
    let body = |mass, inertia, x, height| SpaceBody { mass, inertia, x, height };
    let mut bodies =
        vec![body(car.body_mass, [space.body.roll, car.body_inertia, space.body.yaw], 0.0, space.body_height)];
    for end in [1.0, -1.0] {
        let inertia = [space.bogie.roll, car.bogie_inertia, space.bogie.yaw];
        bodies.push(body(car.bogie_mass, inertia, end * half_pivots, space.bogie_height));
    }
    let axle = [space.wheelset.roll, space.wheelset.spin, space.wheelset.yaw];
    for (end, side) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        bodies.push(body(car.wheelset_mass, axle, end * half_pivots + side * half_base, radius));
    }
    let mut links = Vec::new();
    for (bogie, end) in [(1, 1.0), (2, -1.0)] {
        secondary(car, space, bogie, end * half_pivots, &mut links);
        for (axle, along) in [(0, half_base), (1, -half_base)] {
            primary(car, space, [bogie, 2 * bogie + 1 + axle], along, radius, &mut links);
        }
    }
    Some(SpaceCar { wheel_radius: radius, bodies, links })
}

fn primary(car: &Car, space: &CarInSpace, between: [usize; 2], along: f64, radius: f64, links: &mut Vec<SpaceLink>) {
    let p = &space.primary;
    let law = LinkLaw::Linear {
        stiffness: [p.longitudinal_stiffness, p.lateral_stiffness, 0.5 * car.primary_stiffness],
        damping: [p.longitudinal_damping, p.lateral_damping, 0.5 * car.primary_damping],
    };
    for y in [-p.half_distance, p.half_distance] {
        let at = [[along, y, space.bogie_height - p.height], [0.0, y, radius - p.height]];
        links.push(SpaceLink { between, at, law: law.clone() });
    }
}

fn secondary(car: &Car, space: &CarInSpace, bogie: usize, along: f64, links: &mut Vec<SpaceLink>) {
    let (s, between) = (&space.secondary, [0, bogie]);
    let place = |y: f64, height: f64| [[along, y, space.body_height - height], [0.0, y, space.bogie_height - height]];
    let mut add = |y: f64, height: f64, law: LinkLaw| links.push(SpaceLink { between, at: place(y, height), law });
    let linear = |stiffness, damping| LinkLaw::Linear { stiffness, damping };
    let springs = &s.springs;
    let lateral_height = s.lateral_damper_height.unwrap_or(springs.height);
    let vertical_width = s.vertical_damper_half_distance.unwrap_or(springs.half_distance);
    for side in [-1.0, 1.0] {
        let y = side * springs.half_distance;
        let stiffness = [springs.longitudinal_stiffness, springs.lateral_stiffness, 0.5 * car.secondary_stiffness];
        add(y, springs.height, linear(stiffness, [springs.longitudinal_damping, 0.0, 0.0]));
        if springs.lateral_damping > 0.0 {
            add(y, lateral_height, linear([0.0; 3], [0.0, springs.lateral_damping, 0.0]));
        }
        let vertical = 0.5 * car.secondary_damping;
        if vertical > 0.0 {
            add(side * vertical_width, springs.height, linear([0.0; 3], [0.0, 0.0, vertical]));
        }
        if let Some(damper) = &s.yaw_damper {
            let law = match (damper.blow_off, damper.series_stiffness) {
                (None, None) => linear([0.0; 3], [damper.damping, 0.0, 0.0]),
                (blow_off, series) => LinkLaw::Damper {
                    axis: 0,
                    damping: damper.damping,
                    blow_off,
                    beyond: damper.damping_beyond,
                    series,
                },
            };
            add(side * damper.half_distance, damper.height, law);
        }
    }
    if let Some(stiffness) = s.anti_roll.filter(|stiffness| *stiffness > 0.0) {
        add(0.0, springs.height, LinkLaw::Rotation { axis: 0, stiffness, damping: 0.0 });
    }
    if let Some(stop) = &s.bump_stop {
        let law = LinkLaw::Stop { axis: 1, points: stop.points.clone() };
        add(0.0, stop.height.unwrap_or(lateral_height), law);
    }
}

/// Rules between the numbers of a car's data; true if all are kept.
fn check(space: &CarInSpace, path: &str, report: &mut Report) -> bool {
    let before = report.problems.len();
    if space.body_height <= space.bogie_height {
        let rule = "the body's centre of gravity must be above the bogies'";
        report.problem(
            format!("{path}.body_height"),
            rule,
            format!("{} ≤ {} m", space.body_height, space.bogie_height),
        );
    }
    if let Some(stop) = &space.secondary.bump_stop {
        let path = format!("{path}.secondary.bump_stop.points");
        if let Some([gap, force]) = stop.points.first()
            && (*gap < 0.0 || *force != 0.0)
        {
            report.problem(format!("{path}[0]"), "must be [gap, 0] with gap ≥ 0", format!("[{gap}, {force}]"));
        }
        for (i, pair) in stop.points.windows(2).enumerate() {
            if pair[1][0] <= pair[0][0] || pair[1][1] < pair[0][1] {
                let found = format!("[{}, {}] after [{}, {}]", pair[1][0], pair[1][1], pair[0][0], pair[0][1]);
                report.problem(format!("{path}[{}]", i + 1), "points must rise in m and must not fall in N", found);
            }
        }
    }
    if let Some(damper) = &space.secondary.yaw_damper {
        let path = format!("{path}.secondary.yaw_damper");
        if damper.blow_off.is_some() && damper.damping_beyond > damper.damping {
            let rule = "damping beyond the blow-off force must not be greater than below it";
            report.problem(
                format!("{path}.damping_beyond"),
                rule,
                format!("{} > {} N s/m", damper.damping_beyond, damper.damping),
            );
        }
        if damper.blow_off.is_none() && damper.damping_beyond > 0.0 {
            report.problem(
                format!("{path}.damping_beyond"),
                "needs a blow_off force beyond which it counts",
                damper.damping_beyond,
            );
        }
    }
    report.problems.len() == before
}
