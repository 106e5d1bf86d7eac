//! The accelerations on a pair of subsystems with many forces and a known contraction.

mod many;

use many::{N, pair, ports, settings};
use ttb_coupling::report::{Side, Source};
use ttb_coupling::{Coupling, IterationError, Method, OnFailure, Outcome, Settings};

const H: f64 = 0.01;

/// Steps a pair; the trials of every step.
fn trials(method: Method, rho: f64, curvature: f64, derives: bool) -> (Vec<usize>, Coupling) {
    let (mut train_track, mut bridge) = pair(rho, curvature);
    bridge.derives = derives;
    let mut coupling = Coupling::new(ports(), settings(method));
    coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
    let mut found = Vec::new();
    for n in 0..40 {
        let t = f64::from(n) * H;
        let info = coupling.step(&mut train_track, &mut bridge, t, H).unwrap_or_else(|e| panic!("{method:?}: {e}"));
        assert_eq!(info.outcome, Outcome::Converged);
        assert!(train_track.defect(&bridge, coupling.forces(), t + H) < 1e-7, "{method:?}");
        found.push(info.iterations);
    }
    (found, coupling)
}

fn mean(trials: &[usize]) -> f64 {
    trials.iter().sum::<usize>() as f64 / trials.len() as f64
}

#[test]
fn a_contraction_of_five_is_no_obstacle_to_methods_with_a_memory() {
    let (iqn, coupling) = trials(Method::IqnIls, 5.0, 0.0, false);
    assert!(mean(&iqn) < 14.0, "{iqn:?}");
    assert!(coupling.report().contraction.is_some_and(|rho| (4.5..=5.01).contains(&rho)));
    let (newton, _) = trials(Method::Newton, 5.0, 0.0, false);
    assert!(newton.iter().all(|k| *k <= 2), "{newton:?}");
}

#[test]
fn newton_steps_a_linear_bridge_twice_also_where_the_track_is_not_linear() {
    for derives in [false, true] {
        let (newton, coupling) = trials(Method::Newton, 2.0, 0.3, derives);
        assert!(newton.iter().all(|k| *k <= 2), "{newton:?}");
        let source = if derives { Source::Derivatives } else { Source::Trials };
        assert_eq!(coupling.report().model, Some(source));
    }
}

#[test]
fn derivatives_that_are_not_those_of_the_steps_are_found_out() {
    let (mut train_track, mut bridge) = pair(2.0, 0.0);
    (bridge.derives, bridge.excess) = (true, 2.0);
    let mut coupling = Coupling::new(ports(), settings(Method::Newton));
    coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
    let info = coupling.step(&mut train_track, &mut bridge, 0.0, H).expect("a step");
    assert_eq!((info.iterations, coupling.report().model), (2, Some(Source::Trials)));
}

#[test]
fn derivatives_of_a_bridge_that_holds_its_inputs_are_those_of_the_mean_force() {
    let (mut train_track, mut bridge) = pair(1.0, 0.0);
    (bridge.derives, bridge.interpolates) = (true, false);
    let mut coupling = Coupling::new(ports(), settings(Method::Newton));
    coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
    let info = coupling.step(&mut train_track, &mut bridge, 0.0, H).expect("a step");
    assert_eq!((info.iterations, coupling.report().model), (2, Some(Source::Derivatives)));
}

#[test]
fn auto_leaves_a_weak_coupling_to_quasi_newton_and_takes_newton_where_it_pays() {
    let (weak, coupling) = trials(Method::Auto, 0.001, 0.0, false);
    assert!(mean(&weak) < 3.1, "{weak:?}");
    assert_eq!((coupling.method(), coupling.report().switches.len()), (Method::IqnIls, 0));
    let (strong, coupling) = trials(Method::Auto, 3.0, 0.3, false);
    assert_eq!(coupling.method(), Method::Newton);
    let [(t, Method::Newton)] = coupling.report().switches[..] else { panic!("{:?}", coupling.report()) };
    let before = (t / H).round() as usize;
    // Bought when the trials beyond two a step had cost as much as the model.
    assert!(strong[..before].iter().map(|k| k - 2).sum::<usize>() > N, "{strong:?}");
    assert!(strong[before..].iter().all(|k| *k <= 2), "{strong:?}");
}

#[test]
fn a_step_of_another_size_does_without_the_model() {
    let (mut train_track, mut bridge) = pair(2.0, 0.0);
    let mut coupling = Coupling::new(ports(), settings(Method::Newton));
    coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
    let first = coupling.step(&mut train_track, &mut bridge, 0.0, H).expect("a step");
    let shorter = coupling.step(&mut train_track, &mut bridge, H, 0.3 * H).expect("a step");
    assert_eq!((first.method, shorter.method), (Method::Newton, Method::IqnIls));
}

#[test]
fn aitken_that_gets_nowhere_is_rescued_by_quasi_newton() {
    let (mut train_track, mut bridge) = pair(5.0, 0.0);
    let few = Settings { max_iterations: 20, on_failure: OnFailure::Stop, ..settings(Method::Aitken) };
    let mut coupling = Coupling::new(ports(), few);
    train_track.at_rest = true;
    coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
    train_track.at_rest = false;
    let info = coupling.step(&mut train_track, &mut bridge, 0.0, H).expect("rescued");
    assert_eq!((info.rescues, info.method), (1, Method::IqnIls));
    assert!(info.iterations > 20);
}

#[test]
fn a_fixed_point_that_diverges_stops_with_its_contraction_and_a_way_out() {
    let (mut train_track, mut bridge) = pair(3.0, 0.0);
    train_track.at_rest = true;
    let mut coupling = Coupling::new(ports(), settings(Method::FixedPoint));
    coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
    train_track.at_rest = false;
    let Err(error) = coupling.step(&mut train_track, &mut bridge, 0.0, H) else { panic!("it converged") };
    let IterationError::NotConverged { rho: Some(rho), .. } = &error else { panic!("{error}") };
    assert!((2.7..=3.01).contains(rho), "{rho}");
    let said = error.to_string();
    assert!(said.contains("ρ = ") && said.contains("use method auto"), "{said}");
}

#[test]
fn infinity_is_caught_at_its_step_with_subsystem_and_output() {
    let (mut train_track, mut bridge) = pair(0.1, 0.0);
    bridge.infinite_from = 0.045;
    let mut coupling = Coupling::new(ports(), settings(Method::Auto));
    coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
    for n in 0..4 {
        coupling.step(&mut train_track, &mut bridge, f64::from(n) * H, H).expect("a step");
    }
    let stopped = coupling.step(&mut train_track, &mut bridge, 4.0 * H, H);
    let Err(IterationError::NotFinite { t, side, output, value, .. }) = stopped else { panic!("{stopped:?}") };
    assert_eq!((t, side, value), (5.0 * H, Side::Bridge, f64::INFINITY));
    assert_eq!(output, "coupled output number 4");
}

#[test]
fn forces_that_no_subsystem_can_bear_on_the_way_do_not_end_the_run_but_a_step_that_cannot_be_done_does() {
    let (mut train_track, mut bridge) = pair(5.0, 0.0);
    let mut coupling = Coupling::new(ports(), settings(Method::Aitken));
    train_track.at_rest = true;
    coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
    train_track.at_rest = false;
    // Aitken's second trial is the whole load, 100; the answer is a sixth of it.
    bridge.strongest = 60.0;
    let info = coupling.step(&mut train_track, &mut bridge, 0.0, H).expect("rescued");
    assert_eq!((info.outcome, info.rescues), (Outcome::Converged, 1));
    bridge.strongest = -1.0;
    let failed = coupling.step(&mut train_track, &mut bridge, H, H);
    assert!(matches!(failed, Err(IterationError::Subsystem(_))), "{failed:?}");
}
