//! Bridges of the tests.

#![allow(dead_code)]

use ttb_passage::{Heading, ModalBridge, Output, Passage, Quantity, Response, Settings};
use ttb_scenario::spec::{BridgeSpec, Span, StructureSpec};
use ttb_scenario::types::{Damping, Newmark};
use ttb_trains::ForceTrain;

/// Spans of one beam: length, mass, EI.
pub fn spans(list: &[[f64; 3]]) -> Vec<Span> {
    let span = |[length, mass, bending_stiffness]: &[f64; 3]| Span {
        length: *length,
        bending_stiffness: *bending_stiffness,
        mass: *mass,
        shear_stiffness: None,
        elements: 20,
    };
    list.iter().map(span).collect()
}

/// A beam bridge with the same damping ratio in all modes.
pub fn beams(list: &[[f64; 3]], continuous: bool, ratio: f64, modes: Option<usize>) -> BridgeSpec {
    BridgeSpec {
        structure: StructureSpec::Beams { spans: spans(list), continuous },
        damping: Damping::Modal { ratio, modes: 1000 },
        modes,
        reduction: None,
        supports: Vec::new(),
        points: Vec::new(),
        step: 1e-3,
        end: 1.0,
        newmark: Newmark::default(),
        space: false,
        ground: None,
        ground_points: Vec::new(),
    }
}

/// L 25 m, 15 t/m, EI 30 GN m², ζ 1 %.
pub fn b25() -> BridgeSpec {
    beams(&[[25.0, 15e3, 30e9]], false, 0.01, Some(3))
}

/// L 15 m, 15 t/m, 5 Hz, ζ 1 %.
pub fn b15() -> BridgeSpec {
    beams(&[[15.0, 15e3, 7.694081e9]], false, 0.01, Some(3))
}

pub fn modal(spec: &BridgeSpec) -> ModalBridge {
    ModalBridge::new(spec, &Settings::default()).unwrap()
}

pub fn with_forces(spec: &BridgeSpec) -> ModalBridge {
    ModalBridge::new(spec, &Settings { forces: true, ..Settings::default() }).unwrap()
}

pub fn train(name: &str) -> ForceTrain {
    ttb_trains::find(name).unwrap().remove(0)
}

/// A train at a speed in km/h.
pub fn run(bridge: &ModalBridge, name: &str, km_h: f64) -> Response {
    Passage::new(bridge, &train(name), Heading::Forward, None).at(km_h / 3.6)
}

/// Number of an output.
pub fn output(outputs: &[Output], quantity: Quantity, place: &str) -> usize {
    let found = outputs.iter().position(|o| o.quantity == quantity && o.place.name == place);
    found.unwrap_or_else(|| panic!("no {quantity} at {place}: {outputs:?}"))
}

/// The largest magnitude of a quantity at a place.
pub fn peak(bridge: &ModalBridge, response: &Response, quantity: Quantity, place: &str) -> f64 {
    response.extremes[output(bridge.outputs(), quantity, place)].largest().0.abs()
}

pub fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    let error = found / expected - 1.0;
    assert!(error.abs() <= tolerance, "{what}: {found} is {:.3} % from {expected}", 100.0 * error);
}
