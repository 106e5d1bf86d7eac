//! µs per macro step as a master makes it (set forces, rates, step, get outputs): the first trial and a repeated one.
//! `cargo bench -p ttb-bridge`

#[path = "../tests/common/mod.rs"]
mod common;

use std::time::Instant;

use common::{beams, bridge, drive, span, stepping};
use ttb_scenario::bundled;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::{Damping, RayleighAt};

fn time(name: &str, spec: &BridgeSpec) {
    let setup = Instant::now();
    let mut bridge = stepping(spec);
    let setup = setup.elapsed();
    let n = spec.supports.len();
    let (forces, rates): (Vec<f64>, Vec<f64>) =
        (0..n).map(|i| (1e4 * (i as f64).sin(), 1e5 * (i as f64).cos())).unzip();
    let mut outputs = vec![0.0; 2 * n];
    let references: Vec<u32> = (n as u32..3 * n as u32).collect();
    let mut saved = bridge.save();
    // Best of several rounds: other work shares the machine.
    let (mut best, mut steps) = ([f64::INFINITY; 2], 0);
    for _ in 0..40 {
        for (repeated, best) in [false, true].into_iter().zip(&mut best) {
            let begin = Instant::now();
            for _ in 0..200 {
                if repeated {
                    bridge.restore(&saved).unwrap();
                } else {
                    bridge.save_into(&mut saved);
                    steps += 1;
                }
                drive(&mut bridge, &forces, Some(&rates));
                bridge.step(f64::from(steps - 1) * spec.step, spec.step).unwrap();
                bridge.get(&references, &mut outputs).unwrap();
            }
            *best = best.min(begin.elapsed().as_secs_f64() / 200.0);
        }
    }
    let model = bridge.model();
    println!(
        "{name}: {} of {} DOF, {n} supports, set-up {:.1} ms, first trial {:.2} µs, repeated {:.2} µs",
        model.unknowns(),
        model.ndof(),
        1e3 * setup.as_secs_f64(),
        1e6 * best[0],
        1e6 * best[1]
    );
}

fn main() {
    let damping = Damping::Rayleigh { ratio: 0.05, at: RayleighAt::FirstTimes(4.0) };
    let mut r1 = beams(vec![span(32.5, 3.45e10 * 12.744, 29_720.0, 50)], 50, 1e-3);
    r1.supports.retain(|x| *x > 0.0 && *x < 32.5);
    r1.damping = damping.clone();
    time("R1", &r1);
    time(
        "R1, modal damping in 20 modes",
        &BridgeSpec { damping: Damping::Modal { ratio: 0.05, modes: 20 }, ..r1.clone() },
    );
    time("R1, 3 modes", &BridgeSpec { modes: Some(3), ..r1.clone() });

    let frame = bundled::frame("cable-stayed-224").expect("a bundled frame");
    let mut frame = BridgeSpec { damping, ..bridge(StructureSpec::Frame(frame), 224.0, 410, 1e-3) };
    frame.supports.retain(|x| *x > 0.0 && *x < 224.0);
    time("cable-stayed", &frame);
    time("cable-stayed, 60 modes", &BridgeSpec { modes: Some(60), ..frame.clone() });
}
