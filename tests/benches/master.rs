//! The master's own cost with two trivial C FMUs and 1,000 coupled values in each direction: a step's time less that
//! inside the FMU calls. `cargo bench -p ttb-tests --bench master`; needs a C compiler (`cc`).

mod trivial;

use std::time::Instant;

use ttb_contract::{Component, Known, Port, Ports, Subsystem};
use ttb_coupling::{Coupling, Method, OnFailure, Predictor, Settings};
use ttb_fmi::FmuSubsystem;

use trivial::{N, pack};

const STEPS: usize = 20_000;
const ROUNDS: usize = 7;

fn main() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let names = |kind: &str| (1..=N).map(|i| format!("{kind}[{i}]")).collect::<Vec<_>>();
    let (forces, motions) = (names("f"), names("d"));
    let make = |name: &str, inputs: &[String], outputs: &[String], gain: &str| {
        let fmu = pack(folder.path(), name, inputs, outputs, gain);
        let mut instance =
            ttb_fmi2::import::open(&fmu).and_then(|fmu| fmu.instantiate(name, false)).expect("trivial FMU");
        instance.setup_experiment(0.0, None).and_then(|()| instance.enter_initialization()).expect("initialization");
        FmuSubsystem::new(instance, inputs, outputs).expect("names")
    };
    for (what, limit, method) in [
        ("explicit, 1 sweep a step", 1, Method::FixedPoint),
        ("implicit, 1e-10", 30, Method::FixedPoint),
        ("implicit, 1e-10, default method", 30, Method::Auto),
    ] {
        let mut train_track = make("Front", &motions, &forces, "0.03");
        let mut bridge = make("Back", &forces, &motions, "1.0");
        let mut coupling = Coupling::new(ports(), settings(limit, method));
        coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
        let (mut best, mut best_inside, mut sweeps) = (f64::INFINITY, 0.0, 0);
        let mut n = 0;
        for _ in 0..ROUNDS {
            let inside = |a: &FmuSubsystem, b: &FmuSubsystem| a.seconds() + b.seconds();
            let (before, begin) = (inside(&train_track, &bridge), Instant::now());
            sweeps = 0;
            for _ in 0..STEPS {
                let info = coupling.step(&mut train_track, &mut bridge, n as f64 * 1e-3, 1e-3).expect("step");
                sweeps += info.iterations;
                n += 1;
            }
            let spent = begin.elapsed().as_secs_f64();
            if spent < best {
                (best, best_inside) = (spent, inside(&train_track, &bridge) - before);
            }
        }
        let per_sweep = 1e6 / sweeps as f64;
        println!(
            "{what}: {:.2} sweeps a step; {:.2} µs a step; per sweep {:.2} µs, of it {:.2} µs inside FMU calls and {:.2} µs the master's own",
            sweeps as f64 / STEPS as f64,
            1e6 * best / STEPS as f64,
            best * per_sweep,
            best_inside * per_sweep,
            (best - best_inside) * per_sweep
        );
    }
}

/// A force and a displacement each.
fn ports() -> Ports {
    let (component, scale, known) = (Component::Vertical, 1e-3, Known::Position);
    Ports::new((1..=N).map(|support| Port { support, component, scale, known }).collect(), 0).expect("ports in order")
}

fn settings(limit: usize, method: Method) -> Settings {
    Settings {
        method,
        reuse: 2,
        predictor: Predictor::Constant,
        tolerance: 1e-10,
        max_iterations: limit,
        hold_forces: false,
        mean_forces: false,
        on_failure: OnFailure::Accept,
    }
}
