//! The scenarios that go with the models, and the example made of them.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use ttb_generate::{CableStayed, Viaduct, cable_stayed, cable_stayed_scenario, text, viaduct, viaduct_scenario};
use ttb_scenario::types::Model;

/// Reads both as files, as the program does.
fn checked(model: &Model, scenario: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("bridge.json"), text(model)).unwrap();
    fs::write(folder.path().join("scenario.json"), scenario).unwrap();
    let checked = ttb_scenario::load(&folder.path().join("scenario.json")).unwrap();
    assert_eq!(checked.warnings.len(), 0, "{:?}", checked.warnings);
    serde_json::from_str(scenario).unwrap()
}

#[test]
fn the_scenario_is_valid_and_the_whole_train_crosses() {
    let model = cable_stayed(&CableStayed { dofs: 12_000, ..CableStayed::default() }).unwrap();
    let scenario = checked(&model, &cable_stayed_scenario(&model, "bridge.json", None));
    assert_eq!(scenario["bridge"]["at"], 248);
    assert_eq!(scenario["time"], json!({"step": 1e-3, "end": 8.064}));
    assert_eq!(scenario["track"]["bays"], 1435);
    // last wheel: 7 cars, a bogie distance and a wheelbase behind the first
    let behind = 208.0 + 8.064 * 250.0 / 3.6 - (7.0 * 24.775 + 17.375 + 2.5);
    assert!(behind > 248.0 + model.deck.length, "{behind}");
    let tower = scenario["bridge"]["points"].as_array().unwrap().last().unwrap()["node"].as_str().unwrap();
    let node = model.nodes.iter().find(|node| node.0.to_string() == tower).unwrap();
    assert_eq!((node.1, node.2, node.3), (144.0, 0.0, -50.0));
}

#[test]
fn the_scenarios_of_viaducts_are_valid() {
    for (spans, points) in [(1, 1), (2, 2), (10, 3)] {
        let model = viaduct(&Viaduct { spans, dofs: 12_000, ..Viaduct::default() }).unwrap();
        let scenario = checked(&model, &viaduct_scenario(&model, spans, "bridge.json"));
        assert_eq!(scenario["bridge"]["points"].as_array().unwrap().len(), points);
    }
}

/// With the variable `TTB_BLESS` set, the example is written anew.
#[test]
fn the_example_is_what_the_generator_makes() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/cable-stayed-120k");
    let model = cable_stayed(&CableStayed::default()).unwrap();
    let scenario = |highest| cable_stayed_scenario(&model, "bridge.json", highest);
    let files =
        [("bridge.json", text(&model)), ("scenario.json", scenario(None)), ("reduced.json", scenario(Some(50.0)))];
    for (name, made) in files {
        if std::env::var_os("TTB_BLESS").is_some() {
            fs::write(folder.join(name), &made).unwrap();
        }
        assert!(fs::read_to_string(folder.join(name)).unwrap() == made, "{name}: run with TTB_BLESS=1");
    }
    for name in ["scenario.json", "reduced.json"] {
        ttb_scenario::load(&folder.join(name)).unwrap();
    }
}
