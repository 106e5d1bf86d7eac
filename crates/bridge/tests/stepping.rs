//! What a step is: order, meaning of inputs, sub-steps, roll-back, derivatives.

mod common;

use common::{beams, drive, find, get, near, outputs, set, span, stepping};
use ttb_bridge::Bridge;
use ttb_contract::Instance;
use ttb_scenario::spec::BridgeSpec;
use ttb_scenario::types::{Damping, Newmark, RayleighAt};

/// A light 20 m span with 4 bays and 2 % Rayleigh damping, f₁ = 6.8 Hz.
fn light(step: f64) -> BridgeSpec {
    let mut spec = beams(vec![span(20.0, 1.5e10, 5000.0, 12)], 4, step);
    spec.damping = Damping::Rayleigh { ratio: 0.02, at: RayleighAt::FirstTimes(4.0) };
    spec
}

/// Smooth support forces at t.
fn smooth(t: f64) -> [f64; 5] {
    let pulse = (1.0 - (40.0 * t).cos()).powi(2);
    [0.0, 1e4 * pulse, 2e4 * pulse, -3e3 * pulse * t, 0.0]
}

/// How forces are sent over a step.
#[derive(Clone, Copy, PartialEq)]
enum Send {
    Rates,
    Mean,
    End,
}

/// Runs n macro steps of `h` from rest and returns all outputs.
fn run(spec: &BridgeSpec, h: f64, n: usize, send: Send) -> Vec<f64> {
    let mut bridge = stepping(spec);
    for k in 0..n {
        let (a, b) = (smooth(k as f64 * h), smooth((k + 1) as f64 * h));
        let each = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f64> { a.iter().zip(&b).map(|(a, b)| f(*a, *b)).collect() };
        match send {
            Send::Rates => drive(&mut bridge, &a, Some(&each(&|a, b| (b - a) / h))),
            Send::Mean => drive(&mut bridge, &each(&|a, b| 0.5 * (a + b)), None),
            Send::End => drive(&mut bridge, &b, None),
        }
        bridge.step(k as f64 * h, h).unwrap();
    }
    outputs(&mut bridge)
}

/// Asserts equality of all outputs, relative to each or, near zero, to 1e-6.
fn same(a: &[f64], b: &[f64], tolerance: f64) {
    for (i, (a, b)) in a.iter().zip(b).enumerate() {
        assert!((a - b).abs() <= tolerance * a.abs().max(1e-6), "output {i}: {a} {b}");
    }
}

/// Orders of convergence of mid-span displacement and velocity between 1 and 1/2 ms, against 1/32 ms.
fn orders(send: Send) -> [f64; 2] {
    let at = |h: f64, send| run(&light(h), h, (0.128 / h).round() as usize, send);
    let (fine, coarse, half) = (at(1e-3 / 32.0, Send::Rates), at(1e-3, send), at(5e-4, send));
    [2, 7].map(|i| ((coarse[i] - fine[i]) / (half[i] - fine[i])).abs().log2())
}

#[test]
fn rates_and_held_means_are_second_order_and_a_held_end_is_first() {
    for (send, expected) in [(Send::Rates, 2.0), (Send::Mean, 2.0), (Send::End, 1.0)] {
        for order in orders(send) {
            println!("order {order:.3}");
            assert!((order - expected).abs() < 0.1, "order {order} instead of {expected}");
        }
    }
}

#[test]
fn one_mode_follows_a_manufactured_solution_with_order_two() {
    // η(t) = (1 − cos νt)² in the first mode: the force on mid-span that makes it, and the error at the end.
    let error = |h: f64| {
        let mut spec = light(h);
        spec.modes = Some(1);
        spec.supports = vec![10.0];
        let mut bridge = stepping(&spec);
        let omega = bridge.model().natural_frequencies(1).unwrap()[0] * std::f64::consts::TAU;
        // φ² at mid-span from the static answer to a unit force: φ²/ω².
        let mut rest = Instance::new(Bridge::new(spec.clone()).unwrap());
        rest.enter_initialization(0.0).unwrap();
        drive(&mut rest, &[1.0], None);
        let phi2 = omega * omega * get(&mut rest, "support[1].displacement");
        let (nu, c) = (31.0_f64, 2.0 * 0.02 * omega);
        let w = |t: f64| (1.0 - (nu * t).cos()).powi(2);
        let force = |t: f64| {
            let (s, co) = (nu * t).sin_cos();
            let (v, a) = (2.0 * nu * (1.0 - co) * s, 2.0 * nu * nu * (s * s + (1.0 - co) * co));
            (a + c * v + omega * omega * w(t)) / phi2
        };
        let n = (0.1 / h).round() as usize;
        for k in 0..n {
            let (a, b) = (force(k as f64 * h), force((k + 1) as f64 * h));
            drive(&mut bridge, &[a], Some(&[(b - a) / h]));
            bridge.step(k as f64 * h, h).unwrap();
        }
        (get(&mut bridge, "support[1].displacement") - w(0.1)).abs()
    };
    let order = (error(5e-4) / error(2.5e-4)).log2();
    assert!((order - 2.0).abs() < 0.02, "order {order}");
}

#[test]
fn held_means_repeat_the_interpolated_run() {
    let spec = light(1e-3);
    let (a, b) = (run(&spec, 1e-3, 200, Send::Rates), run(&spec, 1e-3, 200, Send::Mean));
    let scale = a[..5].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    assert!(a[..5].iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-10 * scale));
    let scale = a[5..10].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    assert!(a[5..10].iter().zip(&b[5..]).all(|(a, b)| (a - b).abs() < 1e-10 * scale));
    // Only the accelerations differ: a mean over the step against its end.
    let acceleration = find(&stepping(&spec), "point[mid].acceleration") as usize - 5;
    near("mean acceleration", b[acceleration], a[acceleration], 0.1);
}

#[test]
fn a_held_acceleration_does_not_ring() {
    // A jump from no force to a constant one: the state's own ü alternates, the output does not.
    let mut bridge = stepping(&BridgeSpec { modes: Some(1), ..light(1e-3) });
    let mut last = f64::NAN;
    for k in 0..20 {
        drive(&mut bridge, &[0.0, 0.0, 1e4, 0.0, 0.0], None);
        bridge.step(k as f64 * 1e-3, 1e-3).unwrap();
        let now = get(&mut bridge, "point[mid].acceleration");
        assert!(k == 0 || (now - last).abs() < 0.05 * 1.2, "{last} then {now}");
        last = now;
    }
}

#[test]
fn a_long_step_is_divided_and_a_rounded_one_is_not() {
    let (h, spec) = (1e-3, light(1e-3));
    // Forces are straight over each long step, so that both runs see the same polynomial.
    let long = |h_long: f64, pieces: usize| {
        let mut bridge = stepping(&spec);
        for k in 0..40 {
            let (a, b) = (smooth(k as f64 * 2e-3), smooth((k + 1) as f64 * 2e-3));
            let rates: Vec<f64> = a.iter().zip(&b).map(|(a, b)| (b - a) / 2e-3).collect();
            for i in 0..pieces {
                let start: Vec<f64> = a.iter().zip(&rates).map(|(a, r)| a + r * h_long * i as f64).collect();
                drive(&mut bridge, &start, Some(&rates));
                bridge.step(k as f64 * 2e-3 + i as f64 * h_long, h_long).unwrap();
            }
        }
        outputs(&mut bridge)
    };
    let (whole, halves) = (long(2e-3, 1), long(1e-3, 2));
    assert!(whole.iter().zip(&halves).all(|(a, b)| (a - b).abs() <= 1e-11 * b.abs().max(1e-6)));
    // Steps of 0.3 − 0.2 style rounding give the very same bits as the nominal one.
    let rounded = |h: f64| run(&spec, h, 50, Send::Mean);
    let bits = |x: Vec<f64>| x.into_iter().map(f64::to_bits).collect::<Vec<_>>();
    let near_h = 0.3e-3 + 0.7e-3;
    let answers = [h, near_h, h * (1.0 + 1e-12)].map(|h| {
        let mut bridge = stepping(&spec);
        drive(&mut bridge, &smooth(0.05), None);
        bridge.step(0.0, h).unwrap();
        get(&mut bridge, "support[3].displacement").to_bits()
    });
    assert!(answers.iter().all(|a| *a == answers[0]));
    assert_eq!(bits(rounded(h)), bits(rounded(h)));
}

#[test]
fn a_repeated_step_repeats_every_bit() {
    for (damping, modes) in [
        (light(1e-3).damping, None),
        (Damping::Modal { ratio: 0.03, modes: 5 }, None),
        (Damping::Modal { ratio: 0.03, modes: 5 }, Some(6)),
    ] {
        let spec = BridgeSpec { damping, modes, ..light(1e-3) };
        let mut bridge = stepping(&spec);
        let mut t = 0.0;
        for (k, h) in [1e-3, 1e-3, 2.5e-3, 0.4e-3, 1e-3].into_iter().enumerate() {
            let before = bridge.save();
            let (f, rates) = (smooth(0.03 + k as f64 * 1e-3), [0.0, 5e5, -2e5, 1e3, 0.0]);
            let rates = (k % 2 == 0).then_some(&rates[..]);
            drive(&mut bridge, &f, rates);
            bridge.step(t, h).unwrap();
            let first = outputs(&mut bridge);
            let after = bridge.save();
            // Other forces from the same state, which also overwrites buffers; then the first ones again.
            bridge.restore(&before).unwrap();
            drive(&mut bridge, &[1e5; 5], rates);
            bridge.step(t, h).unwrap();
            bridge.step(t + h, 0.7e-3).unwrap();
            bridge.restore(&before).unwrap();
            drive(&mut bridge, &f, rates);
            bridge.step(t, h).unwrap();
            assert_eq!(first, outputs(&mut bridge));
            let again = bridge.save();
            assert_eq!(bridge.to_bytes(&after), bridge.to_bytes(&again));
            // In a fresh instance, without any cached history, too.
            let mut other = stepping(&spec);
            let bytes = bridge.to_bytes(&before);
            let read = other.from_bytes(&bytes).unwrap();
            assert_eq!(other.to_bytes(&read), bytes);
            other.restore(&read).unwrap();
            drive(&mut other, &f, rates);
            other.step(t, h).unwrap();
            assert_eq!(first, outputs(&mut other));
            t += h;
        }
    }
}

#[test]
fn foreign_bytes_are_refused() {
    let mut small = light(1e-3);
    small.structure = beams(vec![span(20.0, 1.5e10, 5000.0, 6)], 4, 1e-3).structure;
    let mut small = stepping(&small);
    let bridge = stepping(&light(1e-3));
    let bytes = bridge.to_bytes(&bridge.save());
    let Err(error) = small.from_bytes(&bytes) else { panic!("a state of another bridge was taken") };
    assert!(error.0.contains("bytes"), "{error}");
}

#[test]
fn directional_derivatives_are_those_of_the_step() {
    for spec in [
        light(1e-3),
        BridgeSpec { damping: Damping::Modal { ratio: 0.05, modes: 4 }, ..light(1e-3) },
        BridgeSpec { modes: Some(5), ..light(1e-3) },
    ] {
        for (h, with_rates) in [(1e-3, true), (1e-3, false), (2.3e-3, true), (2.3e-3, false), (0.4e-3, false)] {
            let mut bridge = stepping(&spec);
            let rates = [1e4, -2e4, 3e5, 0.0, 2e4];
            let rates = with_rates.then_some(&rates[..]);
            let (forces, seed) = ([3e3, -1e3, 8e3, 2e3, 0.0], [0.0, 1.0, -2.0, 0.5, 0.0]);
            drive(&mut bridge, &forces, rates);
            bridge.step(0.0, h).unwrap();
            let before = bridge.save();
            let stepped = |bridge: &mut Instance<Bridge>, size: f64| {
                bridge.restore(&before).unwrap();
                let moved: Vec<f64> = forces.iter().zip(seed).map(|(f, s)| f + size * s).collect();
                drive(bridge, &moved, rates);
                bridge.step(h, h).unwrap();
                outputs(bridge)
            };
            let (plus, minus) = (stepped(&mut bridge, 1e5), stepped(&mut bridge, -1e5));
            let first_output = forces.len() as u32;
            let unknown: Vec<u32> = (0..plus.len() as u32).map(|i| first_output + i).collect();
            let mut derivative = vec![0.0; plus.len()];
            bridge.directional_derivative(&unknown, &[0, 1, 2, 3, 4], &seed, &mut derivative).unwrap();
            for (i, d) in derivative.iter().enumerate() {
                let difference = (plus[i] - minus[i]) / 2e5;
                assert!((d - difference).abs() <= 1e-9 * d.abs().max(1e-13), "output {i}: {d} {difference}");
            }
            assert!(derivative[2] < 0.0, "a force up lifts the deck");
        }
    }
}

#[test]
fn a_full_set_of_modes_is_the_full_model() {
    let spec = |modes, damping, newmark| BridgeSpec { modes, damping, newmark, ..light(1e-3) };
    let rayleigh = light(1e-3).damping;
    let ndof = Bridge::new(light(1e-3)).unwrap().ndof();
    let modal = Damping::Modal { ratio: 0.02, modes: ndof };
    let dissipative = Newmark { gamma: 0.6, beta: 0.31 };
    for damping in [Damping::None, rayleigh, modal] {
        for newmark in [Newmark::default(), dissipative] {
            for send in [Send::Rates, Send::Mean] {
                let full = run(&spec(None, damping.clone(), newmark), 1e-3, 60, send);
                let all = run(&spec(Some(ndof), damping.clone(), newmark), 1e-3, 60, send);
                same(&full, &all, 1e-7);
            }
        }
    }
}

#[test]
fn modal_damping_is_rayleigh_damping_where_they_agree() {
    // One mode carries the answer; both laws give it 5 %.
    let damped = |damping| {
        let spec = BridgeSpec { damping, modes: Some(1), ..light(1e-3) };
        run(&spec, 1e-3, 100, Send::Rates)
    };
    let modal = damped(Damping::Modal { ratio: 0.05, modes: 1 });
    let rayleigh = damped(Damping::Rayleigh { ratio: 0.05, at: RayleighAt::Modes([1, 2]) });
    same(&modal, &rayleigh, 1e-9);
    let none = damped(Damping::None);
    assert!((none[2] - modal[2]).abs() > 1e-3 * modal[2].abs());
}

#[test]
fn factors_scale_stiffness_and_mass() {
    let mut bridge = Instance::new(Bridge::new(light(1e-3)).unwrap());
    let frequency = bridge.model().natural_frequencies(1).unwrap()[0];
    bridge.enter_initialization(0.0).unwrap();
    drive(&mut bridge, &[0.0, 0.0, 1e4, 0.0, 0.0], None);
    let soft = get(&mut bridge, "support[3].displacement");
    set(&mut bridge, "stiffness_factor", 2.0);
    set(&mut bridge, "mass_factor", 0.5);
    set(&mut bridge, "damping_ratio", 0.01);
    near("stiffness", get(&mut bridge, "support[3].displacement"), 0.5 * soft, 1e-12);
    near("frequency", bridge.model().natural_frequencies(1).unwrap()[0], 2.0 * frequency, 1e-12);
    near("mass", bridge.model().mass(), 0.5 * 20.0 * 5000.0, 1e-12);
    bridge.exit_initialization().unwrap();
    // The same bridge, written with these numbers.
    let mut spec = light(1e-3);
    spec.damping = Damping::Rayleigh { ratio: 0.01, at: RayleighAt::FirstTimes(4.0) };
    spec.structure = beams(vec![span(20.0, 3e10, 2500.0, 12)], 4, 1e-3).structure;
    let mut other = Instance::new(Bridge::new(spec).unwrap());
    other.enter_initialization(0.0).unwrap();
    drive(&mut other, &[0.0, 0.0, 1e4, 0.0, 0.0], None);
    other.exit_initialization().unwrap();
    for k in 0..30 {
        for bridge in [&mut bridge, &mut other] {
            drive(bridge, &smooth(0.1 + f64::from(k) * 1e-3), None);
            bridge.step(f64::from(k) * 1e-3, 1e-3).unwrap();
        }
    }
    same(&outputs(&mut bridge), &outputs(&mut other), 1e-9);
}

#[test]
fn a_reset_runs_the_same_again() {
    let mut bridge = Instance::new(Bridge::new(light(1e-3)).unwrap());
    let mut once = || {
        bridge.enter_initialization(0.0).unwrap();
        drive(&mut bridge, &smooth(0.02), None);
        bridge.exit_initialization().unwrap();
        let start = outputs(&mut bridge);
        for k in 0..5 {
            drive(&mut bridge, &smooth(0.02 + f64::from(k) * 1e-3), None);
            bridge.step(f64::from(k) * 1.7e-3, 1.7e-3).unwrap();
        }
        let answer = (start, outputs(&mut bridge));
        bridge.reset();
        answer
    };
    assert_eq!(once(), once());
}

#[test]
fn threads_do_not_disturb_each_other() {
    let alone = run(&light(1e-3), 1e-3, 100, Send::Rates);
    let runs: Vec<_> = (0..4).map(|_| std::thread::spawn(|| run(&light(1e-3), 1e-3, 100, Send::Rates))).collect();
    for run in runs {
        assert_eq!(run.join().unwrap(), alone);
    }
}
