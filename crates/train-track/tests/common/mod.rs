//! A short train on a short track on a rigid deck, to be varied by each test.

#![allow(dead_code, reason = "each test file uses its part")]

use ttb_contract::Instance;
use ttb_scenario::spec::{Profile, TrainTrackSpec};
use ttb_scenario::types::{Car, Contact, ContactLaw, Newmark, Rail, Spring, Support, TrackType, Tread};
use ttb_train_track::TrainTrack;

/// One ICE-3 trailer on slab track (docs/theory.md 15), the middle third of 60 bays on a bridge.
pub fn spec() -> TrainTrackSpec {
    let ei = 2.06e11 * 2.0 * 3.217e-5;
    TrainTrackSpec {
        cars: vec![trailer()],
        vehicles: Vec::new(),
        front_wheel: 30.0,
        speed: vec![[0.0, 250.0 / 3.6]],
        pre_roll: 0.0,
        contact: Contact {
            law: ContactLaw::Hertz,
            wheels_per_axle: 1,
            hertz_constant: None,
            tread: Tread::Worn,
            wheel_radius: 0.46,
        },
        track: TrackType {
            rail: Rail { bending_stiffness: ei, mass: 121.28, shear_stiffness: None, rotary_inertia: 0.0 },
            support: Support::SingleLayer { fastener: Spring { stiffness: 1e8, damping: 7.25e4 } },
            spacing: 0.65,
            source: String::new(),
        },
        from: 0.0,
        bays: 90,
        elements_per_bay: 2,
        local_compliance: true,
        on_bridge: (30..60).collect(),
        irregularity: Profile::None,
        irregularity_scale: 1.0,
        rail_points: Vec::new(),
        step: 1e-3,
        substeps: 1,
        end: 0.3,
        newmark: Newmark { gamma: 0.5, beta: 0.25 },
        space: None,
    }
}

/// ICE-3 trailer.
pub fn trailer() -> Car {
    ttb_scenario::bundled::cars("ice3-trailer").expect("bundled")[0].clone()
}

/// An initialized, started instance.
pub fn started(spec: TrainTrackSpec) -> Instance<TrainTrack> {
    initialized(TrainTrack::new(spec).expect("valid"))
}

/// An initialized, started instance of a model.
pub fn initialized(model: TrainTrack) -> Instance<TrainTrack> {
    let mut instance = Instance::new(model);
    instance.enter_initialization(0.0).expect("initialization");
    instance.exit_initialization().expect("start");
    instance
}

/// Value of a variable by name.
pub fn value(instance: &mut Instance<TrainTrack>, name: &str) -> f64 {
    let reference =
        ttb_contract::Model::interface(instance.model()).find(name).unwrap_or_else(|| panic!("no variable {name}"));
    let mut out = [0.0];
    instance.get(&[reference as u32], &mut out).expect("readable");
    out[0]
}
