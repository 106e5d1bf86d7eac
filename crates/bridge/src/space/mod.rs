//! A finite-element model in space → equations.
//!
//! ```text
//! model ─ freedoms: ties, bearings ─▶ numbers ─ elements: K, M, C ─▶ equations
//!                                        └──── track: weights ────▶ rows of supports and points
//! ```
//!
//! A motion is free, held by a bearing, left out because nothing resists it, or tied: a combination of others,
//! u = T q. Ties are eliminated exactly, element by element: Tᵀ K T, Tᵀ M T, Tᵀ C T, and rows r T.

mod audit;
mod carriers;
mod diagonal;
mod elements;
mod freedoms;
mod kind;
mod outline;
mod report;
mod solids;
mod tied;
mod track;

use ttb_contract::ModelError;
use ttb_scenario::types::{Direction, Freedom, Model, Point};
use ttb_sparse::Assembly;

use crate::assembled::{Assembled, Monitor};
use crate::deck::Row;
use diagonal::Diagonal;
use elements::Placed;
use freedoms::Freedoms;
use kind::Kind;
use track::Track;

pub use audit::{Statics, self_check};
pub use outline::outline;
pub use report::{Reaction, Reactions, SelfCheck};

/// Of the motions that a mechanism leaves loose, so many are named.
const NAMED: usize = 5;

/// Numbers, assembles, and lays the track over the model: supports at `supports` (m from the bridge's begin) and the
/// monitored `points`.
///
/// # Errors
/// What in the model cannot be, a mechanism that shows without factorising, a support or point where nothing carries;
/// the message names element, node or station.
pub fn assemble(model: &Model, supports: &[f64], points: &[Point]) -> Result<Assembled, ModelError> {
    let freedoms = Freedoms::new(model)?;
    let mut system = System::new(&freedoms);
    for element in elements::all(model, &freedoms.index) {
        system.add(&element?);
    }
    let loose = system.stiffness.loose(&freedoms);
    if !loose.is_empty() {
        let mut names: Vec<String> =
            loose.iter().take(NAMED).map(|dof| format!("the {}", freedoms.name(*dof))).collect();
        if loose.len() > NAMED {
            names.push(format!("{} more", loose.len() - NAMED));
        }
        return Err(ModelError(format!("bridge: mechanism: nothing resists {}", names.join(", "))));
    }
    let track = Track::new(model, &freedoms.index)?;
    let station = |(number, x): (usize, &f64)| {
        let what = format!("support[{number}]");
        freedoms.row(&track.at(*x, &what)?, &format!("{what} at x = {x} m"))
    };
    let supports = (1..).zip(supports).map(station).collect::<Result<_, _>>()?;
    let monitors = points.iter().map(|point| monitor(point, &freedoms, &track)).collect::<Result<_, _>>()?;
    let points = points.iter().enumerate();
    let points = points.map(|(motion, point)| Monitor { name: point.name.clone(), motion, moment: None }).collect();
    let System { equations, mass, .. } = system;
    Ok(Assembled {
        digits: None,
        equations,
        nodes: model.nodes.iter().map(|(_, x, y, z)| [*x, *y, *z]).collect(),
        node_of: freedoms.motions.iter().map(|motion| motion / 6).collect(),
        names: freedoms.names(),
        supports,
        monitors,
        points,
        mass,
    })
}

/// Displacement of a point: down on the track's line, or of a node in its direction.
fn monitor(point: &Point, freedoms: &Freedoms, track: &Track) -> Result<Row, ModelError> {
    let what = format!("point {}", point.name);
    match (point.x, &point.node) {
        (Some(x), None) => freedoms.row(&track.at(x, &what)?, &what),
        (None, Some(node)) => {
            let position = node.parse().ok().and_then(|number| freedoms.index.position(number));
            let position =
                position.ok_or_else(|| ModelError(format!("bridge: {what}: there is no node numbered {node}")))?;
            let freedom = match point.direction {
                Direction::X => Freedom::X,
                Direction::Y => Freedom::Y,
                Direction::Z => Freedom::Z,
            };
            freedoms.row(&[(ttb_scenario::space::motion(position, freedom), 1.0)], &what)
        }
        _ => Err(ModelError(format!("bridge: {what} needs either x or node"))),
    }
}

/// The equations while they are assembled.
struct System<'a> {
    freedoms: &'a Freedoms,
    equations: Assembly,
    stiffness: Diagonal,
    /// Mass so far, kg.
    mass: f64,
}

impl<'a> System<'a> {
    fn new(freedoms: &'a Freedoms) -> Self {
        let equations = Assembly::new(freedoms.motions.len());
        Self { freedoms, equations, stiffness: Diagonal::new(freedoms), mass: 0.0 }
    }

    fn add(&mut self, element: &Placed) {
        let (matrices, motions) = (element.kind.matrices(), element.motions());
        self.mass += vertical(matrices.n, &matrices.m);
        self.stiffness.add(self.freedoms, &motions, &matrices);
        if let Some(dofs) = self.freedoms.plain(&motions) {
            matrices.add_to(&mut self.equations, &dofs);
        } else {
            let tied = self.freedoms.tied(&motions);
            self.equations.add(&tied.present(), &tied.transform(&matrices.k), &tied.transform(&matrices.m));
        }
        if let Kind::Spring { spring, .. } = &element.kind
            && spring.damping.iter().any(|c| *c > 0.0)
        {
            let tied = self.freedoms.tied(&motions);
            self.equations.add_damping(&tied.present(), &tied.transform(&element.kind.damping()));
        }
    }
}

/// Mass of an element along z: rᵀ M r for the rigid motion r along z.
fn vertical(n: usize, m: &[f64]) -> f64 {
    let z = || (2..n).step_by(6);
    z().flat_map(|i| z().map(move |j| m[i * n + j])).sum()
}
