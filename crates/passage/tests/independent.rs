//! Continuous beams, trains of annex D and EN 15528 and a user's train against another program: `moving_forces.py`, beside
//! this file, which has dense matrices, its own axles and Newmark's method with steps of 0.1 ms.

mod common;

use common::{beams, close, modal, peak, train};
use ttb_passage::{Heading, Passage, Quantity};
use ttb_trains::{Axle, ForceTrain};

/// Place, displacement in mm, acceleration in m/s².
type Row = (&'static str, f64, f64);

/// A case: spans with mass and EI, damping ratio, modes, train, km/h.
fn check(spans: &[[f64; 3]], ratio: f64, modes: usize, train: &ForceTrain, km_h: f64, rows: &[Row]) {
    let bridge = modal(&beams(spans, true, ratio, Some(modes)));
    let response = Passage::new(&bridge, train, Heading::Forward, Some(1.0)).at(km_h / 3.6);
    for (place, w, a) in rows {
        let what = format!("{} at {place} m", train.name);
        close(1e3 * peak(&bridge, &response, Quantity::Displacement, place), *w, 5e-3, &what);
        close(peak(&bridge, &response, Quantity::Acceleration, place), *a, 1e-2, &what);
    }
}

#[test]
fn two_and_three_continuous_spans_agree_with_another_program() {
    let two = [[24.0, 16e3, 50e9]; 2];
    check(&two, 0.01, 8, &train("ice2"), 290.0, &[("12", 2.3234, 0.8924), ("36", 2.4428, 0.9478)]);
    let three = [[20.0, 14e3, 60e9], [28.0, 14e3, 60e9], [20.0, 14e3, 60e9]];
    let wagons = train("en15528-d4x10");
    check(&three, 0.01, 8, &wagons, 110.0, &[("10", 2.0216, 0.3066), ("34", 3.9885, 0.3817)]);
}

#[test]
fn annex_d_and_a_user_s_train_agree_with_another_program() {
    check(&[[12.0, 10e3, 5e9]], 0.02, 3, &train("annex-d-5"), 80.0, &[("6", 5.1123, 1.2474)]);
    let loads = [(0.0, 180e3), (2.7, 180e3), (9.1, 150e3), (11.8, 160e3), (20.0, 90e3)];
    let axles = loads.into_iter().map(|(x, load)| Axle { x, load }).collect();
    let user = ForceTrain { name: "user".into(), axles, ..train("ice2") };
    check(&[[30.0, 18e3, 70e9]], 0.005, 3, &user, 180.0, &[("7.5", 3.6225, 0.3301), ("15", 5.2117, 0.3695)]);
}
