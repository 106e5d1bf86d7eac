//! The two traps of a short, coarse track model, and how far the cure reaches: the local flexibility of the rail under a
//! load inside an element, and cars that ring from a start at rest.

mod common;

use common::{spec, started, value};
use ttb_scenario::spec::{Density, Profile, TrainTrackSpec};
use ttb_scenario::types::{Ramp, RampShape};

/// Histories of some variables, one row a step.
fn histories(spec: TrainTrackSpec, steps: usize, names: &[&str]) -> Vec<Vec<f64>> {
    let h = spec.step;
    let mut instance = started(spec);
    let row = |n: usize| {
        instance.step(n as f64 * h, h).unwrap();
        names.iter().map(|name| value(&mut instance, name)).collect()
    };
    (0..steps).map(row).collect()
}

/// Largest difference of column `i` in rows from `from` on, relative to its greatest deviation from its mean.
fn difference(a: &[Vec<f64>], b: &[Vec<f64>], i: usize) -> f64 {
    let mean = b.iter().map(|r| r[i]).sum::<f64>() / b.len() as f64;
    let scale = b.iter().map(|r| (r[i] - mean).abs()).fold(0.0, f64::max);
    a.iter().zip(b).map(|(a, b)| (a[i] - b[i]).abs()).fold(0.0, f64::max) / scale
}

fn rough(spec: &mut TrainTrackSpec, start: f64) {
    let density = Density::German { a: 4.032e-7, omega_c: 0.8246, omega_r: 0.0206 };
    let ramp = Some(Ramp { start, length: 20.0, shape: RampShape::Quintic });
    spec.irregularity = Profile::Spectrum { density, seed: 7, wavelengths: [2.0, 60.0], ramp };
}

#[test]
fn local_compliance_makes_up_for_few_elements() {
    let run = |per_bay: usize, local: bool| {
        let mut spec = spec();
        (spec.elements_per_bay, spec.local_compliance, spec.step) = (per_bay, local, 5e-4);
        rough(&mut spec, 30.0);
        histories(spec, 500, &["wheel[1].contact_force"])
    };
    let fine = run(6, true);
    for (per_bay, most) in [(1, 0.03), (2, 0.005)] {
        let [with, without] = [true, false].map(|local| difference(&run(per_bay, local), &fine, 0));
        assert!(with < most && without > 4.0 * with, "{per_bay} a bay: with {with:.4}, without {without:.4}");
    }
}

#[test]
fn a_support_beyond_the_track_is_refused_wherever_it_stands_in_the_list() {
    for place in [0, 5, 29] {
        let mut spec = spec();
        spec.on_bridge[place] = 1 << 53;
        let error = ttb_train_track::TrainTrack::new(spec).err().expect("a refusal");
        assert!(error.0.contains("beyond the track"), "{error}");
    }
}

#[test]
fn pre_rolled_cars_run_as_after_a_long_approach() {
    // Both roll 520 m over the same rail before the comparison begins 20 m further on.
    let track = |from: f64, front: f64, pre_roll: f64| {
        let mut spec = spec();
        (spec.from, spec.front_wheel, spec.pre_roll) = (from, front, pre_roll);
        spec.bays = ((730.0 - from) / 0.65) as usize;
        spec.on_bridge = vec![spec.bays - 2];
        rough(&mut spec, 80.0);
        spec
    };
    let names = ["car[1].acceleration", "wheel[1].contact_force", "car[1].front_bogie_acceleration"];
    let v = 250.0 / 3.6;
    // A whole number of steps, so that both are compared at the same places.
    let lead = (520.0 / v / 1e-3_f64).round() as usize;
    let front = 80.0 + lead as f64 * 1e-3 * v;
    let long = histories(track(0.0, 80.0, 0.0), lead + 1200, &names);
    let length = common::trailer().length;
    // The short track begins on a support of the long one.
    let from = ((front - 40.0) / 0.65).floor() * 0.65;
    let short = |pre_roll: f64| histories(track(from, front, pre_roll), 1200, &names);
    let (cured, ringing) = (short(lead as f64 * 1e-3 * v - length), short(0.0));
    let lead_in = (20.0 / v / 1e-3) as usize;
    let error = |run: &[Vec<f64>], i: usize| difference(&run[lead_in..], &long[lead + lead_in..], i);
    for (i, name) in names.iter().enumerate() {
        assert!(error(&cured, i) < 2e-3, "{name}: {:.5}", error(&cured, i));
    }
    assert!(error(&ringing, 0) > 0.1, "without: {:.4}", error(&ringing, 0));
}
