//! Finite-element models in space against closed forms, the plane models and themselves.

mod common;
mod girders;

use common::{beams, near, span};
use girders::*;
use serde_json::{Value, json};
use ttb_bridge::Bridge;
use ttb_bridge::space::{Statics, assemble, self_check};
use ttb_scenario::types::{Direction, Model};

#[test]
fn a_beam_held_to_its_plane_is_the_plane_beam() {
    let n = 20;
    let mut flat = girder(n, 0.0);
    let all = json!([{ "nodes": (0..=n).collect::<Vec<_>>(), "fixed": ["x", "y", "rx", "rz"] },
        { "nodes": [0, n], "fixed": ["z"] }]);
    flat.bearings = serde_json::from_value(all).unwrap();
    let space = solved(&flat, &[7.3, 10.0], &[]);
    let plane = Bridge::new(beams(vec![span(L, EI, MASS, n)], 10, 1e-3)).unwrap();
    assert_eq!(space.pencil.ndof(), plane.ndof());
    near("mass", space.assembled.mass, plane.mass(), 1e-12);
    near("mid-span", space.flexibility(1, 1), L.powi(3) / (48.0 * EI), 1e-9);
    near("Maxwell and Betti", space.flexibility(0, 1), space.flexibility(1, 0), 1e-12);
    for (mode, (a, b)) in space.frequencies(5).iter().zip(plane.natural_frequencies(5).unwrap()).enumerate() {
        near(&format!("frequency {}", mode + 1), *a, b, 1e-9);
    }
}

#[test]
fn a_track_beside_the_axis_twists_the_deck() {
    let e = 1.5;
    let space = solved(&girder(20, e), &[10.0], &[]);
    near("bent and twisted", space.flexibility(0, 0), L.powi(3) / (48.0 * EI) + e * e * L / (4.0 * GJ), 1e-9);
    // halfway between two girders both carry; off it the nearer one
    let twin = |y: f64| {
        let shifted = |i: usize, y: f64| json!([i + if y > 0.0 { 100 } else { 0 }, L * i as f64 / 20.0, y, 0]);
        let both: Vec<Value> = (0..=20).flat_map(|i| [shifted(i, -2.0), shifted(i, 2.0)]).collect();
        let pairs: Vec<[usize; 2]> =
            [0, 100].iter().flat_map(|o| chain(20).into_iter().map(move |e| e.map(|i| i + o))).collect();
        model(&[json!({
            "nodes": both,
            "beams": [{ "section": "girder", "orientation": [0, 1, 0], "elements": pairs }],
            "bearings": [{ "nodes": [0, 20, 100, 120], "fixed": ["x", "y", "z", "rx"] }],
            "deck": { "length": L, "y": y, "on": { "beams": ["girder"] } }
        })])
    };
    let alone = |arm: f64| L.powi(3) / (48.0 * EI) + arm * arm * L / (4.0 * GJ);
    near("between both", solved(&twin(0.0), &[10.0], &[]).flexibility(0, 0), 0.5 * alone(2.0), 1e-9);
    near("left of the middle", solved(&twin(-0.5), &[10.0], &[]).flexibility(0, 0), alone(1.5), 1e-9);
}

/// Beams under a slab, linked rigidly; nothing is held but by springs to the ground, so that every motion is free.
fn afloat(on: &Value) -> Model {
    let mut nodes = Vec::new();
    for i in 0..=4 {
        let x = 5.0 * f64::from(i);
        nodes.extend([
            json!([10 * i + 1, x, -2, 0.1 * x]),
            json!([10 * i + 2, x, 2.5, 0]),
            json!([10 * i + 3, x, 0.2, 1]),
        ]);
    }
    let bay = |i: usize| [10 * i + 1, 10 * i + 11, 10 * i + 12, 10 * i + 2];
    model(&[json!({
        "nodes": nodes,
        "shells": [{ "section": "slab", "elements": [bay(0), bay(1), bay(3), [21, 31, 32], [21, 32, 22]] }],
        "beams": [{ "section": "girder", "orientation": [0, 1, 0], "elements": [[3, 13], [13, 23], [23, 33], [33, 43]],
            "offsets": [[0, 0.1, 0.5], [0, -0.1, 0.5]] }],
        "rigid_links": [{ "leader": 3, "followers": [1, 2] }, { "leader": 43, "followers": [41, 42] }],
        "constraints": [{ "terms": [[22, "z", 1], [23, "z", -1], [23, "rx", -2.3]] }],
        "springs": [{ "elements": [[3], [43], [23]], "stiffness": [1e7, 1e7, 1e8, 1e8, 1e8, 1e8] }],
        "deck": { "length": L, "y": 0.7, "on": on }
    })])
}

#[test]
fn supports_follow_rigid_motions_on_every_carrier_also_through_ties() {
    let stations = [0.0, 0.4, 5.0, 7.9, 12.5, 18.0, 20.0];
    for on in [
        json!({ "shells": ["slab"] }),
        json!({ "beams": ["girder"] }),
        json!({ "nodes": [] }),
        json!({ "nodes": [3, 13, 22, 43] }),
    ] {
        let assembled = assemble(&afloat(&on), &stations, &[at_node("follower", 1, Direction::Y)]).unwrap();
        // rigid motion: translation t and rotation r about the origin
        let (t, r) = ([0.3, -0.2, 0.7], [0.011, 0.017, -0.013]);
        let motion = |[x, y, z]: [f64; 3]| {
            let turned = [r[1] * z - r[2] * y, r[2] * x - r[0] * z, r[0] * y - r[1] * x];
            [t[0] + turned[0], t[1] + turned[1], t[2] + turned[2], r[0], r[1], r[2]]
        };
        let names = ["along x", "along y", "along z", "about x", "about y", "about z"];
        let u: Vec<f64> = (0..assembled.node_of.len())
            .map(|dof| {
                let name = (assembled.names)(dof);
                let place = assembled.nodes[assembled.node_of[dof] as usize];
                motion(place)[names.iter().position(|words| name.contains(words)).unwrap()]
            })
            .collect();
        let value = |row: &[(u32, f64)]| row.iter().map(|(dof, weight)| weight * u[*dof as usize]).sum::<f64>();
        for (x, row) in stations.iter().zip(&assembled.supports) {
            near(&format!("{on} {x}"), value(row), motion([*x, 0.7, 0.0])[2], 1e-9);
        }
        near("a follower", value(&assembled.monitors[0]), motion([0.0, -2.0, 0.0])[1], 1e-9);
        // no strain in a rigid motion, but of the springs to the ground: ties are exact
        let pencil = assembled.equations.finish().unwrap();
        let mut force = vec![0.0; u.len()];
        pencil.add_stiffness(&u, &mut force);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let springs = [[0.0, 0.2, 1.0], [20.0, 0.2, 1.0], [10.0, 0.2, 1.0]].map(|place| {
            let [x, y, z, rx, ry, rz] = motion(place);
            1e7 * (x * x + y * y) + 1e8 * (z * z + rx * rx + ry * ry + rz * rz)
        });
        near("strain energy", dot(&u, &force), springs.iter().sum(), 1e-6);
    }
}

#[test]
fn a_rigid_link_is_an_offset() {
    let n = 8;
    let arm = [0.0, 0.4, 0.9];
    let offset = model(&[json!({
        "nodes": line(n),
        "beams": [{ "section": "girder", "orientation": [0, 1, 0], "elements": chain(n), "offsets": [arm, arm] }],
        "bearings": [{ "nodes": [0, n], "fixed": ["x", "y", "z", "rx"] }],
        "deck": { "length": L, "on": { "nodes": (1..n).collect::<Vec<_>>() } }
    })]);
    let mut nodes = line(n);
    nodes.extend((0..=n).map(|i| json!([100 + i, L * i as f64 / n as f64, arm[1], arm[2]])));
    let links: Vec<Value> = (0..=n).map(|i| json!({ "leader": i, "followers": [100 + i] })).collect();
    let linked = model(&[json!({
        "nodes": nodes,
        "beams": [{ "section": "girder", "orientation": [0, 1, 0],
            "elements": chain(n).into_iter().map(|e| e.map(|i| i + 100)).collect::<Vec<_>>() }],
        "rigid_links": links,
        "bearings": [{ "nodes": [0, n], "fixed": ["x", "y", "z", "rx"] }],
        "deck": { "length": L, "on": { "nodes": (1..n).collect::<Vec<_>>() } }
    })]);
    let (offset, linked) = (solved(&offset, &[6.0, 10.0], &[]), solved(&linked, &[6.0, 10.0], &[]));
    assert_eq!(offset.pencil.ndof(), linked.pencil.ndof());
    near("flexibility", offset.flexibility(0, 1), linked.flexibility(0, 1), 1e-9);
    for (a, b) in offset.frequencies(6).into_iter().zip(linked.frequencies(6)) {
        near("frequency", a, b, 1e-9);
    }
}

#[test]
fn constraints_join_what_is_cut() {
    let n = 8;
    // the second half begins at node 50, where the first ends at node 4, both in one place
    let mut nodes = line(n);
    nodes.extend([json!([50, 10, 0, 0]), json!([51, 10, 0, 0])]);
    let halves = [[0, 1], [1, 2], [2, 3], [3, 4], [50, 5], [5, 6], [6, 7], [7, 8]];
    // over a node between them that no element meets: a chain of ties
    let joined = |freedom: &str| {
        [
            json!({ "terms": [[50, freedom, 2], [51, freedom, -2]] }),
            json!({ "terms": [[51, freedom, 1], [4, freedom, -1]] }),
        ]
    };
    let ties: Vec<Value> = ["x", "y", "z", "rx", "ry", "rz"].iter().flat_map(|freedom| joined(freedom)).collect();
    let cut = model(&[json!({
        "nodes": nodes,
        "beams": [{ "section": "girder", "orientation": [0, 1, 0], "elements": halves }],
        "constraints": ties,
        "bearings": [{ "nodes": [0, n], "fixed": ["y", "z", "rx"] }, { "nodes": [0], "fixed": ["x"] }]
    })]);
    let (cut, whole) = (solved(&cut, &[10.0, 12.0], &[]), solved(&girder(n, 0.0), &[10.0, 12.0], &[]));
    assert_eq!(cut.pencil.ndof(), whole.pencil.ndof());
    near("mid-span", cut.flexibility(0, 0), whole.flexibility(0, 0), 1e-9);
    near("beyond", cut.flexibility(1, 0), whole.flexibility(1, 0), 1e-9);
    for (a, b) in cut.frequencies(6).into_iter().zip(whole.frequencies(6)) {
        near("frequency", a, b, 1e-9);
    }
}

#[test]
fn a_hinge_by_release_bends_no_more() {
    // fixed ends, released about the bending axis there: a simply supported beam again
    let n = 4;
    let fixed = ["x", "y", "z", "rx", "ry", "rz"];
    let beam = |elements: Value, releases: Value| {
        json!({
        "section": "girder", "orientation": [0, 1, 0], "elements": elements, "releases": releases })
    };
    let hinged = model(&[json!({
        "nodes": line(n),
        "beams": [beam(json!([[0, 1]]), json!([["ry"], []])), beam(json!([[1, 2]]), json!([[], []])),
            beam(json!([[2, 3]]), json!([[], []])), beam(json!([[3, 4]]), json!([[], ["rz"]]))],
        "bearings": [{ "nodes": [0, n], "fixed": fixed }]
    })]);
    // axis 2 along y, axis 3 = x × y = z: bending in the vertical plane turns about axis 2
    let hinged = solved(&hinged, &[10.0], &[]).flexibility(0, 0);
    // propped: one end fixed, the other simply supported, F at mid-span: 7 F L³/(768 EI)
    near("propped", hinged, 7.0 * L.powi(3) / (768.0 * EI), 1e-9);
}

#[test]
fn the_ground_carries_the_weight_and_nothing_else() {
    let mut value = slab(10, 6);
    // a walkway on rigid arms, a heavy post, and a spring to the ground beside the bearings
    value["nodes"].as_array_mut().unwrap().extend([json!([900, 10, 4, -1]), json!([901, 6, 5, 2])]);
    value["rigid_links"] = json!([{ "leader": 41, "followers": [900] }, { "leader": 900, "followers": [901] }]);
    value["masses"] = json!([{ "nodes": [900, 901], "mass": 5000, "inertia": [10, 20, 30] }]);
    value["springs"] = json!([{ "elements": [[38]], "stiffness": [0, 0, 2e7, 0, 0, 0] }]);
    let model = model(&[value]);
    let solved = solved(&model, &[], &[]);
    let check = self_check(&model, Statics::Solved(&mut |x| solved.solve(x))).unwrap();
    near("mass", check.mass, 2500.0 * 0.4 * 120.0 + MASS * L + 1e4, 1e-12);
    near("mass assembled", solved.assembled.mass, check.mass, 1e-12);
    near("x", check.centre[0], (10.0 * (check.mass - 5000.0) + 6.0 * 5000.0) / check.mass, 1e-12);
    near("y", check.centre[1], 9.0 * 5000.0 / check.mass, 1e-9);
    near("z", check.centre[2], (0.8 * MASS * L + 5000.0) / check.mass, 1e-9);
    assert!(check.is_sound(), "{check}");
    let reactions = check.reactions.as_ref().unwrap();
    assert!(reactions.imbalance(check.size) < 1e-8, "{reactions}");
    assert_eq!(reactions.groups.iter().map(|group| group.nodes).collect::<Vec<_>>(), [7, 7, 1]);
    assert!(reactions.groups.iter().all(|group| group.force[2] > 0.0) && reactions.sag.0 > 0.0);
    let text = check.to_string();
    assert!(text.contains("springs to the ground (1 nodes)") && text.contains("bearings[1] (7 nodes)"), "{text}");
    // by hand: the simply supported girder of one axis gives half to either end
    let alone = girder(4, 0.0);
    let one = self::solved(&alone, &[], &[]);
    let check = self_check(&alone, Statics::Solved(&mut |x| one.solve(x))).unwrap();
    near("half", check.reactions.unwrap().groups[0].force[2], MASS * L * 9.81, 1e-9);
}
