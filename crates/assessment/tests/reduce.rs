//! Histories reduced to rows, on signals whose answers are known.

use std::f64::consts::PI;

use ttb_assessment::criterion::DEFAULT;
use ttb_assessment::reduce::{AxleHistory, CarHistory, PointHistory};
use ttb_assessment::{Criteria, Facts, Histories, Peak, Reduced, Statistic, reduce};

fn time(n: usize, h: f64) -> Vec<f64> {
    (0..n).map(|i| i as f64 * h).collect()
}

fn reduced(histories: &Histories) -> Reduced {
    reduce(histories, &Criteria::bundled(DEFAULT).expect("bundled"), &Facts::default())
}

fn row<'a>(reduced: &'a Reduced, quantity: &str, filter: &str, statistic: Statistic, place: &str) -> &'a Peak {
    let is = |p: &&Peak| p.quantity == quantity && p.filter == filter && p.statistic == statistic && p.place == place;
    reduced.peaks.iter().find(is).unwrap_or_else(|| panic!("{quantity} {filter} {statistic} {place}"))
}

#[test]
fn a_wheel_that_lifts_off_shows_both_the_filtered_value_and_its_losses() {
    // 21 ms without contact at 50 m/s, once on the bridge, once before it.
    let time = time(2000, 1e-3);
    let mut force = vec![160e3; 2000];
    force[300..310].fill(0.0);
    force[1000..1021].fill(0.0);
    let position: Vec<f64> = time.iter().map(|t| 10.0 + 50.0 * t).collect();
    let axles = vec![AxleHistory { number: 3, force, position, static_load: 160e3, ..AxleHistory::default() }];
    let found = reduced(&Histories { time, axles, bridge: Some([50.0, 80.0]), ..Histories::default() });
    let unloading = |filter: &str| row(&found, "wheel.unloading", filter, Statistic::Max, "3").value;
    assert_eq!(unloading("raw"), 1.0);
    // 1.05 m of 2 m without load.
    assert!((unloading("mean-2m") - 21.0 * 0.05 / 2.0).abs() < 1e-9, "{}", unloading("mean-2m"));
    assert!(unloading("butterworth-4-20Hz-zero") < 0.9 && unloading("butterworth-4-20Hz-zero") > 0.4);
    let loss = |quantity: &str, statistic| row(&found, quantity, "raw", statistic, "3").clone();
    assert_eq!(loss("wheel.contact-loss", Statistic::Count).value, 2.0);
    assert!((loss("wheel.contact-loss", Statistic::Sum).value - 0.031).abs() < 1e-12);
    let longest = loss("wheel.contact-loss", Statistic::Max);
    assert!((longest.value - 0.021).abs() < 1e-12 && longest.x == Some(60.0) && longest.time == Some(1.0));
    assert_eq!(loss("wheel.contact-loss-on-bridge", Statistic::Count).value, 1.0);
    assert!((loss("wheel.contact-loss-way", Statistic::Max).value - 1.05).abs() < 1e-9);
    let load = row(&found, "wheel.load", "raw", Statistic::Max, "3");
    assert_eq!((load.value, load.static_value), (80e3, Some(80e3)));
}

#[test]
fn a_filter_sees_no_unloading_in_a_load_that_is_there_from_the_beginning() {
    let axles = vec![AxleHistory {
        number: 1,
        force: vec![100e3; 500],
        position: vec![],
        static_load: 100e3,
        ..AxleHistory::default()
    }];
    let found = reduced(&Histories { time: time(500, 1e-3), axles, ..Histories::default() });
    for filter in ["raw", "butterworth-4-20Hz-zero", "butterworth-4-20Hz-causal"] {
        assert!(row(&found, "wheel.unloading", filter, Statistic::Max, "1").value.abs() < 1e-12);
    }
}

#[test]
fn a_body_is_judged_at_its_centre_and_over_its_bogies() {
    let time = time(8000, 1e-3);
    let tone = |f: f64, a: f64| time.iter().map(|t| a * (2.0 * PI * f * t).sin()).collect::<Vec<_>>();
    let car = CarHistory {
        number: 2,
        acceleration: tone(1.2, 0.5),
        pitch_acceleration: tone(1.2, -0.1),
        half_base: Some(8.0),
        ..CarHistory::default()
    };
    let found = reduced(&Histories { time: time.clone(), cars: vec![car], ..Histories::default() });
    let body = |place| row(&found, "body.acceleration", "raw", Statistic::AbsMax, place).value;
    assert!(
        (body("2") - 0.5).abs() < 1e-4 && (body("2 front") - 0.3).abs() < 1e-4 && (body("2 rear") - 1.3).abs() < 1e-4
    );
    let n_mv = found.missing.iter().find(|missing| missing.quantity == "body.comfort-n-mv").expect("not judged");
    assert_eq!(n_mv.reason, "N_MV of EN 12299 needs 300 s; the record has 8");
    assert!(row(&found, "body.sperling", "raw", Statistic::Value, "2").value > 2.0);
    assert!(row(&found, "body.acceleration", "wk", Statistic::Rms5sMax, "2").value > 0.1);
}

#[test]
fn a_record_that_is_too_coarse_or_uneven_says_so() {
    let point = PointHistory { name: "mid".into(), acceleration: vec![1.0; 100], ..PointHistory::default() };
    let points = vec![point];
    let found = reduced(&Histories { time: time(100, 5e-3), points: points.clone(), ..Histories::default() });
    assert_eq!(row(&found, "deck.acceleration", "raw", Statistic::AbsMax, "mid").value, 1.0);
    let missing = found.missing.iter().find(|missing| missing.quantity == "deck.acceleration").expect("30 Hz");
    assert!(missing.reason.contains("needs at least 300 values a second; the record has 200"), "{}", missing.reason);
    let mut uneven = time(100, 5e-3);
    uneven[50] += 1e-3;
    let found = reduced(&Histories { time: uneven, points, ..Histories::default() });
    assert!(found.peaks.is_empty() && found.missing.iter().all(|missing| missing.reason.contains("not equal")));
}
