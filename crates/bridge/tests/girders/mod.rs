//! Girders and slabs in space, and how they answer loads.
#![allow(dead_code, reason = "every test file takes what it needs")]

use serde_json::{Value, json};
use ttb_bridge::assembled::Assembled;
use ttb_bridge::space::assemble;
use ttb_scenario::types::{Direction, Model, Point};
use ttb_sparse::modes::lowest;
use ttb_sparse::{Factor, Pencil};

pub const L: f64 = 20.0;
/// Of the beams below: E I₂, G J, ρ A.
pub const EI: f64 = 3e10 * 0.25;
pub const GJ: f64 = 3e10 / 2.4 * 0.1;
pub const MASS: f64 = 2500.0 * 1.2;

/// A model of one concrete, a line section `girder`, a shell section `slab`, and what is given.
pub fn model(parts: &[Value]) -> Model {
    let mut whole = json!({
        "materials": [{ "name": "concrete", "modulus": 3e10, "poisson": 0.2, "density": 2500 }],
        "line_sections": [{
            "name": "girder", "material": "concrete", "area": 1.2, "inertia_2": 0.25, "inertia_3": 0.4, "torsion": 0.1
        }],
        "shell_sections": [{ "name": "slab", "material": "concrete", "thickness": 0.4 }],
        "deck": { "length": L, "on": { "beams": ["girder"] } }
    });
    for (key, value) in parts.iter().filter_map(Value::as_object).flatten() {
        whole[key] = value.clone();
    }
    serde_json::from_value(whole).unwrap()
}

/// Nodes 0 to n along x.
pub fn line(n: usize) -> Vec<Value> {
    (0..=n).map(|i| json!([i, L * i as f64 / n as f64, 0, 0])).collect()
}

pub fn chain(n: usize) -> Vec<[usize; 2]> {
    (0..n).map(|i| [i, i + 1]).collect()
}

/// A simply supported beam that is held against twisting at its ends, with the track at `y`.
pub fn girder(n: usize, y: f64) -> Model {
    model(&[json!({
        "nodes": line(n),
        "beams": [{ "section": "girder", "orientation": [0, 1, 0], "elements": chain(n) }],
        "bearings": [{ "nodes": [0, n], "fixed": ["y", "z", "rx"] }, { "nodes": [0], "fixed": ["x"] }],
        "deck": { "length": L, "y": y, "on": { "beams": ["girder"] } }
    })])
}

pub struct Solved {
    pub assembled: Assembled,
    pub pencil: Pencil,
    pub factor: Factor,
}

pub fn solved(model: &Model, supports: &[f64], points: &[Point]) -> Solved {
    let mut assembled = assemble(model, supports, points).unwrap_or_else(|error| panic!("{error}"));
    let pencil = std::mem::take(&mut assembled.equations).finish().unwrap();
    let factor = pencil.factor(1.0, 0.0, 0.0).unwrap_or_else(|error| panic!("{error}"));
    Solved { assembled, pencil, factor }
}

impl Solved {
    pub fn solve(&self, load: &mut [f64]) {
        self.factor.solve_in_place(load, &mut vec![0.0; load.len()]);
    }

    /// Displacement under support i for a unit force on support j.
    pub fn flexibility(&self, i: usize, j: usize) -> f64 {
        let mut u = vec![0.0; self.pencil.ndof()];
        self.assembled.supports[j].iter().for_each(|(dof, weight)| u[*dof as usize] += weight);
        self.solve(&mut u);
        self.assembled.supports[i].iter().map(|(dof, weight)| weight * u[*dof as usize]).sum()
    }

    pub fn frequencies(&self, count: usize) -> Vec<f64> {
        lowest(&self.pencil, &self.factor, count).unwrap().frequencies().collect()
    }
}

pub fn at_node(name: &str, node: usize, direction: Direction) -> Point {
    Point { name: name.into(), x: None, node: Some(node.to_string()), direction }
}

/// A slab of shells, simply supported on its end lines, with a girder under its middle.
pub fn slab(nx: usize, ny: usize) -> Value {
    let number = |i: usize, j: usize| i * (ny + 1) + j;
    let nodes = (0..=nx).flat_map(|i| {
        (0..=ny).map(move |j| json!([number(i, j), L * i as f64 / nx as f64, 6.0 * j as f64 / ny as f64 - 3.0, 0]))
    });
    let bays = (0..nx)
        .flat_map(|i| (0..ny).map(move |j| [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]));
    let ends = |i: usize| (0..=ny).map(|j| number(i, j)).collect::<Vec<_>>();
    json!({
        "nodes": nodes.collect::<Vec<_>>(),
        "shells": [{ "section": "slab", "elements": bays.collect::<Vec<_>>() }],
        "beams": [{ "section": "girder", "orientation": [0, 1, 0], "offsets": [[0, 0, 0.8], [0, 0, 0.8]],
            "elements": (0..nx).map(|i| [number(i, ny / 2), number(i + 1, ny / 2)]).collect::<Vec<_>>() }],
        "bearings": [{ "nodes": ends(0), "fixed": ["x", "y", "z"] }, { "nodes": ends(nx), "fixed": ["z"] }],
        "deck": { "length": L, "y": 0.8, "on": { "shells": ["slab"] } }
    })
}
