//! Frequencies and statics of small structures against closed forms.

mod common;

use std::f64::consts::{PI, TAU};

use common::{beams, bridge, drive, find, frame, get, point, span};
use ttb_bridge::Bridge;
use ttb_bridge::mesh::Mesh;
use ttb_contract::Instance;
use ttb_dynamics::frame::ernst_modulus;
use ttb_record::Table;
use ttb_scenario::spec::StructureSpec;
use ttb_scenario::types::Fixity::{self, Rotation, X, Z};
use ttb_scenario::types::MemberKind::{Beam, Cable, Truss};
use ttb_scenario::types::{Direction, Frame, Point};
use ttb_sparse::modes::lowest;

/// A table of closed forms.
fn table(title: &str) -> Table {
    Table::new(title, "closed form", "-p ttb-bridge --test closed_forms")
}

const CLAMPED: &[Fixity] = &[X, Z, Rotation];
/// Girder of `common::frame`: EI, EA, mass.
const EI: f64 = 1.5e10;
const EA: f64 = 6e10;
const M: f64 = 5000.0;

/// f of k⁴ = mω²/EI, Hz.
fn bending(k: f64) -> f64 {
    k * k * f64::sqrt(EI / M) / TAU
}

fn frequencies(mesh: &Mesh, count: usize) -> Vec<f64> {
    let pencil = mesh.assembly().finish().unwrap();
    lowest(&pencil, &pencil.factor(1.0, 0.0, 0.0).unwrap(), count).unwrap().frequencies().collect()
}

/// Displacement [u_x, u_z, θ] of a node under unit loads `load` at another.
fn deflection(frame: &Frame, loaded: &str, load: [f64; 3], seen: &str) -> [f64; 3] {
    let mesh = ttb_bridge::frame::mesh(frame).unwrap();
    let dofs = |name: &str| mesh.dofs[mesh.nodes.iter().position(|n| n.name == name).unwrap()];
    let mut u = vec![0.0; mesh.ndof];
    for (dof, load) in dofs(loaded).into_iter().zip(load) {
        dof.into_iter().for_each(|dof| u[dof as usize] = load);
    }
    let pencil = mesh.assembly().finish().unwrap();
    pencil.factor(1.0, 0.0, 0.0).unwrap().solve_in_place(&mut u, &mut vec![0.0; mesh.ndof]);
    dofs(seen).map(|dof| dof.map_or(0.0, |dof| u[dof as usize]))
}

#[test]
fn simply_supported_spans_vibrate_each_for_itself() {
    let mut table = table("spans of 20 m side by side, Hz");
    let equal = Bridge::new(beams(vec![span(20.0, EI, M, 20); 6], 10, 1e-3)).unwrap();
    for (i, f) in equal.natural_frequencies(9).unwrap().into_iter().enumerate() {
        table.row(format!("mode {}", i + 1), bending(PI * if i < 6 { 1.0 } else { 2.0 } / 20.0), f, 1e-4);
    }
    assert_eq!(equal.mass(), 6.0 * 20.0 * M);
    assert_eq!(equal.ndof(), 6 * 40);
    table.finish();
}

#[test]
fn known_bridges_have_their_known_frequencies() {
    let source = "R1: (π/L)² √(EI/m)/2π; cable-stayed: an independent program, Hz; its mass, kg";
    let mut table = Table::new("bridges of the examples", source, "-p ttb-bridge --test closed_forms");
    // Case R1 (docs/theory.md 15), and the bundled cable-stayed bridge: its file says what another program found.
    let r1 = Bridge::new(beams(vec![span(32.5, 3.45e10 * 12.744, 29_720.0, 50)], 50, 1e-3)).unwrap();
    table.row("R1", 5.7199, r1.natural_frequencies(1).unwrap()[0], 1e-5);
    let frame = ttb_scenario::bundled::frame("cable-stayed-224").unwrap();
    let cable_stayed = Bridge::new(bridge(StructureSpec::Frame(frame), 224.0, 100, 1e-3)).unwrap();
    for (f, expected) in cable_stayed.natural_frequencies(4).unwrap().into_iter().zip([0.80, 1.32, 1.90, 2.38]) {
        table.row("cable-stayed", expected, f, 0.005);
    }
    table.row("mass", 11.8e6 + 1.97e6, cable_stayed.mass(), 0.002);
    table.finish();
}

#[test]
fn a_continuous_beam_shares_its_rotation() {
    let mut table = table("continuous beam of two spans, Hz");
    let spans = vec![span(20.0, EI, M, 20); 2];
    let two = ttb_bridge::beams::mesh(&spans, true).unwrap();
    let expected = [PI, 3.926_602_3, 2.0 * PI, 7.068_582_7].map(|kl| bending(kl / 20.0));
    for (f, expected) in frequencies(&two, 4).into_iter().zip(expected) {
        table.row("two spans", expected, f, 1e-4);
    }
    table.finish();
}

#[test]
fn a_timoshenko_span_is_softer_in_shear() {
    let mut table = table("span that is soft in shear, Hz");
    let (length, ga) = (12.0, 1e9);
    let modes = |elements| {
        let mut spans = vec![span(length, EI, M, elements)];
        spans[0].shear_stiffness = Some(ga);
        frequencies(&ttb_bridge::beams::mesh(&spans, false).unwrap(), 3)
    };
    for (n, (coarse, fine)) in (1_i32..).zip(modes(24).into_iter().zip(modes(48))) {
        // Without rotary inertia: ω² = (EI k⁴/m)/(1 + EI k²/κGA). The mesh error falls with the square.
        let k = PI * f64::from(n) / length;
        let exact = bending(k) / (1.0 + EI * k * k / ga).sqrt();
        table.row("24 elements", exact, coarse, 4e-4 * f64::from(n.pow(3)));
        table.row("extrapolated", exact, (4.0 * fine - coarse) / 3.0, 3e-6 * f64::from(n.pow(4)));
    }
    table.finish();
}

#[test]
fn a_timoshenko_frame_member_also_turns() {
    let mut table = table("Timoshenko frame member, Hz");
    let (length, ga, n) = (12.0, 2e10, 24);
    let held = frame(&[("a", 0.0, 0.0, &[X, Z]), ("b", length, 0.0, &[Z])], &[("a", "b", "shear", Beam, n, true)]);
    let rotary = M * 0.5 / 2.0;
    // mρI/κGA ω⁴ − [m + (m EI/κGA + ρI) k²] ω² + EI k⁴ = 0.
    let k = PI / length;
    let (a, b, c) = (M * rotary / ga, M + (M * EI / ga + rotary) * k * k, EI * k.powi(4));
    let omega = ((b - (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)).sqrt();
    table.row("pinned", omega / TAU, frequencies(&ttb_bridge::frame::mesh(&held).unwrap(), 1)[0], 1e-4);
    table.finish();
}

#[test]
fn a_cantilever_in_any_direction() {
    let mut table = table("frame member as cantilever in any direction");
    let length = 10.0;
    for angle in [0.0_f64, 0.4, 1.5, 2.8, 4.0] {
        let (s, c) = angle.sin_cos();
        let cantilever = frame(
            &[("root", 0.0, 0.0, CLAMPED), ("tip", c * length, s * length, &[])],
            &[("root", "tip", "girder", Beam, 16, true)],
        );
        let f = frequencies(&ttb_bridge::frame::mesh(&cantilever).unwrap(), 3);
        table.row("first", bending(1.875_104_07 / length), f[0], 1e-5);
        table.row("second", bending(4.694_091_1 / length), f[1], 1e-4);
        let (bend, stretch) = (length.powi(3) / (3.0 * EI), length / EA);
        let [x, z, theta] = deflection(&cantilever, "tip", [0.0, 1.0, 0.0], "tip");
        table.row("u_z", s * s * stretch + c * c * bend, z, 1e-9);
        table.row("u_x + 1", 1.0 + (c * s * stretch - s * c * bend) * 1e6, 1.0 + x * 1e6, 1e-9);
        table.row("θ", c * length * length / (2.0 * EI), theta, 1e-9);
    }
    table.finish();
}

#[test]
fn a_bar_swings_along_its_axis() {
    let mut table = table("bar along its axis, Hz");
    let bar =
        frame(&[("a", 0.0, 0.0, CLAMPED), ("b", 30.0, 0.0, &[Z, Rotation])], &[("a", "b", "girder", Beam, 40, true)]);
    let mut bar = bar;
    bar.sections[0].inertia = 1e4; // bending far above
    let c = f64::sqrt(EA / M);
    table.row("quarter wave", c / (4.0 * 30.0), frequencies(&ttb_bridge::frame::mesh(&bar).unwrap(), 1)[0], 1e-4);
    table.finish();
}

#[test]
fn a_hinge_carries_no_moment() {
    let mut table = table("beam with a hinge under unit force");
    // Clamped at a, hinge at b, roller at c: the load on the hinge goes into the cantilever alone.
    let mut gerber = frame(
        &[("a", 0.0, 0.0, CLAMPED), ("b", 6.0, 0.0, &[]), ("c", 14.0, 0.0, &[Z])],
        &[("a", "b", "girder", Beam, 3, true), ("b", "c", "girder", Beam, 4, true)],
    );
    gerber.members[1].hinged = [true, false];
    let cantilever = 6.0_f64.powi(3) / (3.0 * EI);
    table.row("hinge", cantilever, deflection(&gerber, "b", [0.0, 1.0, 0.0], "b")[1], 1e-9);
    // A quarter of the span away from the hinge the deck follows the chord.
    let mut spec = bridge(StructureSpec::Frame(gerber), 14.0, 7, 1e-3);
    spec.points = vec![point("hinge", 6.0), point("root", 0.0)];
    let mut instance = Instance::new(Bridge::new(spec).unwrap());
    instance.enter_initialization(0.0).unwrap();
    let mut forces = [0.0; 8];
    forces[3] = 1.0; // x = 6 m
    drive(&mut instance, &forces, None);
    table.row("support over the hinge", cantilever, get(&mut instance, "support[4].displacement"), 1e-9);
    table.row("between hinge and roller", 0.5 * cantilever, get(&mut instance, "support[6].displacement"), 1e-9);
    table.row("moment at the root", -6.0, get(&mut instance, "point[root].moment"), 1e-6);
    assert!(get(&mut instance, "point[hinge].moment").abs() < 1e-8);
    table.finish();
}

#[test]
fn two_bars_carry_a_load() {
    let mut table = table("two bars under unit force, m");
    // Symmetric bars to a lower node: u_z = F L/(2 EA cos²).
    let mut truss = frame(
        &[("a", -3.0, 0.0, &[X, Z]), ("b", 3.0, 0.0, &[X, Z]), ("c", 0.0, 4.0, &[])],
        &[("a", "c", "girder", Truss, 1, false), ("b", "c", "girder", Truss, 1, false)],
    );
    table.row("apex", 5.0 / (2.0 * EA * 0.8 * 0.8), deflection(&truss, "c", [0.0, 1.0, 0.0], "c")[1], 1e-12);
    table.row("sideways", 5.0 / (2.0 * EA * 0.6 * 0.6), deflection(&truss, "c", [1.0, 0.0, 0.0], "c")[0], 1e-12);
    // As cables: Ernst's modulus with a horizontal length of 3 m, which weighs only on slack cables.
    for member in &mut truss.members {
        (member.kind, member.tension) = (Cable, Some(1e5));
    }
    let softened = ernst_modulus(3e10, 2.0, M, 1e5, 3.0) * 2.0;
    assert!(softened < 0.9 * EA);
    table.row("cables", 5.0 / (2.0 * softened * 0.8 * 0.8), deflection(&truss, "c", [0.0, 1.0, 0.0], "c")[1], 1e-12);
    table.finish();
}

#[test]
fn a_force_anywhere_on_a_span_gives_its_static_line() {
    let mut table = table("static line of a force on a span");
    // The shapes are exact: P b x (L² − b² − x²)/(6 L EI) at every node, also for a force inside an element.
    let (length, load) = (10.0, 7e4);
    let mut spec = beams(vec![span(length, EI, M, 4)], 1, 1e-3);
    spec.supports = vec![2.5, 5.0, 6.1];
    spec.points = vec![point("mid", 5.0), point("third", 6.1)];
    let mut instance = Instance::new(Bridge::new(spec).unwrap());
    instance.enter_initialization(0.0).unwrap();
    drive(&mut instance, &[0.0, 0.0, load], None);
    let b = length - 6.1;
    for (name, x) in [("support[1].displacement", 2.5), ("support[2].displacement", 5.0)] {
        let exact = load * b * x * (length * length - b * b - x * x) / (6.0 * length * EI);
        table.row(name, exact, get(&mut instance, name), 1e-9);
    }
    drive(&mut instance, &[0.0, load, 0.0], None);
    table.row("PL³/48EI", load * length.powi(3) / (48.0 * EI), get(&mut instance, "point[mid].displacement"), 1e-9);
    table.row("PL/4", 0.25 * load * length, get(&mut instance, "point[mid].moment"), 1e-9);
    table.row("P(L−x)/2", 0.5 * load * (length - 6.1), get(&mut instance, "point[third].moment"), 1e-9);
    assert_eq!(get(&mut instance, "point[mid].velocity"), 0.0);
    assert_eq!(get(&mut instance, "point[mid].acceleration"), 0.0);
    table.finish();
}

#[test]
fn a_frame_is_seen_at_its_nodes_and_carries_track_backwards_too() {
    // A portal whose deck runs from right to left; the same numbers as from left to right.
    let nodes: [(&str, f64, f64, &[Fixity]); 4] =
        [("fl", 0.0, 8.0, CLAMPED), ("fr", 20.0, 8.0, CLAMPED), ("l", 0.0, 0.0, &[]), ("r", 20.0, 0.0, &[])];
    let there = [
        ("fl", "l", "girder", Beam, 4, false),
        ("l", "r", "shear", Beam, 10, true),
        ("fr", "r", "girder", Beam, 4, false),
    ];
    let back = [there[0], ("r", "l", "shear", Beam, 10, true), there[2]];
    let at =
        |name: &str, node: &str, direction| Point { name: name.into(), x: None, node: Some(node.into()), direction };
    let answers = [there, back].map(|members| {
        let mut spec = bridge(StructureSpec::Frame(frame(&nodes, &members)), 20.0, 7, 1e-3);
        spec.points = vec![at("sway", "r", Direction::X), at("foot", "fl", Direction::Z), point("deck", 7.7)];
        let mut instance = Instance::new(Bridge::new(spec).unwrap());
        instance.enter_initialization(0.0).unwrap();
        drive(&mut instance, &[0.0, 1e5, 0.0, 0.0, 3e4, 0.0, 0.0, 0.0], None);
        assert!(instance.model().natural_frequencies(1).unwrap()[0] > 0.1);
        assert_eq!(get(&mut instance, "point[foot].displacement"), 0.0);
        let _ = find(&instance, "point[deck].moment");
        common::outputs(&mut instance)
    });
    for (a, b) in answers[0].iter().zip(&answers[1]) {
        assert!((a - b).abs() <= 1e-9 * a.abs().max(1e-9), "{a} {b}");
    }
}
