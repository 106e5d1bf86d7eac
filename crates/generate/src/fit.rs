//! The mesh for a number of degrees of freedom.

use crate::error::{Refused, Rules};

/// Sizes of elements that are aimed at, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mesh {
    /// Along the girder.
    pub(crate) along: f64,
    /// Across it: floor, flanges, cross-beams.
    pub(crate) across: f64,
    /// Upright: webs, cross-beams.
    pub(crate) up: f64,
}

/// How far from the asked number a mesh may be.
const SLACK: f64 = 0.04;
/// Most elements between two cross-beams.
const MOST: usize = 200;

/// Sizes upright that are tried, as parts of the size across.
const UPRIGHT: [f64; 7] = [0.5, 0.7, 0.85, 1.0, 1.2, 1.4, 2.0];

/// Sizes that give about `dofs` degrees of freedom as `count` counts them: the most nearly square elements within 4 %,
/// or else the nearest number. Along the girder `bay`, the distance of cross-beams, is divided evenly; across `width`.
pub(crate) fn fit(dofs: usize, bay: f64, width: f64, count: impl Fn(Mesh) -> usize) -> Result<Mesh, Refused> {
    let mut rules = Rules::default();
    let (least, asked) = (count(coarsest(bay, width)), dofs as f64);
    let rule = format!("the number of degrees of freedom must be at least {least}");
    rules.demand(asked * (1.0 + SLACK) >= least as f64, &rule, dofs);
    rules.demand(dofs <= 20_000_000, "the number of degrees of freedom must be at most 20000000", dofs);
    rules.result()?;
    let mut best = ((1, f64::INFINITY), coarsest(bay, width));
    for n in 1..=MOST {
        for m in 1.. {
            let across = width / m as f64;
            let mut over = true;
            for part in UPRIGHT {
                let mesh = Mesh { along: bay / n as f64, across, up: part * across };
                let off = count(mesh) as f64 / asked - 1.0;
                // outside the slack the error counts, inside it the shape
                let shape = (mesh.along / across).ln().abs() + 0.5 * part.ln().abs();
                let key = if off.abs() <= SLACK { (0, shape + 10.0 * off.abs()) } else { (1, off.abs()) };
                if key < best.0 {
                    best = (key, mesh);
                }
                over &= off > SLACK;
            }
            if over {
                break;
            }
        }
    }
    Ok(best.1)
}

/// One element between two lines that the mesh must have, wherever it may.
pub(crate) fn coarsest(bay: f64, width: f64) -> Mesh {
    Mesh { along: bay, across: width, up: width }
}
