//! Bridges to test, and forces that move over them.
#![allow(dead_code, reason = "every test file takes what it needs")]

use ttb_bridge::Bridge;
use ttb_contract::{Instance, Model};
use ttb_generate::simple_span;
use ttb_scenario::spec::{BridgeSpec, Span, StructureSpec};
use ttb_scenario::types::{
    Damping, Fixity, Frame, Member, MemberKind, Model as Elements, Newmark, Node, Point, RayleighAt, Section, Springs,
};

/// A span of a simple beam.
pub fn span(length: f64, bending_stiffness: f64, mass: f64, elements: usize) -> Span {
    Span { length, bending_stiffness, mass, shear_stiffness: None, elements }
}

/// A monitored point of the deck.
pub fn point(name: &str, x: f64) -> Point {
    Point { name: name.into(), x: Some(x), node: None, direction: Default::default() }
}

/// A structure with `bays` + 1 evenly spaced supports from its begin to `length`, undamped.
pub fn bridge(structure: StructureSpec, length: f64, bays: usize, step: f64) -> BridgeSpec {
    BridgeSpec {
        structure,
        damping: Damping::None,
        modes: None,
        reduction: None,
        supports: (0..=bays).map(|i| length * i as f64 / bays as f64).collect(),
        points: Vec::new(),
        step,
        end: 1.0,
        newmark: Newmark::default(),
        space: false,
        ground: None,
        ground_points: Vec::new(),
    }
}

/// Simply supported spans with evenly spaced supports; `mid` in the middle of the first span.
pub fn beams(spans: Vec<Span>, bays: usize, step: f64) -> BridgeSpec {
    let (length, mid) = (spans.iter().map(|s| s.length).sum(), 0.5 * spans[0].length);
    let spec = bridge(StructureSpec::Beams { spans, continuous: false }, length, bays, step);
    BridgeSpec { points: vec![point("mid", mid)], ..spec }
}

/// A frame from (name, x, z, fixed) and (from, to, section, kind, elements, deck).
pub fn frame(nodes: &[(&str, f64, f64, &[Fixity])], members: &[(&str, &str, &str, MemberKind, usize, bool)]) -> Frame {
    let node = |(name, x, z, fixed): &(&str, f64, f64, &[Fixity])| Node {
        name: (*name).into(),
        x: *x,
        z: *z,
        fixed: fixed.to_vec(),
    };
    let member = |(a, b, section, kind, elements, deck): &(&str, &str, &str, MemberKind, usize, bool)| Member {
        nodes: [(*a).into(), (*b).into()],
        section: (*section).into(),
        kind: *kind,
        elements: *elements,
        tension: None,
        deck: *deck,
        hinged: [false; 2],
    };
    let section = |name: &str, shear_stiffness| Section {
        name: name.into(),
        modulus: 3e10,
        area: 2.0,
        inertia: 0.5,
        shear_stiffness,
        mass: 5000.0,
    };
    Frame {
        sections: vec![section("girder", None), section("shear", Some(2e10))],
        nodes: nodes.iter().map(node).collect(),
        members: members.iter().map(member).collect(),
        source: String::new(),
    }
}

/// An instance through its initialization, ready to step.
pub fn stepping(spec: &BridgeSpec) -> Instance<Bridge> {
    ready(Bridge::new(spec.clone()).unwrap())
}

fn ready(bridge: Bridge) -> Instance<Bridge> {
    let mut instance = Instance::new(bridge);
    instance.enter_initialization(0.0).unwrap();
    instance.exit_initialization().unwrap();
    instance
}

/// Value reference of a variable.
pub fn find(instance: &Instance<Bridge>, name: &str) -> u32 {
    instance.model().interface().find(name).unwrap_or_else(|| panic!("no variable {name}")) as u32
}

/// Value of a variable.
pub fn get(instance: &mut Instance<Bridge>, name: &str) -> f64 {
    let (reference, mut value) = (find(instance, name), [0.0]);
    instance.get(&[reference], &mut value).unwrap();
    value[0]
}

/// Sets one variable.
pub fn set(instance: &mut Instance<Bridge>, name: &str, value: f64) {
    let reference = find(instance, name);
    instance.set(&[reference], &[value]).unwrap();
}

/// All outputs.
pub fn outputs(instance: &mut Instance<Bridge>) -> Vec<f64> {
    let references: Vec<u32> = instance.model().interface().outputs().map(|r| r as u32).collect();
    let mut values = vec![0.0; references.len()];
    instance.get(&references, &mut values).unwrap();
    values
}

/// Sets all forces and, if given, their rates.
pub fn drive(instance: &mut Instance<Bridge>, forces: &[f64], rates: Option<&[f64]>) {
    let references: Vec<u32> = (0..forces.len() as u32).collect();
    instance.set(&references, forces).unwrap();
    rates.into_iter().for_each(|rates| instance.set_rates(&references, rates).unwrap());
}

/// Asserts a relative error.
pub fn near(name: &str, value: f64, expected: f64, tolerance: f64) {
    let error = value / expected - 1.0;
    println!("{name}: {value:.7e} (expected {expected:.7e}, error {:.2e})", error);
    assert!(error.abs() < tolerance, "{name}: {value} instead of {expected}");
}

/// Greatest difference of two histories relative to the greatest value of the second.
pub fn difference(a: &[f64], b: &[f64]) -> f64 {
    let largest = b.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    a.iter().zip(b).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / largest
}

/// A folder with what a bridge's FMU keeps.
pub fn packed(spec: &BridgeSpec) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in Bridge::new(spec.clone()).unwrap().resources(spec).unwrap() {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    folder
}

/// Its instance, ready to step.
pub fn unpacked(folder: &std::path::Path) -> Instance<Bridge> {
    ready(Bridge::load(folder).unwrap())
}

/// A bridge file cut short is refused, with the reason.
pub fn assert_cut_is_refused(folder: &std::path::Path, length: impl FnOnce(usize) -> usize) {
    let file = folder.join("bridge.bin");
    let bytes = std::fs::read(&file).unwrap();
    std::fs::write(&file, &bytes[..length(bytes.len())]).unwrap();
    let error = Bridge::load(folder).err().expect("a damaged file").to_string();
    assert!(error.contains("bridge.bin") && error.contains("damaged"), "{error}");
    std::fs::write(&file, &bytes).unwrap();
}

/// Vertical forces (m behind the first, N) that move forward.
pub struct Train {
    pub axles: Vec<(f64, f64)>,
    pub speed: f64,
}

impl Train {
    /// Support forces at t; the first force enters the bridge at t = 0. Between supports a force is shared linearly.
    pub fn forces(&self, t: f64, supports: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        for (behind, force) in &self.axles {
            let x = self.speed * t - behind;
            let last = supports.len() - 1;
            if x <= supports[0] || x >= supports[last] {
                continue;
            }
            let i = supports.partition_point(|s| *s <= x) - 1;
            let share = (x - supports[i]) / (supports[i + 1] - supports[i]);
            out[i] += force * (1.0 - share);
            out[i + 1] += force * share;
        }
    }

    /// Drives an instance from t = 0 to `end`, forces interpolated over each step, and calls `watch` after each.
    pub fn run(&self, spec: &BridgeSpec, end: f64, mut watch: impl FnMut(f64, &mut Instance<Bridge>)) {
        let mut instance = stepping(spec);
        let (n, h) = (spec.supports.len(), spec.step);
        let (mut now, mut next, mut rates) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        for k in 0..(end / h).round() as usize {
            self.forces((k + 1) as f64 * h, &spec.supports, &mut next);
            rates.iter_mut().zip(now.iter().zip(&next)).for_each(|(r, (a, b))| *r = (b - a) / h);
            drive(&mut instance, &now, Some(&rates));
            instance.step(k as f64 * h, h).unwrap();
            watch((k + 1) as f64 * h, &mut instance);
            std::mem::swap(&mut now, &mut next);
        }
    }
}

/// Length of the girder of shells, m.
pub const GIRDER: f64 = 24.0;

/// A girder of shells, with dashpots under its ends if wanted.
pub fn girder(dashpots: bool) -> Elements {
    let mut model = simple_span(GIRDER, 10.8, 3.5, 4500).unwrap();
    if dashpots {
        let nodes: Vec<Vec<u32>> = model.nodes.iter().step_by(97).map(|node| vec![node.0]).collect();
        model.springs.push(Springs { elements: nodes, stiffness: [1e6; 6], damping: [2e5, 1e5, 3e5, 0.0, 0.0, 0.0] });
    }
    model
}

/// Supports on the girder.
pub fn girder_stations() -> Vec<f64> {
    (1..40).map(|i| 0.6 * f64::from(i)).collect()
}

/// The girder with Rayleigh damping, its middle monitored.
pub fn girder_spec(model: Elements) -> BridgeSpec {
    let spec = bridge(StructureSpec::FiniteElements(Box::new(model)), GIRDER, 1, 1e-3);
    let damping = Damping::Rayleigh { ratio: 0.02, at: RayleighAt::Hz([4.0, 40.0]) };
    BridgeSpec { supports: girder_stations(), points: vec![point("mid", 0.5 * GIRDER)], damping, ..spec }
}
