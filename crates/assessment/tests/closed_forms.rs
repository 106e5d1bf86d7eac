//! Dynamic factors, limits of n₀, damping and statistics of samples against worked numbers.

use ttb_assessment::amplification::{
    Material, additional_damping, damping, k, n0_lower, n0_upper, phi_2, phi_3, phi_double_prime, phi_dyn, phi_prime,
};
use ttb_assessment::sample::{Sample, Seeded, confidence, least_number};

fn near(found: f64, expected: f64, digits: i32) {
    assert!((found - expected).abs() <= 0.5 * 10f64.powi(-digits) * 1.0001, "{found}, expected {expected}");
}

#[test]
fn factors_of_annex_c_for_a_span_of_25_m() {
    let (v, l) = (69.444, 25.0);
    let n0 = std::f64::consts::PI / (2.0 * l * l) * (30e9_f64 / 15e3).sqrt();
    near(k(v, l, n0), 0.39076, 5);
    near(phi_prime(v, l, n0), 0.61775, 5);
    near(phi_double_prime(v, l, n0), 0.01269, 5);
    assert_eq!(phi_prime(1000.0, l, n0), 1.325);
    assert_eq!((phi_dyn(3.0, 2.0), phi_dyn(-3.0, 2.0), phi_dyn(1.0, 0.0)), (Some(0.5), Some(0.5), None));
}

#[test]
fn dynamic_factors_and_limits_of_the_first_frequency() {
    near(phi_2(10.0), 1.30611, 5);
    near(phi_3(10.0), 1.45917, 5);
    assert_eq!((phi_2(1.0), phi_3(1.0), phi_2(200.0), phi_3(200.0)), (1.67, 2.0, 1.0, 1.0));
    near(n0_upper(20.0), 10.0799, 4);
    near(n0_lower(20.0).expect("in range"), 4.0, 4);
    assert_eq!((n0_lower(3.0), n0_lower(101.0)), (None, None));
}

#[test]
fn damping_of_the_code() {
    near(100.0 * additional_damping(10.0), 0.32888, 5);
    assert_eq!(additional_damping(30.0), 0.0);
    near(damping(Material::Steel, 10.0), 0.0175, 6);
    near(damping(Material::Prestressed, 10.0), 0.017, 6);
    near(damping(Material::Reinforced, 40.0), 0.015, 6);
}

#[test]
fn a_sample_says_what_its_number_allows() {
    let values: Vec<Seeded> = (1..=20).map(|seed| Seeded { seed, value: seed as f64 }).collect();
    let sample = Sample::of(&values).expect("a sample");
    assert_eq!((sample.n, sample.mean, sample.min, sample.max, sample.seed_of_max), (20, 10.5, 1.0, 20.0, 20));
    near(sample.p95, 19.05, 9);
    near(sample.deviation.expect("twenty values"), 35f64.sqrt(), 9);
    near(sample.confidence, 1.0 - 0.95f64.powi(20), 9);
    assert!(confidence(58, 0.95) < 0.95 && confidence(59, 0.95) >= 0.95);
    assert_eq!((least_number(0.95, 0.95), least_number(0.98, 0.95)), (59, 149));
    let one = Sample::of(&[Seeded { seed: 3, value: 2.0 }]).expect("one value");
    assert_eq!((one.deviation, one.p95, one.seed_of_max), (None, 2.0, 3));
    assert!(Sample::of(&[]).is_none() && Sample::of(&[Seeded { seed: 1, value: f64::NAN }]).is_none());
    let equal = Sample::of(&[Seeded { seed: 9, value: 2.0 }, Seeded { seed: 4, value: 2.0 }]).expect("two");
    assert_eq!(equal.seed_of_max, 4);
}
