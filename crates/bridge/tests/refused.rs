//! Parameters that were refused leave nothing behind.

mod common;

use common::{beams, drive, outputs, set, span, stepping};
use ttb_bridge::Bridge;
use ttb_contract::Instance;
use ttb_scenario::spec::BridgeSpec;
use ttb_scenario::types::{Damping, RayleighAt};

fn spec() -> BridgeSpec {
    let damping = Damping::Rayleigh { ratio: 0.02, at: RayleighAt::FirstTimes(4.0) };
    BridgeSpec { damping, ..beams(vec![span(20.0, 1.5e10, 5000.0, 12)], 4, 1e-3) }
}

/// Sets of parameters that cannot be built, each with something that could.
const REFUSED: [&[(&str, f64)]; 5] = [
    &[("stiffness_factor", 0.25), ("step_size", 1e-300)],
    &[("mass_factor", 4.0), ("step_size", 1e-300)],
    &[("step_size", 1e-300)],
    &[("stiffness_factor", 0.25), ("beta", 1e-320)],
    &[("stiffness_factor", 4.0), ("damping_ratio", 2.0)],
];

fn refuse(bridge: &mut Instance<Bridge>, parameters: &[(&str, f64)]) {
    parameters.iter().for_each(|(name, value)| set(bridge, name, *value));
    bridge.enter_initialization(0.0).unwrap_err();
}

/// Outputs of five steps.
fn steps(bridge: &mut Instance<Bridge>) -> Vec<Vec<f64>> {
    let step = |k: u32| {
        drive(bridge, &[0.0, 0.0, 1e5, 0.0, 0.0], None);
        bridge.step(f64::from(k) * 1e-3, 1e-3).unwrap();
        outputs(bridge)
    };
    (0..5).map(step).collect()
}

#[test]
fn after_a_reset_the_bridge_answers_as_new() {
    let expected = steps(&mut stepping(&spec()));
    let mut bridge = stepping(&spec());
    for parameters in REFUSED {
        bridge.reset();
        refuse(&mut bridge, parameters);
        bridge.reset();
        bridge.enter_initialization(0.0).unwrap();
        bridge.exit_initialization().unwrap();
        assert_eq!(steps(&mut bridge), expected, "after {parameters:?}");
    }
}

#[test]
fn after_a_good_state_the_bridge_answers_as_new() {
    let expected = steps(&mut stepping(&spec()));
    let mut bridge = stepping(&spec());
    let saved = bridge.save();
    for parameters in REFUSED {
        bridge.reset();
        refuse(&mut bridge, parameters);
        bridge.restore(&saved).unwrap();
        assert_eq!(steps(&mut bridge), expected, "after {parameters:?}");
    }
}
