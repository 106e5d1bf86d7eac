//! Patch tests: an irregular patch reproduces constant strain and constant curvature exactly.

use ttb_elements::Plate;

use crate::structure::{ALL, Shape, Structure};

/// MacNeal & Harder (Finite Elem. Anal. Des. 1, 1985, 3–20), patch of plates: 0.24 × 0.12, t = 0.001, E = 1e6, ν = 0.25.
const PLATE: Plate = Plate { modulus: 1e6, poisson: 0.25, thickness: 1e-3, mass: 0.0 };
const SHAPES: [Shape; 3] = [Shape::Quad, Shape::Triangle, Shape::OtherTriangle];

fn patch(shape: Shape, plate: Plate) -> Structure {
    let places =
        [(0.0, 0.0), (0.24, 0.0), (0.24, 0.12), (0.0, 0.12), (0.04, 0.02), (0.18, 0.03), (0.16, 0.08), (0.08, 0.08)];
    let mut s = Structure::new(places.map(|(x, y)| [x, y, 0.0]).to_vec());
    for corners in [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 6, 7]] {
        s.shell(shape, plate, corners);
    }
    s
}

/// Holds the outer nodes in a field of motion; greatest error inside over the greatest value of the same kind.
fn error(mut s: Structure, field: impl Fn(f64, f64) -> [f64; 6]) -> f64 {
    for node in 0..4 {
        let [x, y, _] = s.nodes[node];
        ALL.into_iter().for_each(|i| s.prescribe(node, i, field(x, y)[i]));
    }
    let motion = s.solve();
    let exact: Vec<[f64; 6]> = s.nodes.iter().map(|p| field(p[0], p[1])).collect();
    let worst = |kind: std::ops::Range<usize>| {
        let scale = exact.iter().flat_map(|m| m[kind.clone()].to_vec()).fold(1e-4, |a: f64, b| a.max(b.abs()));
        let pairs = motion.iter().zip(&exact).flat_map(|(a, b)| kind.clone().map(|i| (a[i] - b[i]).abs()));
        pairs.fold(0.0, f64::max) / scale
    };
    worst(0..3).max(worst(3..6))
}

/// Membrane: u = 1e-3 (x + y/2), v = 1e-3 (y + x/2).
#[test]
fn constant_strain_is_exact() {
    for shape in SHAPES {
        let e = error(patch(shape, PLATE), |x, y| [1e-3 * (x + 0.5 * y), 1e-3 * (y + 0.5 * x), 0.0, 0.0, 0.0, 0.0]);
        println!("membrane patch, {shape:?}: {e:.1e}");
        assert!(e < 1e-9, "{shape:?}: {e}");
    }
}

/// Bending: w = 1e-3 (x² + xy + y²)/2; thin as published, and thick.
#[test]
fn constant_curvature_is_exact() {
    for shape in SHAPES {
        for thickness in [1e-3, 0.05] {
            let plate = Plate { thickness, ..PLATE };
            let e = error(patch(shape, plate), |x, y| {
                [0.0, 0.0, 0.5e-3 * (x * x + x * y + y * y), 1e-3 * (y + 0.5 * x), -1e-3 * (x + 0.5 * y), 0.0]
            });
            println!("bending patch, {shape:?}, t = {thickness}: {e:.1e}");
            assert!(e < 1e-9, "{shape:?}, t = {thickness}: {e}");
        }
    }
}
