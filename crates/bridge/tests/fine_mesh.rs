//! Meshes too fine for double precision: what is said of their rounding, against closed forms.

mod common;

use common::{Train, beams, drive, frame, get, point, span};
use serde_json::json;
use ttb_bridge::{Bridge, Prepared, plane, rounding};
use ttb_contract::Instance;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::{Damping, Fixity, MemberKind, Model, RayleighAt};
use ttb_sparse::{Condition, Layout};

const LENGTH: f64 = 32.5;
const STIFFNESS: f64 = 4.39668e11;
const MASS: f64 = 29720.0;

fn beam(elements: usize) -> BridgeSpec {
    beams(vec![span(LENGTH, STIFFNESS, MASS, elements)], 4, 1e-3)
}

/// What is known of a plane bridge before anything is refused.
fn condition(spec: &BridgeSpec) -> Condition {
    let assembled = plane::assemble(spec).unwrap();
    let pencil = assembled.equations.finish_with(&Layout::default()).unwrap();
    let factor = pencil.factor(1.0, 0.0, 0.0).unwrap();
    rounding::condition(&pencil, &factor, &assembled.supports).unwrap()
}

/// Deflection of the middle under 1 N there.
fn deflection(spec: &BridgeSpec) -> f64 {
    let mut bridge = Instance::new(Bridge::new(spec.clone()).unwrap());
    bridge.enter_initialization(0.0).unwrap();
    drive(&mut bridge, &[0.0, 0.0, 1.0, 0.0, 0.0], None);
    get(&mut bridge, "support[3].displacement")
}

fn closed_form(length: f64, stiffness: f64) -> f64 {
    length.powi(3) / (48.0 * stiffness)
}

#[test]
fn a_beam_is_right_to_what_is_said_of_its_rounding() {
    let frequency = std::f64::consts::FRAC_PI_2 / LENGTH.powi(2) * (STIFFNESS / MASS).sqrt();
    for n in [50, 1000, 3000] {
        let spec = beam(n);
        let (condition, bridge) = (condition(&spec), Bridge::new(spec.clone()).unwrap());
        let expected = 0.5 * (n as f64).powi(4);
        assert!((condition.number / expected - 1.0).abs() < 0.1, "{condition:?}");
        // A cubic shape knows the frequency of 50 elements to 1e-8.
        let stated = condition.error().max(1e-7);
        let errors = [
            deflection(&spec) / closed_form(LENGTH, STIFFNESS) - 1.0,
            bridge.natural_frequencies(1).unwrap()[0] / frequency - 1.0,
        ];
        println!("{n} elements: stated {stated:.1e}, found {:.1e} and {:.1e}", errors[0], errors[1]);
        assert!(errors.iter().all(|error| error.abs() < stated), "{n} elements: {errors:?}, stated {stated}");
        // From 1,000 elements on it is told, with figures.
        match bridge.remarks() {
            [] => assert_eq!(n, 50),
            [remark] => {
                assert!(n > 50 && remark.contains("condition") && remark.contains("longer elements"), "{remark}")
            }
            more => panic!("{more:?}"),
        }
    }
}

#[test]
fn a_beam_of_too_many_elements_is_refused_with_figures() {
    for n in [10_000, 40_000] {
        let error = Prepared::new(&beam(n)).err().unwrap_or_else(|| panic!("{n} elements")).0;
        println!("{error}");
        assert!(error.contains("the condition") && error.contains("longer elements"), "{error}");
    }
}

#[test]
fn a_run_is_right_to_what_is_said_of_its_rounding() {
    let train = Train { axles: vec![(0.0, 1e5)], speed: 60.0 };
    let peak = |elements: usize| {
        let damping = Damping::Rayleigh { ratio: 0.05, at: RayleighAt::FirstTimes(4.0) };
        let (spec, mut peak) = (BridgeSpec { damping, ..beam(elements) }, 0.0_f64);
        train.run(&spec, 0.5, |_, bridge| peak = peak.max(get(bridge, "point[mid].displacement")));
        peak
    };
    let coarse = peak(50);
    for n in [1000, 3000] {
        let (error, stated) = (peak(n) / coarse - 1.0, condition(&beam(n)).error());
        println!("{n} elements: stated {stated:.1e}, found {error:.1e}");
        assert!(error.abs() < 2.0 * stated, "{n} elements: {error}, stated {stated}");
    }
}

/// A span of two girders with a piece of `short` metres between them.
fn interrupted(short: f64) -> BridgeSpec {
    let (left, right) = (10.0 - 0.5 * short, 10.0 + 0.5 * short);
    let nodes: [(&str, f64, f64, &[Fixity]); 4] = [
        ("a", 0.0, 0.0, &[Fixity::X, Fixity::Z]),
        ("b", left, 0.0, &[]),
        ("c", right, 0.0, &[]),
        ("d", 20.0, 0.0, &[Fixity::Z]),
    ];
    let member = |from, to, elements| (from, to, "girder", MemberKind::Beam, elements, true);
    let frame = frame(&nodes, &[member("a", "b", 4), member("b", "c", 2), member("c", "d", 4)]);
    BridgeSpec { points: vec![point("mid", 10.0)], ..common::bridge(StructureSpec::Frame(frame), 20.0, 4, 1e-3) }
}

#[test]
fn a_short_stiff_member_of_a_frame_is_told_or_refused() {
    let exact = closed_form(20.0, 3e10 * 0.5);
    for short in [1.0, 1e-2, 1e-3, 1e-4] {
        match Bridge::new(interrupted(short)) {
            Ok(bridge) => {
                let error = deflection(&interrupted(short)) / exact - 1.0;
                let told = !bridge.remarks().is_empty();
                println!("{short} m: found {error:.1e}, {:?}", bridge.remarks());
                assert!(error.abs() < if told { 1e-2 } else { 1e-5 }, "{short} m: {error}, told: {told}");
            }
            Err(refused) => {
                println!("{short} m: {refused}");
                let figures = refused.0.contains("condition") || refused.0.contains("far too fine");
                assert!(short < 1e-2 && figures, "{short} m: {refused}");
            }
        }
    }
}

/// A girder of finite elements in space along x.
fn in_space(elements: usize) -> BridgeSpec {
    let nodes: Vec<_> = (0..=elements).map(|i| json!([i, 20.0 * i as f64 / elements as f64, 0, 0])).collect();
    let chain: Vec<_> = (0..elements).map(|i| [i, i + 1]).collect();
    let model: Model = serde_json::from_value(json!({
        "materials": [{ "name": "concrete", "modulus": 3e10, "poisson": 0.2, "density": 2500 }],
        "line_sections": [{
            "name": "girder", "material": "concrete", "area": 1.2, "inertia_2": 0.25, "inertia_3": 0.4, "torsion": 0.1
        }],
        "nodes": nodes,
        "beams": [{ "section": "girder", "orientation": [0, 1, 0], "elements": chain }],
        "bearings": [{ "nodes": [0, elements], "fixed": ["y", "z", "rx"] }, { "nodes": [0], "fixed": ["x"] }],
        "deck": { "length": 20.0, "on": { "beams": ["girder"] } }
    }))
    .unwrap();
    common::bridge(StructureSpec::FiniteElements(Box::new(model)), 20.0, 4, 1e-3)
}

#[test]
fn finite_elements_too_are_told_or_refused() {
    let exact = closed_form(20.0, 3e10 * 0.25);
    let coarse = Bridge::new(in_space(40)).unwrap();
    assert!(coarse.remarks().is_empty(), "{:?}", coarse.remarks());
    assert!((deflection(&in_space(40)) / exact - 1.0).abs() < 1e-9);
    let fine = Bridge::new(in_space(2000)).unwrap();
    assert_eq!(fine.remarks().len(), 1);
    let error = deflection(&in_space(2000)) / exact - 1.0;
    println!("2000 elements: found {error:.1e}, {:?}", fine.remarks());
    assert!(error.abs() < 1e-2);
    let refused = Bridge::new(in_space(12_000)).err().unwrap().0;
    assert!(refused.contains("condition") || refused.contains("far too fine"), "{refused}");
}

#[test]
fn ordinary_bridges_are_told_nothing() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    for name in ["r1", "default", "box-girder", "two-span-shinkansen", "simple-span-velaro", "strutted-frame"] {
        let checked = ttb_scenario::load(&folder.join(format!("{name}.json"))).unwrap();
        let bridge = Bridge::new(checked.bridge).unwrap();
        assert!(bridge.remarks().is_empty(), "{name}: {:?}", bridge.remarks());
    }
    let wide = Bridge::new(common::girder_spec(common::girder(false))).unwrap();
    assert!(wide.remarks().is_empty(), "{:?}", wide.remarks());
}
