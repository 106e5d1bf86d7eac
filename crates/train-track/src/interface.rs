//! Interface list of the train–track subsystem: inputs, then outputs, then parameters.

use ttb_contract::names::support;
use ttb_contract::{Component, Interface, Variable};
use ttb_scenario::spec::TrainTrackSpec;

use crate::{outputs, parameters};

/// Texts of the deck's position and rate under a support; supports are vertical ports.
const TEXTS: [&str; 2] = [
    "Displacement of the deck under the support, down, from the dead-load state",
    "Velocity of the deck under the support, down",
];

/// The interface list for `spec`.
pub fn interface(spec: &TrainTrackSpec) -> Interface {
    let port = Component::Vertical;
    let names = [port.position(), port.rate()];
    let mut inputs = Vec::new();
    for ((name, unit), text) in names.into_iter().zip(port.motion_units()).zip(TEXTS) {
        inputs.extend((1..=spec.on_bridge.len()).map(|i| Variable::input(support(i, name), unit, text)));
    }
    Interface::new(inputs, outputs::variables(spec), parameters::variables(spec))
}
