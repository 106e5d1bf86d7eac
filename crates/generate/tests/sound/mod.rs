//! What every generated model must be, checked from outside.

#![allow(dead_code)] // each test program uses its part

use std::collections::{HashMap, HashSet};

use ttb_generate::measure::coordinates;
use ttb_scenario::types::{DeckCarrier, Model};

type Point = [f64; 3];

/// Every group of nodes that moves together by elements, springs or rigid links.
pub fn ties(model: &Model) -> impl Iterator<Item = Vec<u32>> + '_ {
    let beams = model.beams.iter().flat_map(|group| group.elements.iter().map(|pair| pair.to_vec()));
    let trusses = model.trusses.iter().flat_map(|group| group.elements.iter().map(|pair| pair.to_vec()));
    let shells = model.shells.iter().flat_map(|group| group.elements.iter().cloned());
    let springs = model.springs.iter().flat_map(|group| group.elements.iter().cloned());
    let links = model.rigid_links.iter().map(|link| [&[link.leader], link.followers.as_slice()].concat());
    beams.chain(trusses).chain(shells).chain(springs).chain(links)
}

/// Numbers are unique, all that is named exists, no element names a node twice.
pub fn references(model: &Model) {
    let nodes: HashSet<u32> = model.nodes.iter().map(|node| node.0).collect();
    assert_eq!(nodes.len(), model.nodes.len(), "node numbers are unique");
    let materials: HashSet<&str> = model.materials.iter().map(|m| m.name.as_str()).collect();
    let lines: HashSet<&str> = model.line_sections.iter().map(|s| s.name.as_str()).collect();
    let plates: HashSet<&str> = model.shell_sections.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(lines.len() + plates.len(), model.line_sections.len() + model.shell_sections.len());
    assert!(model.line_sections.iter().all(|s| materials.contains(s.material.as_str())));
    assert!(model.shell_sections.iter().all(|s| materials.contains(s.material.as_str())));
    assert!(model.beams.iter().all(|group| lines.contains(group.section.as_str())));
    assert!(model.trusses.iter().all(|group| lines.contains(group.section.as_str())));
    assert!(model.shells.iter().all(|group| plates.contains(group.section.as_str())));
    let tensions = |t: &ttb_scenario::types::Trusses| t.tensions.as_ref().is_none_or(|v| v.len() == t.elements.len());
    assert!(model.trusses.iter().all(tensions));
    for tie in ties(model) {
        assert!(tie.iter().all(|node| nodes.contains(node)), "{tie:?}");
        assert_eq!(tie.iter().collect::<HashSet<_>>().len(), tie.len(), "{tie:?}");
    }
    assert!(model.bearings.iter().all(|bearing| bearing.nodes.iter().all(|node| nodes.contains(node))));
    let DeckCarrier::Shells(names) = &model.deck.on else { panic!("the deck is of shells") };
    assert!(names.iter().all(|name| plates.contains(name.as_str())));
}

/// Every node belongs to something that hangs together with a bearing.
pub fn connected(model: &Model) {
    let place: HashMap<u32, usize> = model.nodes.iter().enumerate().map(|(i, node)| (node.0, i)).collect();
    let mut parent: Vec<usize> = (0..model.nodes.len()).collect();
    fn root(parent: &mut [usize], mut i: usize) -> usize {
        while parent[i] != i {
            parent[i] = parent[parent[i]];
            i = parent[i];
        }
        i
    }
    for tie in ties(model) {
        for pair in tie.windows(2) {
            let (a, b) = (root(&mut parent, place[&pair[0]]), root(&mut parent, place[&pair[1]]));
            parent[a] = b;
        }
    }
    let held: HashSet<usize> =
        model.bearings.iter().flat_map(|b| &b.nodes).map(|node| root(&mut parent, place[node])).collect();
    let loose = model.nodes.iter().find(|node| !held.contains(&root(&mut parent, place[&node.0])));
    assert_eq!(loose, None, "every node hangs on a bearing");
}

/// Micrometres.
fn key(point: Point) -> [i64; 3] {
    point.map(|v| (v * 1e6).round() as i64)
}

/// No two nodes at one place, but for the joints at `joints` (abscissae).
pub fn no_twins(model: &Model, joints: &[f64]) {
    let mut seen = HashSet::new();
    for &(number, x, y, z) in &model.nodes {
        let twin = !seen.insert(key([x, y, z]));
        assert!(!twin || joints.iter().any(|joint| (x - joint).abs() < 1e-6), "node {number} at {:?}", (x, y, z));
    }
}

/// Mirrored at y = 0, the model is the same: nodes, elements by section, springs, bearings.
pub fn symmetric(model: &Model) {
    let at = coordinates(model);
    let outline = |nodes: &[u32], sign: f64| {
        let mut corners: Vec<_> = nodes.iter().map(|n| key([at[n][0], sign * at[n][1], at[n][2]])).collect();
        corners.sort_unstable();
        corners
    };
    let all = |sign: f64| {
        let mut all: Vec<(String, Vec<[i64; 3]>)> = Vec::new();
        let mut add = |name: &str, nodes: &[u32]| all.push((name.to_string(), outline(nodes, sign)));
        model.nodes.iter().for_each(|node| add("node", &[node.0]));
        model.shells.iter().for_each(|g| g.elements.iter().for_each(|e| add(&g.section, e)));
        model.beams.iter().for_each(|g| g.elements.iter().for_each(|e| add(&g.section, e)));
        model.trusses.iter().for_each(|g| g.elements.iter().for_each(|e| add(&g.section, e)));
        model.springs.iter().for_each(|g| g.elements.iter().for_each(|e| add(&format!("{:?}", g.stiffness), e)));
        model.bearings.iter().for_each(|b| b.nodes.iter().for_each(|n| add(&format!("{:?}", b.fixed), &[*n])));
        for link in &model.rigid_links {
            link.followers.iter().for_each(|n| add("link", &[link.leader, *n]));
        }
        all.sort();
        all
    };
    assert!(all(1.0) == all(-1.0), "the model is its own mirror image");
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn norm(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// The worst ratio of mean lengths of opposite sides of any shell. All are plane, convex and nearly rectangular, and the
/// normals within a section agree.
pub fn worst_aspect(model: &Model) -> f64 {
    let at = coordinates(model);
    let mut worst: f64 = 1.0;
    for group in &model.shells {
        let mut reference: Option<Point> = None;
        for element in &group.elements {
            let p: Vec<Point> = element.iter().map(|node| at[node]).collect();
            let sides: Vec<Point> = (0..4).map(|k| minus(p[(k + 1) % 4], p[k])).collect();
            let diagonal = cross(minus(p[2], p[0]), minus(p[3], p[1]));
            let normal = diagonal.map(|v| v / norm(diagonal));
            let size = norm(minus(p[2], p[0]));
            assert!(dot(minus(p[1], p[0]), normal).abs() < 1e-5 * size, "{element:?} is plane");
            for k in 0..4 {
                let corner = cross(sides[k], sides[(k + 1) % 4]);
                let sine = dot(corner, normal) / norm(sides[k]) / norm(sides[(k + 1) % 4]);
                assert!(sine > 0.97, "{element:?} has nearly right angles: {sine}");
            }
            let first = *reference.get_or_insert(normal);
            assert!(dot(first, normal) > 0.9, "normals of {} agree", group.section);
            let [a, b] = [norm(sides[0]) + norm(sides[2]), norm(sides[1]) + norm(sides[3])];
            worst = worst.max(a / b).max(b / a);
        }
    }
    worst
}
