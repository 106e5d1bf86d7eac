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

/// An independent program's values, for the Manchester car with the primary springs of the benchmark.
#[test]
fn cars_with_held_wheelsets_swing_at_their_known_frequencies() {
    let known = [
        (
            "manchester",
            "0.5955 0.8551 1.0739 1.2748 1.2991 7.4705 7.4772 9.6261 9.6427 11.7138 11.7138 12.8036 12.806 35.354 35.354",
        ),
        (
            "emu-a",
            "0.5845 0.8992 0.9535 1.1871 1.5395 6.5703 6.5916 7.945 7.9559 10.3847 10.3847 15.1093 15.1094 27.642 27.642",
        ),
    ];
    let source = "independent program; manchester with 1.22e6 N/m an axle box";
    let mut table = Table::new("cars in space with held wheelsets, Hz", source, crate::COMMAND);
    for (name, expected) in known {
        let own = frequencies(&Car::new(&of_benchmark(name)).unwrap());
        assert_eq!(own.len(), expected.split(' ').count());
        for (mode, (own, printed)) in (1..).zip(own.iter().zip(expected.split(' '))) {
            let expected: f64 = printed.parse().unwrap();
            // The last printed digit.
            let unit = 10_f64.powi(printed.find('.').unwrap() as i32 + 1 - printed.len() as i32);
            table.row(format!("{name}, mode {mode}"), expected, *own, 0.6 * unit / expected);
        }
    }
    table.finish();
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
    let mut table = Table::new("rail's head under 10 kN across, mm", "independent program", crate::COMMAND);
    for (place, part, expected) in
        [("over a support", 0.0, 0.9931), ("in mid-element", 0.5, 1.0013), ("between supports", 1.0, 1.0055)]
    {
        let point = line.point(middle, part, true);
        let factors = &lines.statics[1];
        let y = factors.between(2, &point, &point);
        let h = own.track.head_height;
        // One rail of two, whose matrices are twice those of one.
        let head = 2.0
            * 10e3
            * (y[0][0] + point.local[0] + h * (y[0][1] + y[1][0]) + h * h * (y[1][1] + point.local[1]))
            * 1e3;
        table.row(place, expected, head, 5.9e-5);
    }
    table.finish();
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

/// Cross-level of 10 mm and alignment of 5 mm under the whole car at its start: wheelsets lean and stand aside, and no wheel
/// jumps. (Bodies that stay upright press 2 Σ k b² φ through the primary springs.)
#[test]
fn wheels_at_rest_share_their_axles_load_on_rails_of_unequal_height() {
    let mut spec = spec("manchester", 40.0);
    let wave = |amplitude: f64| Wave { amplitude, wavelength: 4000.0, phase: std::f64::consts::FRAC_PI_2 };
    let whole = |amplitude: f64| Profile::Waves { waves: vec![wave(amplitude)], origin: 30.0, ramp: None };
    space(&mut spec).irregularity.cross_level = whole(10e-3);
    space(&mut spec).irregularity.alignment = whole(5e-3);
    space(&mut spec).contact.creep = Creep::None;
    let weight = Car::new(&space(&mut spec).cars[0]).unwrap().weight.iter().sum::<f64>();
    let mut instance = started(spec);
    for name in ["wheel[1].left.vertical_force", "wheel[1].right.vertical_force", "wheel[4].right.vertical_force"] {
        let q = value(&mut instance, name);
        assert!((8.0 * q / weight - 1.0).abs() < 1e-3, "{name}: {q} of {weight}");
    }
    for n in 0..100 {
        advance(&mut instance, n, 1e-3, [0.0; 3]);
        let q = value(&mut instance, "wheel[1].left.vertical_force");
        assert!(8.0 * q / weight > 0.5 && 8.0 * q / weight < 1.5, "step {n}: {q} of {weight}");
    }
}
