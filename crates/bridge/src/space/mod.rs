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

use ttb_contract::{Component, ModelError};
use ttb_scenario::types::{Direction, Freedom, Model, Point};
use ttb_sparse::Assembly;

use crate::assembled::{Assembled, Monitor};
use crate::deck::Row;
use crate::rows::sparse;
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

/// As [`assemble_for`], for the vertical motion of the supports alone.
///
/// # Errors
/// As [`assemble_for`].
pub fn assemble(model: &Model, supports: &[f64], points: &[Point]) -> Result<Assembled, ModelError> {
    assemble_for(model, supports, &[Component::Vertical], points)
}

/// Numbers, assembles, and lays the track over the model: supports at `supports` (m from the bridge's begin), a block of rows
/// for each of the `components` of their motion, and the monitored `points`.
///
/// # Errors
/// What in the model cannot be, a mechanism that shows without factorising, a support or point where nothing carries;
/// the message names element, node or station.
pub fn assemble_for(
    model: &Model,
    supports: &[f64],
    components: &[Component],
    points: &[Point],
) -> Result<Assembled, ModelError> {
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
    let station = |component: Component, number: usize, x: &f64| {
        let what = format!("support[{number}]");
        freedoms.row(&track.at(*x, component, &what)?, &format!("{what} at x = {x} m"))
    };
    let block = |component: &Component| {
        let (component, station) = (*component, &station);
        (1..).zip(supports).map(move |(number, x)| station(component, number, x))
    };
    let supports = components.iter().flat_map(block).collect::<Result<_, _>>()?;
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

/// −M r of rigid translations across and down, over the free motions; what moves with the bearings counts.
///
/// # Errors
/// As [`assemble_for`].
pub fn inertia(model: &Model) -> Result<[Row; 2], ModelError> {
    let freedoms = Freedoms::new(model)?;
    let mut loads = [vec![0.0; freedoms.motions.len()], vec![0.0; freedoms.motions.len()]];
    for element in elements::all(model, &freedoms.index) {
        let element = element?;
        let (matrices, tied) = (element.kind.matrices(), freedoms.tied(&element.motions()));
        let n = matrices.n;
        for (load, axis) in loads.iter_mut().zip([1, 2]) {
            for (i, row) in tied.t.iter().enumerate() {
                let inertia: f64 = (axis..n).step_by(6).map(|j| matrices.m[i * n + j]).sum();
                row.iter().for_each(|(at, weight)| load[tied.dofs[*at] as usize] -= weight * inertia);
            }
        }
    }
    Ok(loads.map(|load| sparse(&load)))
}

/// Displacement of a point: down or across on the track's line, or of a node in its direction.
fn monitor(point: &Point, freedoms: &Freedoms, track: &Track) -> Result<Row, ModelError> {
    let what = format!("point {}", point.name);
    match (point.x, &point.node) {
        (Some(x), None) => {
            let along = match point.direction {
                Direction::Y => Component::Lateral,
                Direction::X | Direction::Z => Component::Vertical,
            };
            freedoms.row(&track.at(x, along, &what)?, &what)
        }
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
