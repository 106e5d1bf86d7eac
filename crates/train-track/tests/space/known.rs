//! Known answers: natural frequencies, static deflection of the rail's head.

use super::*;
use ttb_train_track::space::car::{Car, DOFS, FIRST_WHEELSET};
use ttb_train_track::space::prepared::Lines;
use ttb_train_track::track::FastenerFactors;

/// Natural frequencies with all wheelsets held, Hz, from K x = ω² M x.
fn frequencies(car: &Car) -> Vec<f64> {
    let n = FIRST_WHEELSET;
    let scaled = nalgebra::DMatrix::from_fn(n, n, |i, j| car.stiffness[(i, j)] / (car.mass[i] * car.mass[j]).sqrt());
    let mut hertz: Vec<f64> =
        scaled.symmetric_eigenvalues().iter().map(|x| x.max(0.0).sqrt() / std::f64::consts::TAU).collect();
    hertz.sort_by(f64::total_cmp);
    hertz
}

/// An independent program's values for the primary springs of the benchmark, 1.22e6 N/m an axle box.
#[test]
fn the_manchester_car_swings_at_its_known_frequencies() {
    let mut spec = spec("manchester", 40.0);
    for link in &mut space(&mut spec).cars[0].links {
        if let ttb_scenario::spec::LinkLaw::Linear { stiffness, .. } = &mut link.law
            && stiffness[2] == 1.2e6
        {
            stiffness[2] = 1.22e6;
        }
    }
    let own = frequencies(&Car::new(&space(&mut spec).cars[0]).unwrap());
    let known = [
        0.5955, 0.8551, 1.0739, 1.2748, 1.2991, 7.4705, 7.4772, 9.6261, 9.6427, 11.7138, 11.7138, 12.8036, 12.806,
        35.354, 35.354,
    ];
    for (own, known) in own.iter().zip(known) {
        let last = if known > 30.0 { 6e-4 } else { 6e-5 };
        assert!((own - known).abs() < last + 5e-4 * f64::from(u8::from(known == 12.806)), "{own} instead of {known}");
    }
}

#[test]
fn a_rigid_motion_strains_no_suspension() {
    let mut spec = spec("manchester", 40.0);
    let car = Car::new(&space(&mut spec).cars[0]).unwrap();
    // y, z, roll about the rail's top, yaw about the middle of the car.
    for kind in 0..4 {
        let mut q = [0.0; DOFS];
        for (body, [x, height]) in car.centres.iter().enumerate() {
            let at = 5 * body;
            match kind {
                0 => q[at] = 1.0,
                1 => q[at + 1] = 1.0,
                2 => (q[at], q[at + 2]) = (*height, 1.0),
                _ => (q[at], q[at + 4]) = (*x, 1.0),
            }
        }
        let force = &car.stiffness * nalgebra::DVector::from_column_slice(&q);
        assert!(force.amax() < 1e-6, "{kind}: {}", force.amax());
    }
}

/// 60E1 on 2e7 N/m and 5e7·0.15²/12 N m each 0.65 m, 10 kN at the head: over a support, in mid-element, between supports.
#[test]
fn the_rails_head_gives_way_by_its_known_distance() {
    let mut spec = spec("manchester", 40.0);
    spec.elements_per_bay = 2;
    let own = space(&mut spec);
    own.track.lateral_bending_stiffness = 2.1e11 * 5.123e-6;
    own.track.torsional_stiffness = 8.1e10 * 2.2e-6;
    (own.track.head_height, own.track.foot_height) = (0.0911, 0.0809);
    own.track.lateral.stiffness = 2e7;
    own.track.rolling.stiffness = 5e7 * 0.15 * 0.15 / 12.0;
    let own = own.clone();
    let lines = Lines::new(&spec, &own, FastenerFactors::default()).unwrap();
    // Sums: both rails pushed to the right; the middle support is far from the ends.
    let (line, _) = &lines.lines[1];
    let middle = line.nodes() / 2 / 2 * 2;
    for (part, expected) in [(0.0, 0.9931), (0.5, 1.0013), (1.0, 1.0055)] {
        let point = line.point(middle, part, true);
        let factors = &lines.statics[1];
        let y = factors.between(2, &point, &point);
        let h = own.track.head_height;
        // One rail of two, whose matrices are twice those of one.
        let head = 2.0
            * 10e3
            * (y[0][0] + point.local[0] + h * (y[0][1] + y[1][0]) + h * h * (y[1][1] + point.local[1]))
            * 1e3;
        assert!((head - expected).abs() < 6e-5, "{part}: {head} instead of {expected} mm");
    }
}

/// Without creep, at rest on straight track: every wheel carries an eighth of the car, though rails spread and roll.
#[test]
fn wheels_at_rest_share_the_cars_weight() {
    let mut spec = spec("manchester", 40.0);
    space(&mut spec).contact.creep = Creep::None;
    let weight = Car::new(&space(&mut spec).cars[0]).unwrap().weight.iter().sum::<f64>();
    let mut instance = started(spec);
    for name in ["wheel[1].left.vertical_force", "wheel[4].right.vertical_force"] {
        let q = value(&mut instance, name);
        assert!((8.0 * q / weight - 1.0).abs() < 1e-9, "{name}: {q} of {weight}");
    }
}
