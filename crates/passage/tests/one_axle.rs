//! One axle a speed gives what the modal way gives, on a solution in all degrees of freedom that shares no equation with it.

mod common;

use std::path::Path;

use common::{b25, beams, close, output, train};
use ttb_passage::one_axle::Unit;
use ttb_passage::own::OwnBridge;
use ttb_passage::{Heading, ModalBridge, Output, Passage, Quantity, Response, Settings};
use ttb_scenario::spec::BridgeSpec;
use ttb_scenario::types::{Damping, RayleighAt};

/// Both ways, with all modes up to `highest` Hz in the modal one.
fn both(spec: &BridgeSpec, highest: f64, name: &str, km_h: f64, h: f64) -> [(Vec<Output>, Response); 2] {
    let (train, speed, free) = (train(name), km_h / 3.6, 1.0);
    let settings = Settings { highest_frequency: Some(highest), forces: true, ..Settings::default() };
    let modal = ModalBridge::new(spec, &settings).unwrap();
    let passage = Passage::new(&modal, &train, Heading::Forward, Some(free));
    let own = OwnBridge::new(spec, h).unwrap();
    let time = (modal.length() + train.length()) / speed + free;
    let unit = Unit::run(&mut own.at_rest().unwrap(), own.path(), speed, h, time).unwrap();
    for (output, error) in unit.outputs.iter().zip(&unit.errors) {
        let most = if output.quantity == Quantity::Displacement { 1e-4 } else { f64::INFINITY };
        assert!(*error <= most, "{} at {}: {error:e}", output.quantity, output.place.name);
        if output.place.name == "12.5" || output.place.name == "24" {
            println!("{} at {}: error {error:.1e}", output.quantity, output.place.name);
        }
    }
    let response = unit.response(&train, free);
    [(modal.outputs().to_vec(), passage.at(speed)), (unit.outputs.clone(), response)]
}

fn compare(ways: &[(Vec<Output>, Response); 2], quantity: Quantity, place: &str, tolerance: f64) {
    let [modal, axle] = [0, 1].map(|i| {
        let (outputs, response) = &ways[i];
        response.extremes[output(outputs, quantity, place)].largest().0.abs()
    });
    close(axle, modal, tolerance, &format!("{quantity} at {place}"));
}

#[test]
fn a_beam_in_all_degrees_of_freedom_answers_as_its_modes() {
    let at = RayleighAt::FirstTimes(4.0);
    let spec = BridgeSpec { damping: Damping::Rayleigh { ratio: 0.01, at }, modes: None, ..b25() };
    let ways = both(&spec, 200.0, "hslm-a3", 250.0, 5e-4);
    for place in ["12.5", "6.25", "20"] {
        compare(&ways, Quantity::Displacement, place, 1e-3);
        compare(&ways, Quantity::Acceleration, place, 5e-3);
        compare(&ways, Quantity::Moment, place, 5e-3);
    }
}

#[test]
fn a_frame_in_all_degrees_of_freedom_answers_as_its_modes() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/strutted-frame.json");
    let spec = ttb_scenario::load(&file).unwrap().bridge;
    let ways = both(&spec, 200.0, "ice2", 180.0, 5e-4);
    for place in ["24", "9.6"] {
        compare(&ways, Quantity::Displacement, place, 2e-3);
        compare(&ways, Quantity::Acceleration, place, 1e-2);
    }
}

/// In as many modes both solve the same equations: what is left are superposition and Newmark's method.
#[test]
fn superposition_is_exact_to_one_in_ten_thousand_in_few_modes() {
    let spec = BridgeSpec { damping: Damping::Modal { ratio: 0.01, modes: 3 }, ..b25() };
    let (train, speed, h) = (train("hslm-a3"), 250.0 / 3.6, 2.5e-4);
    let own = OwnBridge::new(&spec, h).unwrap();
    let time = (25.0 + train.length()) / speed + 1.0;
    let unit = Unit::run(&mut own.at_rest().unwrap(), own.path(), speed, h, time).unwrap();
    for (output, error) in unit.outputs.iter().zip(&unit.errors) {
        assert!(*error <= 1e-4, "{} at {}: {error:e}", output.quantity, output.place.name);
    }
    let response = unit.response(&train, 1.0);
    let peak = |quantity| response.extremes[output(&unit.outputs, quantity, "12.5")].largest().0.abs();
    close(1e3 * peak(Quantity::Displacement), 26.9467, 2e-3, "w");
    close(peak(Quantity::Acceleration), 10.057, 5e-3, "a");
}

/// Two continuous spans: at the inner bearing the axle reaches the ground.
#[test]
fn a_continuous_beam_answers_as_its_modes() {
    let spans = [[24.0, 16e3, 50e9]; 2];
    let at = RayleighAt::FirstTimes(4.0);
    let spec = BridgeSpec { damping: Damping::Rayleigh { ratio: 0.01, at }, ..beams(&spans, true, 0.01, None) };
    let ways = both(&spec, 200.0, "ice2", 290.0, 5e-4);
    compare(&ways, Quantity::Displacement, "12", 2e-3);
    compare(&ways, Quantity::Acceleration, "36", 1e-2);
}
