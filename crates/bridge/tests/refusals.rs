//! What cannot be is refused with a message that names it.

mod common;

use common::{beams, bridge, frame, point, set, span};
use ttb_bridge::Bridge;
use ttb_contract::{Instance, Model};
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::Fixity::{X, Z};
use ttb_scenario::types::MemberKind::{Beam, Cable, Truss};
use ttb_scenario::types::{Damping, Direction, Frame, Point, RayleighAt};

fn refused(spec: BridgeSpec, words: &[&str]) {
    let Err(error) = Bridge::new(spec) else { panic!("{words:?} were not refused") };
    for word in words {
        assert!(error.0.contains(word), "{error:?} does not say {word:?}");
    }
}

fn simple() -> BridgeSpec {
    beams(vec![span(20.0, 1.5e10, 5000.0, 8)], 4, 1e-3)
}

fn girder() -> Frame {
    frame(&[("a", 0.0, 0.0, &[X, Z]), ("b", 20.0, 0.0, &[Z])], &[("a", "b", "girder", Beam, 8, true)])
}

#[test]
fn spans() {
    let with = |change: fn(&mut ttb_scenario::spec::Span)| {
        let mut bad = span(20.0, 1.5e10, 5000.0, 8);
        change(&mut bad);
        beams(vec![span(10.0, 1.5e10, 5000.0, 8), bad], 4, 1e-3)
    };
    refused(with(|s| s.length = -3.0), &["length", "span 2", "-3", "positive"]);
    refused(with(|s| s.mass = f64::NAN), &["mass", "span 2", "NaN"]);
    refused(with(|s| s.shear_stiffness = Some(0.0)), &["shear_stiffness", "span 2"]);
    refused(with(|s| s.elements = 0), &["span 2", "elements"]);
    refused(with(|s| s.elements = 1 << 63), &["span 2", "9223372036854775808 elements"]);
    let none = StructureSpec::Beams { spans: Vec::new(), continuous: false };
    refused(bridge(none, 20.0, 4, 1e-3), &["no spans"]);
}

#[test]
fn supports_and_points() {
    let mut spec = simple();
    spec.supports.push(20.5);
    refused(spec, &["support[6]", "20.5", "off the deck", "20 m"]);
    refused(BridgeSpec { points: vec![point("far", -1.0)], ..simple() }, &["point far", "off the deck"]);
    let nothing = Point { name: "p".into(), x: None, node: None, direction: Default::default() };
    refused(BridgeSpec { points: vec![nothing.clone()], ..simple() }, &["point p", "x or node"]);
    let sideways = Point { direction: Direction::X, ..point("side", 5.0) };
    refused(BridgeSpec { points: vec![sideways], ..simple() }, &["point side", "only along z"]);
    let lost = Point { node: Some("tower".into()), ..nothing };
    refused(BridgeSpec { points: vec![lost], ..simple() }, &["point p", "no node named tower"]);
}

#[test]
fn frames() {
    let with = |change: &dyn Fn(&mut Frame)| {
        let mut bad = girder();
        change(&mut bad);
        bridge(StructureSpec::Frame(bad), 20.0, 4, 1e-3)
    };
    let tower = ttb_scenario::types::Node { name: "t".into(), x: 0.0, z: -9.0, fixed: Vec::new() };
    refused(with(&|f| f.members[0].nodes[1] = "c".into()), &["member a–c", "no node named c"]);
    refused(with(&|f| f.members[0].section = "steel".into()), &["member a–b", "no section named steel"]);
    refused(with(&|f| f.nodes[1].x = 0.0), &["member a–b", "length"]);
    refused(with(&|f| f.nodes[1].name = "a".into()), &["two nodes", "a"]);
    refused(with(&|f| f.sections[0].modulus = 0.0), &["modulus", "girder", "positive"]);
    refused(with(&|f| f.sections[0].mass = -1.0), &["mass", "girder"]);
    refused(with(&|f| f.sections[0].inertia = 0.0), &["member a–b", "no inertia"]);
    refused(with(&|f| f.members[0].elements = 0), &["member a–b", "element"]);
    refused(with(&|f| f.members[0].elements = 1 << 63), &["member a–b", "9223372036854775808 elements"]);
    refused(with(&|f| f.members[0].kind = Cable), &["member a–b", "tension"]);
    refused(with(&|f| f.members[0].deck = false), &["no member", "deck"]);
    refused(with(&|f| f.nodes.push(tower.clone())), &["node t", "no member"]);
    let post = |f: &mut Frame| {
        f.nodes.push(tower.clone());
        f.members.push(ttb_scenario::types::Member { nodes: ["a".into(), "t".into()], ..f.members[0].clone() });
    };
    refused(with(&post), &["deck between nodes", "too steep"]);
    let gap = |f: &mut Frame| {
        f.nodes.extend([(25.0, "c"), (30.0, "d")].map(|(x, name)| ttb_scenario::types::Node {
            name: name.into(),
            x,
            z: 0.0,
            fixed: vec![X, Z],
        }));
        f.members.push(ttb_scenario::types::Member { nodes: ["c".into(), "d".into()], ..f.members[0].clone() });
    };
    refused(with(&gap), &["deck has a gap", "20", "25"]);
}

#[test]
fn mechanisms_are_named_by_place() {
    // Nothing holds the girder along the track.
    let mut loose = girder();
    loose.nodes[0].fixed = vec![Z];
    refused(bridge(StructureSpec::Frame(loose), 20.0, 4, 1e-3), &["mechanism", "along x"]);
    // A post of one truss can fall over.
    let post = frame(
        &[("a", 0.0, 0.0, &[X, Z]), ("b", 20.0, 0.0, &[Z]), ("top", 20.0, -5.0, &[])],
        &[("a", "b", "girder", Beam, 8, true), ("b", "top", "girder", Truss, 1, false)],
    );
    refused(bridge(StructureSpec::Frame(post), 20.0, 4, 1e-3), &["mechanism", "displacement along x of node top"]);
}

#[test]
fn damping_and_modes() {
    refused(BridgeSpec { modes: Some(17), ..simple() }, &["17 modes", "16"]);
    let rayleigh = |at| BridgeSpec { damping: Damping::Rayleigh { ratio: 0.01, at }, ..simple() };
    refused(rayleigh(RayleighAt::Hz([0.0, 5.0])), &["Rayleigh", "positive"]);
    refused(rayleigh(RayleighAt::Modes([0, 2])), &["mode 0", "counted from 1"]);
}

#[test]
fn parameters_name_their_rule() {
    for (name, value, rule) in [
        ("damping_ratio", 1.5, "between 0 and 1"),
        ("stiffness_factor", 0.0, "positive"),
        ("mass_factor", -1.0, "positive"),
        ("step_size", 0.0, "positive"),
        ("gamma", 0.4, "between 0.5 and 1"),
        ("beta", 0.0, "positive"),
    ] {
        let spec = BridgeSpec { damping: Damping::Modal { ratio: 0.01, modes: 2 }, ..simple() };
        let mut instance = Instance::new(Bridge::new(spec).unwrap());
        set(&mut instance, name, value);
        let error = instance.enter_initialization(0.0).unwrap_err();
        assert!(error.0.contains(name) && error.0.contains(rule), "{error}");
        // And the instance recovers.
        set(&mut instance, name, 0.5);
        instance.enter_initialization(0.0).unwrap();
    }
    // An enumeration takes its items only, at once.
    let mut undamped = Instance::new(Bridge::new(simple()).unwrap());
    let meaning = common::find(&undamped, "input_meaning");
    assert!(undamped.set(&[meaning], &[3.0]).unwrap_err().0.contains("input_meaning"));
    set(&mut undamped, "damping_ratio", 0.02);
    assert!(undamped.enter_initialization(0.0).unwrap_err().0.contains("damping_ratio"));
}

#[test]
fn absurd_steps() {
    let mut bridge = common::stepping(&simple());
    let error = bridge.step(0.0, 1e9).unwrap_err();
    assert!(error.0.contains("sub-steps"), "{error}");
    let mut short = Instance::new(Bridge::new(simple()).unwrap());
    set(&mut short, "step_size", 1e-170);
    let error = short.enter_initialization(0.0).unwrap_err();
    assert!(error.0.contains("a step of"), "{error}");
    bridge.step(0.0, 1e-3).unwrap();
}

#[test]
fn resources() {
    let folder = std::env::temp_dir().join(format!("ttb-bridge-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let load = || Bridge::load(&folder).map(|bridge| bridge.interface().clone()).map_err(|e| e.0);
    assert!(load().unwrap_err().contains("bridge.json"));
    std::fs::write(folder.join("bridge.json"), "{ \"structure\": 3 }").unwrap();
    let error = load().unwrap_err();
    assert!(error.contains("bridge.json") && error.contains("damaged"), "{error}");
    let spec = serde_json::to_string(&simple()).unwrap();
    std::fs::write(folder.join("bridge.json"), spec).unwrap();
    assert_eq!(&load().unwrap(), Bridge::new(simple()).unwrap().interface());
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn the_interface_list_is_the_contract() {
    let bridge = Bridge::new(simple()).unwrap();
    let names: Vec<_> = bridge.interface().variables().iter().map(|v| v.name.as_str()).collect();
    let mut expected: Vec<String> = (1..=5).map(|i| format!("support[{i}].force")).collect();
    expected.extend((1..=5).map(|i| format!("support[{i}].displacement")));
    expected.extend((1..=5).map(|i| format!("support[{i}].velocity")));
    expected.extend(["displacement", "velocity", "acceleration", "moment"].map(|what| format!("point[mid].{what}")));
    expected.extend(
        ["damping_ratio", "stiffness_factor", "mass_factor", "step_size", "gamma", "beta", "input_meaning"]
            .map(String::from),
    );
    assert_eq!(names, expected);
    assert!(bridge.interface().variables().iter().all(|v| !v.feed_through && !v.name.contains(',')));
}
