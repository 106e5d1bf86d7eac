//! Irregularities: known deviations, the same rail for the same seed, what a measured profile does between its samples.

use std::f64::consts::TAU;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use ttb_scenario::spec::Profile;
use ttb_scenario::types::{Ramp, RampShape};
use ttb_train_track::profile::Irregularity;
use ttb_train_track::profile::random::LEAST_PERIOD;

const PASSAGE: [f64; 2] = [0.0, 500.0];

fn random(spectrum: &str, wavelengths: [f64; 2], seed: u64, ramp: Option<Ramp>) -> Profile {
    let density = ttb_scenario::bundled::spectrum(spectrum).unwrap();
    Profile::Spectrum { density, seed, wavelengths, ramp }
}

/// At full size everywhere.
fn nowhere() -> Option<Ramp> {
    Some(Ramp { start: -1e9, length: 0.0, shape: RampShape::Quintic })
}

fn rail(spectrum: &str, wavelengths: [f64; 2], seed: u64) -> Irregularity {
    Irregularity::new(&random(spectrum, wavelengths, seed, nowhere()), 1.0, PASSAGE, None)
}

/// docs/theory.md 15, mm. Over a whole period the waves are orthogonal, so that a sample has its σ up to the grid of
/// Ω; over the wheels' passage it scatters, as it should.
#[test]
fn samples_have_the_known_standard_deviations() {
    let known = [
        ("german-low", [3.0, 25.0], 0.9843),
        ("german-high", [3.0, 25.0], 1.6109),
        ("german-low", [1.0, 80.0], 2.0740),
        ("german-high", [1.0, 80.0], 3.3943),
        ("sncf-good", [2.0, 40.0], 1.2837),
        ("sncf-poor", [2.0, 40.0], 2.4073),
        ("china-ballastless", [2.0, 120.0], 0.7150),
    ];
    for (name, wavelengths, expected) in known {
        for seed in [1, 2] {
            let rail = rail(name, wavelengths, seed);
            let values: Vec<f64> = (0..200_000).map(|i| 1e3 * rail.at(LEAST_PERIOD / 2e5 * i as f64)).collect();
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let sigma = (values.iter().map(|r| r * r).sum::<f64>() / values.len() as f64).sqrt();
            assert!(mean.abs() < 1e-9, "{name}: mean {mean} mm");
            assert!((sigma / expected - 1.0).abs() < 1e-3, "{name} {wavelengths:?}: {sigma} mm, known {expected} mm");
        }
    }
}

#[test]
fn the_table_is_as_close_to_the_sum_of_waves_as_it_says() {
    let (wavelengths, seed) = ([3.0, 25.0], 7);
    let density = ttb_scenario::bundled::spectrum("german-low").unwrap();
    let mut key = [0; 32];
    key[0] = seed as u8;
    let mut generator = ChaCha8Rng::from_seed(key);
    let spacing = TAU / LEAST_PERIOD;
    let phases: Vec<f64> = (0..1365).map(|_| TAU * (generator.next_u64() >> 11) as f64 / 2f64.powi(53)).collect();
    let sum = |x: f64| -> f64 {
        let waves = (164..=1365).map(|k| {
            let omega = k as f64 * spacing;
            let width =
                spacing * ((k as f64 + 0.5).min(LEAST_PERIOD / 3.0) - (k as f64 - 0.5).max(LEAST_PERIOD / 25.0));
            (2.0 * density.value(omega) * width).sqrt() * (omega * x + phases[k - 1]).cos()
        });
        waves.sum()
    };
    let rail = rail("german-low", wavelengths, seed);
    let error = (0..500).map(|i| 0.7123 * i as f64 - 50.0).map(|x| (rail.at(x) - sum(x)).abs()).fold(0.0, f64::max);
    assert!(error < 5e-10, "{error} m, of a rail with σ = 1e-3 m");
}

#[test]
fn the_same_seed_gives_the_same_rail_for_every_passage_and_band() {
    let profile = random("sncf-good", [2.0, 40.0], 3, nowhere());
    let short = Irregularity::new(&profile, 1.0, [0.0, 200.0], None);
    let long = Irregularity::new(&profile, 1.0, [-700.0, 1300.0], None);
    let other = Irregularity::new(&profile, 1.0, [0.0, 200.0], Some(4));
    let named = Irregularity::new(&random("sncf-good", [2.0, 40.0], 4, nowhere()), 1.0, [0.0, 200.0], None);
    for x in [-3.0, 0.0, 17.23, 100.0] {
        assert_eq!(short.at(x), long.at(x));
        assert_eq!(other.at(x), named.at(x));
        assert_ne!(short.at(x), other.at(x));
    }
    // two bands side by side make up the whole: no phase depends on the band
    let band = |wavelengths| Irregularity::new(&random("sncf-good", wavelengths, 3, nowhere()), 1.0, PASSAGE, None);
    let between = LEAST_PERIOD / 409.5; // two waves
    let (all, upper, lower) = (band([2.0, 40.0]), band([2.0, between]), band([between, 40.0]));
    for x in [1.0, 77.7, 300.3] {
        assert!((all.at(x) - upper.at(x) - lower.at(x)).abs() < 1e-8);
    }
}

/// From a separate program with its own ChaCha8 that sums the waves one by one, at points of the table. These values
/// must never change, or stored results could not be repeated.
#[test]
fn a_seed_gives_the_rail_it_always_gave() {
    let rail = rail("german-low", [3.0, 80.0], 1);
    let known = [
        (0.0, 4.641854569426232e-3),
        (123.4375, 3.0352596692820605e-3),
        (-10.0, 2.460476972097553e-3),
        (2000.5, 2.0027121473694606e-3),
    ];
    for (x, expected) in known {
        assert!((rail.at(x) - expected).abs() < 1e-14, "r({x}) = {:e}, always {expected:e}", rail.at(x));
    }
}

#[test]
fn a_random_irregularity_fades_in_over_20_m_from_where_the_passage_begins() {
    let rail = Irregularity::new(&random("german-low", [3.0, 80.0], 1, None), 2.0, [100.0, 400.0], None);
    let full = crate::rail("german-low", [3.0, 80.0], 1);
    assert_eq!(rail.at(99.9), 0.0);
    assert_eq!(rail.at(100.0), 0.0);
    assert!((rail.at(110.0) - full.at(110.0)).abs() < 1e-15); // half of twice
    assert!((rail.at(120.0) - 2.0 * full.at(120.0)).abs() < 1e-15);
}

#[test]
fn a_table_goes_on_over_its_seam() {
    let rail = rail("german-low", [3.0, 80.0], 5);
    let h = 1e-7;
    for x in [0.0, LEAST_PERIOD, -LEAST_PERIOD] {
        assert!((rail.at(x + h) - rail.at(x - h)).abs() < 1e-8);
        assert!((rail.at(x) - rail.at(0.0)).abs() < 1e-15);
    }
}

#[test]
fn samples_are_met_joined_smoothly_and_held_outside() {
    let (x, r) = (vec![0.0, 1.0, 1.5, 4.0, 5.0], vec![1e-3, 2e-3, 1.5e-3, -1e-3, 0.5e-3]);
    let rail = Irregularity::new(&Profile::Samples { x: x.clone(), r: r.clone(), ramp: None }, 1.0, PASSAGE, None);
    for (x, r) in x.iter().zip(&r) {
        assert!((rail.at(*x) - r).abs() < 1e-18);
        let h = 1e-6;
        let (left, right) = ((rail.at(*x) - rail.at(x - h)) / h, (rail.at(x + h) - rail.at(*x)) / h);
        assert!((left - right).abs() < 1e-7, "slope at {x}: {left} and {right}");
    }
    assert_eq!((rail.at(-9.0), rail.at(99.0)), (1e-3, 0.5e-3));
    // a parabola is met inside, whatever the spacing
    let x: Vec<f64> = [0.0, 0.7, 1.0, 2.0, 2.2, 3.0].to_vec();
    let r: Vec<f64> = x.iter().map(|x| 1e-3 * x * x).collect();
    let rail = Irregularity::new(&Profile::Samples { x, r, ramp: None }, 1.0, PASSAGE, None);
    assert!((rail.at(1.6) - 2.56e-3).abs() < 1e-15);
}
