//! What is found in finite-element models: what is loose, off the deck, without area; an example that is sound.

mod common;
mod girders;

use common::near;
use girders::*;
use serde_json::{Value, json};
use ttb_bridge::space::{Statics, assemble, self_check};
use ttb_scenario::types::Direction;
use ttb_sparse::FactorError;

#[test]
fn what_is_loose_is_named() {
    // two parts, one held by nothing
    let mut value = slab(4, 2);
    value["nodes"].as_array_mut().unwrap().extend([json!([70, 0, 9, 0]), json!([71, 5, 9, 0])]);
    value["beams"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "section": "girder", "orientation": [0, 1, 0], "elements": [[70, 71]] }));
    let check = self_check(&model(&[value]), Statics::Unknown).unwrap();
    assert_eq!(check.loose_parts.iter().map(|part| (part.node, part.nodes)).collect::<Vec<_>>(), [(70, 2)]);
    assert!(check.to_string().contains("not held: the part with node 70 (2 nodes)"), "{check}");

    // a plane truss in space
    let truss = model(&[json!({
        "nodes": [[1, 0, 0, 0], [2, 10, 0, 0], [3, 20, 0, 0], [4, 10, 0, 5]],
        "trusses": [{ "section": "girder", "elements": [[1, 2], [2, 3], [1, 4], [4, 3], [2, 4]] }],
        "bearings": [{ "nodes": [1, 3], "fixed": ["x", "y", "z"] }],
        "deck": { "length": L, "on": { "nodes": [1, 2, 3] } }
    })]);
    let found = assemble(&truss, &[10.0], &[]).err().unwrap().to_string();
    let expected =
        "bridge: mechanism: nothing resists the displacement along y of node 2, the displacement along y of node 4";
    assert_eq!(found, expected);
    assert_eq!(self_check(&truss, Statics::Unknown).unwrap().loose.len(), 2);

    // a girder that rolls about its own axis
    let mut rolling = girder(4, 0.0);
    rolling.bearings[0].fixed.retain(|freedom| freedom.name() != "rx");
    let mut assembled = assemble(&rolling, &[], &[]).unwrap();
    let pencil = std::mem::take(&mut assembled.equations).finish().unwrap();
    let Err(FactorError::NotPositive { dof }) = pencil.factor(1.0, 0.0, 0.0) else { panic!("a mechanism") };
    let name = (assembled.names)(dof);
    assert!(name.starts_with("rotation about x of node "), "{name}");
    let check = self_check(&rolling, Statics::Mechanism(dof)).unwrap();
    assert!(check.mechanism == Some(name) && !check.is_sound());
}

#[test]
fn stations_off_the_deck_are_told() {
    let refused = |changes: Value, x: f64, words: &[&str]| {
        let mut value = slab(4, 2);
        for (key, change) in changes.as_object().unwrap() {
            value["deck"][key] = change.clone();
        }
        let found = assemble(&model(&[value]), &[1.0, x], &[]).err().unwrap().to_string();
        words.iter().for_each(|word| assert!(found.contains(word), "{found}: {word}"));
    };
    refused(json!({}), 21.5, &["support[2] at x = 21.5 m, y = 0.8 m", "no shell", "from x = 0 m to 20 m"]);
    refused(json!({ "y": 3.5 }), 7.0, &["support[1]", "y = 3.5 m", "from y = -3 m to 3 m there"]);
    refused(json!({ "on": { "beams": ["girder"] } }), 20.1, &["support[2]", "no beam", "from x = 0 m to 20 m"]);
    refused(json!({ "on": { "nodes": [4, 7, 10] } }), 18.0, &["support[1]", "no node"]);
    refused(
        json!({ "on": { "nodes": [3, 6, 9] } }),
        18.0,
        &["support[1] at x = 1 m", "no node", "from x = 2.5 m to 17.5 m"],
    );
    let points = [at_node("tip", 4711, Direction::X)];
    let found = assemble(&model(&[slab(4, 2)]), &[1.0], &points).err().unwrap().to_string();
    assert_eq!(found, "bridge: point tip: there is no node numbered 4711");
    // a node of trusses has no rotation to carry an eccentric track
    let truss = model(&[json!({
        "nodes": [[1, 0, 0, 0], [2, 10, 0, 0], [3, 20, 0, 0], [4, 10, 3, 5], [5, 10, -3, 5]],
        "trusses": [{ "section": "girder", "elements": [[1, 2], [2, 3], [1, 4], [4, 3], [2, 4], [1, 5], [5, 3], [2, 5], [4, 5]] }],
        "bearings": [{ "nodes": [1, 3], "fixed": ["x", "y", "z"] }],
        "deck": { "length": L, "y": 1, "on": { "nodes": [2] } }
    })]);
    let found = assemble(&truss, &[10.0], &[]).err().unwrap().to_string();
    assert_eq!(found, "bridge: support[1] at x = 10 m: no element resists the rotation about x of node 2");
}

#[test]
fn shells_and_elements_that_cannot_be_are_named() {
    let mut value = slab(4, 2);
    value["shells"][0]["elements"][3] = json!([4, 7, 5, 8]);
    let found = assemble(&model(&[value]), &[], &[]).err().unwrap().to_string();
    assert!(found.starts_with("bridge: shells[0].elements[3] (nodes [4, 7, 5, 8]): it has no area"), "{found}");
}

#[test]
fn the_box_girder_among_the_examples_is_sound() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/box-girder.json");
    let spec = ttb_scenario::load(&path).unwrap_or_else(|problems| panic!("{problems}")).bridge;
    let ttb_scenario::spec::StructureSpec::FiniteElements(model) = &spec.structure else { panic!("finite elements") };
    let solved = solved(model, &spec.supports, &spec.points);
    let check = self_check(model, Statics::Solved(&mut |x| solved.solve(x))).unwrap();
    assert!(check.is_sound(), "{check}");
    // deck and its dead load, webs, bottom, diaphragms, parapets
    let mass = 2500.0 * (0.3 * 300.0 + 0.4 * 120.0 + 0.25 * 150.0 + 0.8 * 20.0 + 0.2 * 60.0) + 600.0 * 300.0;
    near("mass", check.mass, mass, 1e-9);
    near("centre", check.centre[0], 15.0, 1e-9);
    near("a bearing", check.reactions.unwrap().groups[0].force[2], 0.25 * mass * 9.81, 1e-6);
    let first = solved.frequencies(1)[0];
    assert!((3.0..6.0).contains(&first), "{first}");
    // the loaded edge goes down more than the other
    let mut u = vec![0.0; solved.pencil.ndof()];
    solved.assembled.supports.iter().flatten().for_each(|(dof, weight)| u[*dof as usize] += 1e4 * weight);
    solved.solve(&mut u);
    let value =
        |i: usize| solved.assembled.monitors[i].iter().map(|(dof, weight)| weight * u[*dof as usize]).sum::<f64>();
    assert!(
        value(2) > 1.2 * value(1) && value(1) > 0.0 && value(0) > value(1),
        "{} {} {}",
        value(1),
        value(0),
        value(2)
    );
}
