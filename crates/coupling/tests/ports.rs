//! Ports as data: three of them a support, in N and N·m, coupled like any others.

mod spatial;

use spatial::{N, monolithic, ports, sides};
use ttb_coupling::{Coupling, Method, OnFailure, Predictor, Settings};

const H: f64 = 2e-3;
const STEPS: usize = 200;

fn settings(method: Method) -> Settings {
    Settings {
        method,
        reuse: 2,
        predictor: Predictor::Linear,
        tolerance: 1e-12,
        max_iterations: 60,
        hold_forces: false,
        mean_forces: false,
        on_failure: OnFailure::Stop,
    }
}

/// Motion at the end, trials of every step, and the work's imbalance, with moments in units of `unit` N·m.
fn run(method: Method, unit: f64) -> ([Vec<f64>; 2], Vec<usize>, f64) {
    let [mut track, mut deck] = sides(unit);
    let mut coupling = Coupling::new(ports(unit), settings(method));
    coupling.initialise(&mut track, &mut deck, 0.0).expect("equilibrium");
    let step = |n| coupling.step(&mut track, &mut deck, n as f64 * H, H).unwrap_or_else(|e| panic!("{method:?}: {e}"));
    let trials = (0..STEPS).map(step).map(|info| info.iterations).collect();
    (deck.motion().map(<[f64]>::to_vec), trials, coupling.report().work.imbalance())
}

#[test]
fn three_ports_a_support_give_the_monolithic_solution_by_every_method() {
    let exact = monolithic(STEPS, H);
    for method in [Method::FixedPoint, Method::Aitken, Method::IqnIls, Method::Newton, Method::Auto] {
        let (motion, _, imbalance) = run(method, 1.0);
        for (found, exact) in motion.iter().zip(&exact) {
            let largest = exact.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            for i in 0..N {
                let off = (found[i] - exact[i]).abs() / largest;
                assert!(off < 1e-9, "{method:?}, port {i}: {} for {}", found[i], exact[i]);
            }
        }
        assert!(imbalance < 1e-10, "{method:?}: {imbalance}");
    }
}

#[test]
fn the_unit_of_a_port_is_nobody_s_concern() {
    for method in [Method::FixedPoint, Method::IqnIls, Method::Newton] {
        let ([q, v], trials, _) = run(method, 1.0);
        // Powers of two, so that no number is rounded differently.
        for unit in [1024.0, 1.0 / 1024.0] {
            let ([other_q, other_v], others, _) = run(method, unit);
            assert_eq!(trials, others, "{method:?}, moments in {unit} N·m");
            assert_eq!([&q, &v], [&other_q, &other_v], "{method:?}, moments in {unit} N·m");
        }
    }
}

#[test]
fn trial_steps_see_the_mass_behind_every_component() {
    let [mut track, mut deck] = sides(1.0);
    let mut coupling = Coupling::new(ports(1.0), settings(Method::Auto));
    coupling.initialise(&mut track, &mut deck, 0.0).expect("equilibrium");
    let groups = [0..N / 3, N / 3..2 * N / 3, 2 * N / 3..N];
    let probe = coupling.probe(&mut track, &mut deck, &groups, [0.0, H], 4).expect("a probe");
    assert_eq!((probe.train_track, probe.bridge.as_slice()), (Some(0.0), &[0.0; 3][..]));
    // Masses as the ports see them: M_x/b acts on a mass J/b².
    let masses = probe.responses.iter().map(|response| response.mass[1]);
    for (mass, exact) in masses.zip([6e3, 5e3, 9e3 / (0.75 * 0.75)]) {
        assert!((mass / exact - 1.0).abs() < 0.1, "{mass} for {exact}");
    }
}
