//! Several bridges over one preparation.

mod common;

use std::sync::Arc;

use common::{drive, girder, girder_spec, girder_stations, outputs};
use ttb_bridge::{Bridge, Prepared};
use ttb_contract::Instance;
use ttb_scenario::spec::BridgeSpec;
use ttb_scenario::types::{Damping, RayleighAt, Reduction};

/// Outputs after twenty steps of 1 ms, under forces of one's own.
fn run(bridge: Bridge, seed: usize) -> Vec<f64> {
    let mut instance = Instance::new(bridge);
    instance.enter_initialization(0.0).unwrap();
    instance.exit_initialization().unwrap();
    for k in 0..20 {
        let forces: Vec<f64> = (0..girder_stations().len()).map(|i| 1e4 * ((i * seed + k) % 7) as f64).collect();
        drive(&mut instance, &forces, None);
        instance.step(k as f64 * 1e-3, 1e-3).unwrap();
    }
    outputs(&mut instance)
}

#[test]
fn two_threads_share_one_factor_and_have_the_bits_of_two_bridges_alone() {
    let spec = girder_spec(girder(false));
    let prepared = Prepared::new(&spec).unwrap();
    let threads = [3, 5].map(|seed| {
        let prepared = Arc::clone(&prepared);
        std::thread::spawn(move || run(Bridge::from_prepared(&prepared).unwrap(), seed))
    });
    let together = threads.map(|thread| thread.join().unwrap());
    assert_eq!(prepared.factorisations(), 1);
    let alone = [3, 5].map(|seed| run(Bridge::new(spec.clone()).unwrap(), seed));
    assert_eq!(together, alone);
    assert_ne!(alone[0], alone[1]);
}

#[test]
fn another_step_end_or_damping_ratio_needs_no_new_mesh() {
    let spec = girder_spec(girder(false));
    let prepared = Prepared::new(&spec).unwrap();
    let other = BridgeSpec {
        step: 5e-4,
        end: 7.0,
        damping: Damping::Rayleigh { ratio: 0.03, at: RayleighAt::Hz([4.0, 40.0]) },
        ..spec.clone()
    };
    let over = run(Bridge::over(&prepared, &other).unwrap(), 3);
    assert_eq!(over, run(Bridge::new(other).unwrap(), 3));
    assert_eq!(prepared.factorisations(), 1);
    // The first one's own step, then that of the other again: nothing is factorised twice.
    run(Bridge::from_prepared(&prepared).unwrap(), 3);
    run(Bridge::from_prepared(&prepared).unwrap(), 4);
    assert_eq!(prepared.factorisations(), 2);
}

#[test]
fn another_structure_is_no_matter_of_the_run() {
    let spec = girder_spec(girder(false));
    let prepared = Prepared::new(&spec).unwrap();
    let supports = BridgeSpec { supports: vec![3.0, 6.0], ..spec.clone() };
    let modes = BridgeSpec { modes: Some(3), ..spec.clone() };
    let damping = BridgeSpec { damping: Damping::None, ..spec.clone() };
    let reduced = BridgeSpec { reduction: Some(Reduction::default()), ..spec };
    for other in [supports, modes, damping, reduced] {
        assert!(!prepared.serves(&other));
        assert!(Bridge::over(&prepared, &other).err().unwrap().0.contains("another structure"));
    }
}
