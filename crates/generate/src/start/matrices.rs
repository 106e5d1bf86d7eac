//! K and M of a beam as a finite-element program would write them, to be replaced by one's own.
//!
//! ```text
//! K_e = EI/l³ [12 6l −12 6l; 6l 4l² −6l 2l²; …],  M_e = ml/420 [156 22l 54 −13l; …]       Euler–Bernoulli
//! EI = m (2 n₀ L²/π)²                                                                     simply supported
//! ```

use std::f64::consts::PI;
use std::fmt::Write;

use super::{File, SCENARIO, Start, scenario};
use crate::error::{Refused, Rules};

/// Elements of the beam.
const ELEMENTS: usize = 40;

/// A 4 × 4 matrix of an element over [w, θ, w, θ].
type Element = [[f64; 4]; 4];

/// Scenario, K, M and the tables of degrees of freedom, supports and points.
///
/// # Errors
/// Numbers that no bridge has; more than one span.
pub fn matrices(start: &Start) -> Result<Vec<File>, Refused> {
    start.check()?;
    let mut rules = Rules::default();
    rules.demand(start.spans.len() == 1, "the matrices are those of one span", format!("{} spans", start.spans.len()));
    rules.result()?;
    let length = start.spans[0];
    let mass = start.mass();
    let stiffness = mass * (2.0 * start.frequency() * length * length / PI).powi(2);
    let l = length / ELEMENTS as f64;
    let (k, m) = (stiffness / l.powi(3), mass * l / 420.0);
    let k: Element = [
        [12.0, 6.0 * l, -12.0, 6.0 * l],
        [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l],
        [-12.0, -6.0 * l, 12.0, -6.0 * l],
        [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l],
    ]
    .map(|row| row.map(|x| k * x));
    let m: Element = [
        [156.0, 22.0 * l, 54.0, -13.0 * l],
        [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
        [54.0, 13.0 * l, 156.0, -22.0 * l],
        [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
    ]
    .map(|row| row.map(|x| m * x));
    let structure = format!(
        r#"{{
      "$comment": "K and M over the free degrees of freedom, SI units: docs/guide/import.md. length: of the bridge along the track, m.",
      "type": "matrices", "length": {length},
      "files": {{ "stiffness": "K.mtx", "mass": "M.mtx", "dofs": "dofs.csv", "supports": "supports.csv", "points": "points.csv" }}
    }}"#
    );
    let title = format!("{} at {} km/h over a bridge given by its matrices", start.train, start.speed);
    Ok(vec![
        (SCENARIO, scenario(start, &title, &structure)),
        ("K.mtx", market("K, N/m", &k)),
        ("M.mtx", market("M, kg", &m)),
        ("dofs.csv", dofs(l)),
        ("supports.csv", supports(l)),
        ("points.csv", format!("name,node,direction\nmid,{},z\n", ELEMENTS / 2 + 1)),
    ])
}

/// Row of a motion (0: w, 1: θ) of a node, from 1; none for what the bearings hold.
fn row(node: usize, motion: usize) -> Option<usize> {
    match (node, motion) {
        (0, 0) | (ELEMENTS, 0) => None,
        (0, _) => Some(1),
        (ELEMENTS, _) => Some(2 * ELEMENTS),
        (node, motion) => Some(2 * node + motion),
    }
}

/// The assembled matrix in Matrix Market's form, lower triangle.
fn market(what: &str, element: &Element) -> String {
    let n = 2 * ELEMENTS;
    let mut entries = std::collections::BTreeMap::new();
    for first in 0..ELEMENTS {
        let rows = [(first, 0), (first, 1), (first + 1, 0), (first + 1, 1)].map(|(node, motion)| row(node, motion));
        for (i, a) in rows.iter().enumerate().filter_map(|(i, row)| Some((i, (*row)?))) {
            for (j, b) in rows.iter().enumerate().filter_map(|(j, row)| Some((j, (*row)?))).filter(|(_, b)| *b <= a) {
                *entries.entry((b, a)).or_insert(0.0) += element[i][j];
            }
        }
    }
    // What cancels between two elements is no entry.
    entries.retain(|(column, row), x: &mut f64| column == row || x.abs() > 1e-9 * element[1][1]);
    let mut text = format!("%%MatrixMarket matrix coordinate real symmetric\n% {what}\n{n} {n} {}\n", entries.len());
    for ((column, row), x) in entries {
        // Writing to memory does not fail.
        let _ = writeln!(text, "{row} {column} {x:.17e}");
    }
    text
}

fn dofs(l: f64) -> String {
    let mut text = String::from("row,node,direction,x,y,z\n");
    let mut rows: Vec<(usize, String)> = Vec::new();
    for node in 0..=ELEMENTS {
        for (motion, direction) in ["z", "ry"].iter().enumerate() {
            if let Some(row) = row(node, motion) {
                rows.push((row, format!("{row},{},{direction},{},0,0\n", node + 1, l * node as f64)));
            }
        }
    }
    rows.sort();
    rows.into_iter().for_each(|(_, row)| text.push_str(&row));
    text
}

/// Every node carries the track; the ends rest on bearings. Weight 1: z of these matrices points down.
fn supports(l: f64) -> String {
    let mut text = String::from("x,node,direction,weight\n");
    for node in 0..=ELEMENTS {
        // A bearing does not move: any motion with weight 0.
        let (direction, weight) = if row(node, 0).is_some() { ("z", 1) } else { ("ry", 0) };
        let _ = writeln!(text, "{},{},{direction},{weight}", l * node as f64, node + 1);
    }
    text
}
