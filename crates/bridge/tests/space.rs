//! Finite-element models in space against closed forms, the plane models and themselves.

mod common;
mod girders;

use common::{beams, near, span};
use girders::*;
use serde_json::{Value, json};
use ttb_bridge::Bridge;
use ttb_bridge::space::{Statics, assemble, self_check};
use ttb_contract::{Instance, Model as _};
use ttb_record::Table;
use ttb_scenario::ground::GroundSeries;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::{Damping, DeckCarrier, Direction, Model, Point, RayleighAt, Reduction};

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

/// A run in space over the girder: three forces and motions at each of the supports at a quarter, the middle and 0.7 L.
fn in_space(model: Model) -> BridgeSpec {
    let spec = common::bridge(StructureSpec::FiniteElements(Box::new(model)), L, 1, 1e-3);
    BridgeSpec { supports: vec![5.0, 10.0, 14.0], points: Vec::new(), damping: Damping::None, space: true, ..spec }
}

/// Motions (z, y, about x at each support) of a structure at rest under forces at its supports.
fn at_rest(spec: &BridgeSpec, forces: &[(&str, f64)], motions: &[&str]) -> Vec<f64> {
    let mut instance = Instance::new(Bridge::new(spec.clone()).unwrap_or_else(|error| panic!("{error}")));
    instance.enter_initialization(0.0).unwrap();
    forces.iter().for_each(|(name, force)| common::set(&mut instance, name, *force));
    motions.iter().map(|name| common::get(&mut instance, name)).collect()
}

/// EI of lateral bending.
const EI_Z: f64 = 3e10 * 0.4;
const MIDDLE: [&str; 3] = ["support[2].displacement", "support[2].displacement_y", "support[2].rotation_x"];

#[test]
fn forces_across_and_about_the_track_bend_and_twist_the_deck() {
    let [bend, sway, twist] = [L.powi(3) / (48.0 * EI), L.powi(3) / (48.0 * EI_Z), L / (4.0 * GJ)];
    let source = "fork ends, 10 kN and 10 kN m at mid-span: P L³/48EI, P L³/48EI_z, T L/4GJ; y 1.2 m, h 0.7 m";
    let mut table = Table::new("girder under forces across and about the track", source, "-p ttb-bridge --test space");
    let centred = in_space(girder(20, 0.0));
    let across = at_rest(&centred, &[("support[2].force_y", 1e4)], &MIDDLE);
    table.row("lateral displacement by a lateral force, m", 1e4 * sway, across[1], 1e-9);
    let about = at_rest(&centred, &[("support[2].moment_x", 1e4)], &MIDDLE);
    table.row("rotation by a moment, rad", 1e4 * twist, about[2], 1e-9);
    let off = [across[0], across[2], about[0], about[1]];
    assert!(off.iter().all(|x| x.abs() < 1e-15), "a force on the axis moves its own direction alone: {off:?}");
    // Eccentric by y, the reference point above the axis by h: u_z = r y, u_y = r h.
    let (y, h) = (1.2, 0.7);
    let mut eccentric = girder(20, y);
    eccentric.deck.z = Some(-h);
    let eccentric = in_space(eccentric);
    let down = at_rest(&eccentric, &[("support[2].force", 1e4)], &MIDDLE);
    table.row("beside the axis: down by a force down, m", 1e4 * (bend + y * y * twist), down[0], 1e-9);
    table.row("across by a force down, m", 1e4 * h * y * twist, down[1], 1e-9);
    table.row("rotation by a force down, rad", 1e4 * y * twist, down[2], 1e-9);
    let across = at_rest(&eccentric, &[("support[2].force_y", 1e4)], &MIDDLE);
    table.row("across by a lateral force, m", 1e4 * (sway + h * h * twist), across[1], 1e-9);
    table.row("down by a lateral force, m", 1e4 * h * y * twist, across[0], 1e-9);
    table.finish();
}

/// On beams, on nodes, on shells: after a step.
#[test]
fn what_a_deck_answers_is_symmetric_in_all_components() {
    let mut nodes = girder(20, 0.8);
    nodes.deck.on = DeckCarrier::Nodes(vec![]);
    nodes.deck.z = Some(-0.4);
    let shells = model(&[slab(10, 4)]);
    for model in [girder(20, 0.8), nodes, shells] {
        let spec = in_space(model);
        let names = |last: [&str; 3]| -> Vec<String> {
            last.iter().flat_map(|last| (1..=3).map(move |i| format!("support[{i}].{last}"))).collect()
        };
        let forces = names(["force", "force_y", "moment_x"]);
        let motions = names(["displacement", "displacement_y", "rotation_x"]);
        let s: Vec<Vec<f64>> = forces
            .iter()
            .map(|force| {
                let mut instance = common::stepping(&spec);
                let zero = vec![0.0; 9];
                common::drive(&mut instance, &zero, Some(&zero));
                common::set(&mut instance, force, 1.0);
                instance.step(0.0, 1e-3).unwrap();
                motions.iter().map(|name| common::get(&mut instance, name)).collect()
            })
            .collect();
        let largest = |i: usize, j: usize| (s[i][i] * s[j][j]).sqrt();
        for (i, j) in (0..9).flat_map(|i| (0..i).map(move |j| (i, j))) {
            assert!((s[i][j] - s[j][i]).abs() < 1e-10 * largest(i, j), "{i} {j}: {} {}", s[i][j], s[j][i]);
            assert!(s[i][j].abs() <= largest(i, j));
        }
        assert!((0..9).all(|i| s[i][i] > 0.0));
    }
}

/// In all degrees of freedom, in modes and reduced; the reduced one also from the file of its FMU.
#[test]
fn states_come_back_exactly_and_a_reduced_model_twists_as_the_full_one() {
    let mut model = girder(20, 0.8);
    model.deck.z = Some(-0.6);
    let full =
        BridgeSpec { damping: Damping::Rayleigh { ratio: 0.02, at: RayleighAt::Hz([4.0, 40.0]) }, ..in_space(model) };
    let modes = BridgeSpec { modes: Some(30), ..full.clone() };
    let reduced = BridgeSpec { reduction: Some(Reduction { error: 1e-4, ..Reduction::default() }), ..full.clone() };
    let mut ends = Vec::new();
    for spec in [&full, &modes, &reduced] {
        let mut instance = common::stepping(spec);
        let drive = |instance: &mut Instance<Bridge>, k: usize| {
            let forces: Vec<f64> = (0..9).map(|i| 1e4 * ((i + 1) as f64 * 0.01 * k as f64).sin()).collect();
            let rates: Vec<f64> =
                (0..9).map(|i| 1e4 * ((i + 1) as f64 * 0.01 * (k + 1) as f64).sin() - forces[i]).collect();
            common::drive(instance, &forces, Some(&rates.iter().map(|rate| 1e3 * rate).collect::<Vec<_>>()));
            instance.step(1e-3 * k as f64, 1e-3).unwrap();
        };
        (0..60).for_each(|k| drive(&mut instance, k));
        let saved = instance.save();
        drive(&mut instance, 60);
        let first = common::outputs(&mut instance);
        drive(&mut instance, 61);
        instance.restore(&saved).unwrap();
        drive(&mut instance, 60);
        assert_eq!(first, common::outputs(&mut instance), "repeated to the bit");
        ends.push(first);
    }
    let scale = |block: usize| ends[0][3 * block..3 * block + 3].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for block in [0, 2, 4] {
        for (found, expected) in ends[2].iter().zip(&ends[0]).skip(3 * block).take(3) {
            let off = (found - expected).abs() / scale(block);
            assert!(off < 1e-3, "block {block}: {found} instead of {expected}");
        }
    }
}

#[test]
fn a_plane_bridge_in_space_has_vertical_ports_alone() {
    let plane = BridgeSpec { space: true, ..beams(vec![span(L, EI, MASS, 10)], 10, 1e-3) };
    let bridge = Bridge::new(plane).unwrap();
    let names: Vec<&str> = bridge.interface().variables().iter().map(|variable| variable.name.as_str()).collect();
    assert!(!names.iter().any(|name| name.ends_with("force_y") || name.ends_with("rotation_x")), "{names:?}");
}

/// Matrices of the girder, z up and y to the left as another program may have them: the same answers as from the model.
#[test]
fn imported_matrices_sway_and_twist_as_their_model() {
    let model = girder(20, 0.0);
    let Solved { assembled, pencil, .. } = solved(&model, &[], &[]);
    let n = pencil.ndof();
    let folder = tempfile::tempdir().unwrap();
    // Rows by node and direction; z and y change their signs, and so do their rotations.
    let place = |row: usize| {
        let name = (assembled.names)(row);
        let node: usize = name.rsplit(' ').next().unwrap().parse().unwrap();
        let freedom = ["x", "y", "z"].iter().position(|axis| name.contains(&format!(" {axis} of"))).unwrap();
        (node, freedom + if name.starts_with("rotation") { 3 } else { 0 })
    };
    let sign = |freedom: usize| if freedom.is_multiple_of(3) { 1.0 } else { -1.0 };
    let mut rows = "row,node,direction\n".to_owned();
    for row in 0..n {
        let (node, freedom) = place(row);
        rows += &format!("{},{},{}\n", row + 1, node + 1, ["x", "y", "z", "rx", "ry", "rz"][freedom]);
    }
    std::fs::write(folder.path().join("dofs.csv"), rows).unwrap();
    for (name, matrix) in [("K", true), ("M", false)] {
        let mut text = String::new();
        for j in 0..n {
            let (mut unit, mut column) = (vec![0.0; n], vec![0.0; n]);
            unit[j] = 1.0;
            if matrix {
                pencil.add_stiffness(&unit, &mut column)
            } else {
                pencil.add_mass(&unit, &mut column)
            }
            for (i, value) in column.iter().enumerate().skip(j).filter(|(_, value)| **value != 0.0) {
                let signs = sign(place(i).1) * sign(place(j).1);
                text += &format!("{} {} {:.17e}\n", i + 1, j + 1, signs * value);
            }
        }
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let supports: String = (1..20).map(|i| format!("{},{},z,-1\n", i, i + 1)).collect();
    std::fs::write(folder.path().join("S.csv"), format!("x,node,direction,weight\n{supports}")).unwrap();
    let files = ttb_import::Files {
        stiffness: "K".into(),
        mass: "M".into(),
        dofs: Some("dofs.csv".into()),
        supports: "S.csv".into(),
        ..ttb_import::Files::default()
    };
    let own = in_space(model);
    let structure = StructureSpec::Matrices { files, folder: folder.path().to_owned(), length: L };
    let imported = BridgeSpec { structure, ..own.clone() };
    let forces = [("support[1].force", 1e4), ("support[2].force_y", 2e4), ("support[3].moment_x", -3e4)];
    let [ours, theirs] = [&own, &imported].map(|spec| at_rest(spec, &forces, &MIDDLE));
    for (a, b) in ours.iter().zip(&theirs) {
        near("imported", *b, *a, 1e-8);
    }
}

/// A simply supported beam whose bearings are shaken by A sin ωt, undamped, from rest:
///
/// ```text
/// u(L/2) = u_g + Σ (4/nπ) sin(nπ/2) D_n,   D_n = −A (sin ωt − ω/ω_n sin ω_n t)/(ω_n² − ω²),   ω_n = (nπ/L)² √(EI/m)
/// ```
#[test]
fn shaken_bearings_move_the_deck_as_the_modes_of_a_beam_do() {
    let (amplitude, omega, end) = (0.7, 9.0, 0.4);
    let times: Vec<f64> = (0..=5000).map(|i| 1e-4 * f64::from(i)).collect();
    let shake = |t: &f64| amplitude * (omega * t).sin();
    let series = GroundSeries::new(times.clone(), times.iter().map(|t| [shake(t), -0.5 * shake(t)]).collect());
    let relative = |ei: f64, t: f64| -> f64 {
        let terms = (1..40).step_by(2).map(|n| {
            let n = f64::from(n);
            let own = (n * std::f64::consts::PI / L).powi(2) * (ei / MASS).sqrt();
            let d = -amplitude * ((omega * t).sin() - omega / own * (own * t).sin()) / (own * own - omega * omega);
            4.0 / (n * std::f64::consts::PI) * (n * std::f64::consts::FRAC_PI_2).sin() * d
        });
        terms.sum()
    };
    let middle = |direction| Point { name: "mid".into(), x: Some(0.5 * L), node: None, direction };
    let ground = Some(series.clone());
    let step = 2e-4;
    let space = BridgeSpec { ground, points: vec![middle(Direction::Y)], step, ..in_space(girder(30, 0.0)) };
    let reduced = BridgeSpec { reduction: Some(Reduction::default()), ..space.clone() };
    let plane = BridgeSpec {
        structure: beams(vec![span(L, EI, MASS, 30)], 10, step).structure,
        points: vec![middle(Direction::Z)],
        ..space.clone()
    };
    let moved = series.at(end).displacement;
    for (name, spec, expected) in [
        ("across", &space, moved[0] + relative(EI_Z, end)),
        ("across, reduced", &reduced, moved[0] + relative(EI_Z, end)),
        ("down, plane", &plane, moved[1] - 0.5 * relative(EI, end)),
    ] {
        let mut instance = common::stepping(spec);
        let steps = (end / step).round() as usize;
        (0..steps).for_each(|k| instance.step(k as f64 * step, step).unwrap());
        near(name, common::get(&mut instance, "point[mid].displacement"), expected, 3e-4);
        let at = if spec.points[0].direction == Direction::Y { "displacement_y" } else { "displacement" };
        let seen = common::get(&mut instance, &format!("support[2].{at}"));
        near(&format!("{name}: support"), seen, expected, 3e-4);
    }
    // Far slower than every mode: the deck goes along with the ground.
    let slow = GroundSeries::new(vec![0.0, 50.0, 100.0], vec![[0.0; 2], [1e-4, -2e-4], [0.0; 2]]);
    let mut instance = common::stepping(&BridgeSpec { ground: Some(slow.clone()), step: 0.02, ..space });
    (0..2000).for_each(|k| instance.step(0.02 * f64::from(k), 0.02).unwrap());
    let at = slow.at(40.0);
    near("goes along across", common::get(&mut instance, "support[1].displacement_y"), at.displacement[0], 1e-4);
    near("goes along down", common::get(&mut instance, "support[3].displacement"), at.displacement[1], 1e-4);
    near("at its speed", common::get(&mut instance, "support[1].velocity_y"), at.velocity[0], 1e-3);
}
