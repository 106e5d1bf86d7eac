//! Interface list of the train–track subsystem: inputs, then outputs, then parameters.

use ttb_contract::names::support;
use ttb_contract::{Component, Interface, Variable};
use ttb_scenario::spec::TrainTrackSpec;

use crate::{outputs, parameters};

/// Texts of the deck's position and rate under a support: vertical in a plane run, of all components in space.
const TEXTS: [[&str; 2]; 3] = [
    [
        "Displacement of the deck under the support, down, from the dead-load state",
        "Velocity of the deck under the support, down",
    ],
    [
        "Displacement of the deck under the support at the rail's foot, to the right, from the dead-load state",
        "Velocity of the deck under the support, to the right",
    ],
    [
        "Rotation of the deck under the support about the track's axis, right side down, from the dead-load state",
        "Angular velocity of the deck under the support, right side down",
    ],
];

/// The interface list for `spec`.
pub fn interface(spec: &TrainTrackSpec) -> Interface {
    let components = if spec.space.is_some() { &Component::ALL[..] } else { &Component::ALL[..1] };
    let mut inputs = Vec::new();
    for (port, texts) in components.iter().zip(TEXTS) {
        let names = [port.position(), port.rate()];
        for ((name, unit), text) in names.into_iter().zip(port.motion_units()).zip(texts) {
            inputs.extend((1..=spec.on_bridge.len()).map(|i| Variable::input(support(i, name), unit, text)));
        }
    }
    Interface::new(inputs, outputs::variables(spec), parameters::variables(spec))
}
