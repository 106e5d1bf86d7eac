//! Cars against docs/theory.md 15, and the state of the subsystem.

mod common;
mod space;

use common::{spec, started, value};
use ttb_contract::{Instance, Model};
use ttb_record::Table;
use ttb_scenario::spec::Profile;
use ttb_scenario::types::{RailPoint, Ramp, RampShape, Wave};
use ttb_train_track::TrainTrack;
use ttb_train_track::car::Car;

const COMMAND: &str = "-p ttb-train-track --test cars";

#[test]
fn cars_have_their_published_frequencies_on_a_rigid_rail() {
    let expected: [(&str, &[f64]); 3] = [
        ("ice3-trailer", &[0.7530, 0.8347, 6.0007, 6.0031, 7.0974, 7.0974]),
        ("ice3-motor", &[0.8400, 0.9724, 4.782, 4.782, 6.277, 6.281]),
        ("manchester", &[1.0725, 1.2973, 7.419, 7.426, 11.617, 11.617]),
    ];
    let source = "independent program with the published data of the cars (docs/theory.md, T5 to T7)";
    let mut table = Table::new("cars on a rigid rail, Hz", source, COMMAND);
    for (name, hertz) in expected {
        let car = Car::new(&ttb_scenario::bundled::cars(name).unwrap()[0]);
        for (n, (computed, expected)) in (1..).zip(car.frequencies_on_rigid_rail().iter().zip(hertz)) {
            table.row(format!("{name}, mode {n}"), *expected, *computed, 2e-4);
        }
    }
    table.finish();
}

#[test]
fn static_axle_loads_are_the_published_ones() {
    let mut table = Table::new("static axle loads, kN", "published data of the cars", COMMAND);
    for (name, kilonewton) in [
        ("ice3-trailer", 143.23),
        ("ice3-motor", 156.96),
        ("velaro-e", 152.06),
        ("manchester", 109.09),
        ("shinkansen-s300", 134.8),
        ("emu-a", 123.36),
        ("emu-b", 106.93),
    ] {
        let car = Car::new(&ttb_scenario::bundled::cars(name).unwrap()[0]);
        table.row(name, kilonewton, car.axle_load / 1e3, 5e-4);
    }
    table.finish();
}

/// A rough rail under a running car on a moving deck.
fn rough() -> Instance<TrainTrack> {
    rough_in(1)
}

/// The same in so many sub-steps a step of 1 ms, and with a monitored point of the rail.
fn rough_in(substeps: usize) -> Instance<TrainTrack> {
    let mut spec = spec();
    spec.substeps = substeps;
    spec.rail_points = vec![RailPoint { name: "p".into(), x: 33.0 }];
    let wave = |amplitude, wavelength| Wave { amplitude, wavelength, phase: 0.3 };
    let ramp = Some(Ramp { start: 30.0, length: 8.0, shape: RampShape::Quintic });
    spec.irregularity = Profile::Waves { waves: vec![wave(1e-3, 9.0), wave(2e-4, 3.0)], origin: 30.0, ramp };
    started(spec)
}

fn deck(t: f64) -> f64 {
    1e-3 * (1.0 - (20.0 * t).cos())
}

fn advance(instance: &mut Instance<TrainTrack>, n: usize, h: f64) {
    let supports = 30;
    let references: Vec<u32> = (0..2 * supports as u32).collect();
    let t = n as f64 * h;
    let velocity = |t: f64| 0.02 * (20.0 * t).sin();
    let line = |f: &dyn Fn(f64) -> f64| (f(t), (f(t + h) - f(t)) / h);
    let ((d, dr), (v, vr)) = (line(&deck), line(&velocity));
    let fill = |a: f64, b: f64| [vec![a; supports], vec![b; supports]].concat();
    instance.set(&references, &fill(d, v)).unwrap();
    instance.set_rates(&references, &fill(dr, vr)).unwrap();
    instance.step(t, h).unwrap();
}

#[test]
fn a_running_train_is_second_order_in_h() {
    let at = |h: f64| {
        let mut instance = rough();
        (0..(0.2 / h).round() as usize).for_each(|n| advance(&mut instance, n, h));
        value(&mut instance, "car[1].displacement")
    };
    // The nominal step is 1 ms: smaller ones are factorised as they come.
    let [coarse, middle, fine] = [1e-3, 5e-4, 2.5e-4].map(at);
    let order = ((coarse - middle) / (middle - fine)).abs().log2();
    assert!((1.9..2.1).contains(&order), "order {order}");
}

/// Manufactured solution: far from the train the rail shall move as w = A (1 − cos ωt)². All supports must then be moved by
/// d with k d + c ḋ = m ẅ + c ẇ + k w (per bay), and the support force is −m ẅ.
#[test]
fn the_track_follows_a_manufactured_motion_with_second_order() {
    let (amplitude, omega, k, c, m) = (1e-3, 60.0_f64, 1e8, 7.25e4, 121.28 * 0.2);
    // w = A (3/2 − 2 cos ωt + ½ cos 2ωt); every harmonic b cos Ωt of w has d = b Re[(k − mΩ² + icΩ)/(k + icΩ) e^{iΩt}].
    let harmonics = [(-2.0, omega), (0.5, 2.0 * omega)].map(|(b, w): (f64, f64)| {
        let (re, im, square) = (k - m * w * w, c * w, k * k + c * c * w * w);
        (amplitude * b * (re * k + im * c * w) / square, amplitude * b * (im * k - re * c * w) / square, w)
    });
    let particular =
        |t: f64| 1.5 * amplitude + harmonics.iter().map(|(p, q, w)| p * (w * t).cos() - q * (w * t).sin()).sum::<f64>();
    let slope = |t: f64| harmonics.iter().map(|(p, q, w)| -w * (p * (w * t).sin() + q * (w * t).cos())).sum::<f64>();
    // Plus the homogeneous part that lets it begin at rest.
    let (d0, rate) = (particular(0.0), k / c);
    let d = |t: f64| particular(t) - d0 * (-rate * t).exp();
    let v = |t: f64| slope(t) + d0 * rate * (-rate * t).exp();
    let exact = |t: f64| -m * amplitude * omega * omega * (2.0 * (omega * t).cos() - 2.0 * (2.0 * omega * t).cos());
    let error = |h: f64| {
        let mut spec = spec();
        (spec.bays, spec.on_bridge, spec.step) = (500, (0..=500).collect(), h);
        // Short bays: between its supports the rail must hardly bend under its own inertia.
        (spec.track.spacing, spec.elements_per_bay) = (0.2, 1);
        (spec.front_wheel, spec.speed) = (30.0, vec![[0.0, 0.0]]);
        let mut instance = started(spec);
        let references: Vec<u32> = (0..1002).collect();
        let fill = |a: f64, b: f64| [vec![a; 501], vec![b; 501]].concat();
        (0..(0.1 / h).round() as usize).map(|n| n as f64 * h).fold(0.0_f64, |error, t| {
            instance.set(&references, &fill(d(t), v(t))).unwrap();
            instance.set_rates(&references, &fill((d(t + h) - d(t)) / h, (v(t + h) - v(t)) / h)).unwrap();
            instance.step(t, h).unwrap();
            error.max((value(&mut instance, "support[400].force") - exact(t + h)).abs())
        })
    };
    let (coarse, fine) = (error(1e-4), error(5e-5));
    let (order, scale) = ((coarse / fine).log2(), 4.0 * m * amplitude * omega * omega);
    assert!((1.95..2.05).contains(&order) && fine < 1e-5 * scale, "order {order}, error {fine} N of {scale} N");
}

#[test]
fn a_restored_state_repeats_the_step_bit_for_bit_also_from_bytes_and_in_another_instance() {
    [1, 4].into_iter().for_each(repeats);
}

fn repeats(substeps: usize) {
    let (mut a, mut b) = (rough_in(substeps), rough_in(substeps));
    (0..40).for_each(|n| advance(&mut a, n, 1e-3));
    let saved = a.save();
    let bytes = a.to_bytes(&saved);
    let all: Vec<u32> = (0..a.model().interface().variables().len() as u32).collect();
    let run = |instance: &mut Instance<TrainTrack>| {
        (40..60).for_each(|n| advance(instance, n, 1e-3));
        let mut out = vec![0.0; all.len()];
        instance.get(&all, &mut out).unwrap();
        out.iter().map(|x| x.to_bits()).collect::<Vec<_>>()
    };
    let first = run(&mut a);
    a.restore(&saved).unwrap();
    assert_eq!(run(&mut a), first);
    let read = b.from_bytes(&bytes).unwrap();
    b.restore(&read).unwrap();
    assert_eq!(run(&mut b), first);
    assert!(b.from_bytes(&bytes[..bytes.len() - 8]).is_err());
}

/// One macro step of m sub-steps is m steps of their size: mean force, work and peak of the one are those of the others.
#[test]
fn sub_steps_are_steps_and_mean_work_and_peak_are_gathered_over_them() {
    let h = 1e-3;
    let near = |name: &str, expected: f64, found: f64| {
        assert!((found - expected).abs() <= 1e-9 * expected.abs().max(1e-3), "{name}: {found}, expected {expected}");
    };
    // The deck speeds up at first and slows down in the end: peaks of either sign.
    for (n, sign) in [(10, 1.0), (175, -1.0)] {
        let (mut whole, mut parts) = (rough_in(5), rough_in(5));
        (0..n).for_each(|k| advance(&mut whole, k, h));
        (0..n).for_each(|k| advance(&mut parts, k, h));
        let (mean, work, peak) = in_parts(&mut parts, n, h);
        advance(&mut whole, n, h);
        for (s, mean) in mean.iter().enumerate() {
            near("mean", *mean, value(&mut whole, &format!("support[{}].mean_force", s + 1)));
        }
        near("work", work, value(&mut whole, "deck_work"));
        near("peak", peak, value(&mut whole, "rail[p].peak_acceleration"));
        assert!(work.abs() > 1e-3 && sign * peak > 1e-2, "{work} J, {peak} m/s2");
    }
}

/// Step n in five parts: mean support forces, work on the deck, peak of the rail's acceleration.
fn in_parts(parts: &mut Instance<TrainTrack>, n: usize, h: f64) -> (Vec<f64>, f64, f64) {
    let (m, supports) = (5, 30);
    let names: Vec<String> = (1..=supports).map(|i| format!("support[{i}].force")).collect();
    let forces = |instance: &mut Instance<TrainTrack>| names.iter().map(|n| value(instance, n)).collect::<Vec<_>>();
    let (t, velocity) = (n as f64 * h, |t: f64| 0.02 * (20.0 * t).sin());
    let rates = [(deck(t + h) - deck(t)) / h, (velocity(t + h) - velocity(t)) / h];
    let references: Vec<u32> = (0..2 * supports as u32).collect();
    let (mut mean, mut work, mut peak) = (vec![0.0; supports], 0.0, 0.0_f64);
    let mut before = forces(parts);
    for i in 0..m {
        let tau = i as f64 * h / f64::from(m);
        let fill = |a: f64, b: f64| [vec![a; supports], vec![b; supports]].concat();
        parts.set(&references, &fill(deck(t) + tau * rates[0], velocity(t) + tau * rates[1])).unwrap();
        parts.set_rates(&references, &fill(rates[0], rates[1])).unwrap();
        parts.step(t + tau, h / f64::from(m)).unwrap();
        let after = forces(parts);
        for (s, (a, b)) in before.iter().zip(&after).enumerate() {
            mean[s] += 0.5 * (a + b) / f64::from(m);
            work += 0.5 * (a + b) * rates[0] * h / f64::from(m);
        }
        let a = value(parts, "rail[p].acceleration");
        peak = if a.abs() > peak.abs() { a } else { peak };
        before = after;
    }
    (mean, work, peak)
}

#[test]
fn a_standing_train_on_a_smooth_rail_stays_where_it_is() {
    let mut spec = spec();
    spec.speed = vec![[0.0, 0.0]];
    let mut instance = started(spec);
    let before = value(&mut instance, "car[1].displacement");
    (0..50).for_each(|n| instance.step(n as f64 * 1e-3, 1e-3).unwrap());
    assert!((value(&mut instance, "car[1].displacement") - before).abs() < 1e-12);
    assert!(value(&mut instance, "car[1].acceleration").abs() < 1e-8);
}

#[test]
fn static_support_forces_carry_the_train() {
    let mut spec = spec();
    spec.front_wheel = 49.0;
    spec.on_bridge = (0..=90).collect();
    let mut instance = started(spec);
    let sum: f64 = (1..=91).map(|i| value(&mut instance, &format!("support[{i}].force"))).sum();
    assert!((sum / (4.0 * 143_226.0) - 1.0).abs() < 1e-6, "{sum}");
}

#[test]
fn leaving_the_rail_is_an_error_that_names_wheel_and_place() {
    let mut spec = spec();
    spec.front_wheel = 58.0;
    let mut instance = started(spec);
    let message = (0..100).find_map(|n| instance.step(n as f64 * 1e-3, 1e-3).err()).unwrap().0;
    assert!(message.contains("wheel 1 leaves the rail") && message.contains("58.5"), "{message}");
}
