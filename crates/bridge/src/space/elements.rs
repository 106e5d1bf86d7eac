//! The model's elements one after the other, each with its nodes and its place in the file.

use std::fmt;

use ttb_contract::ModelError;
use ttb_elements::{Mass, Spring};
use ttb_scenario::space::{Index, Motion, motion};
use ttb_scenario::types::{Freedom, Model};

use super::kind::Kind;
use super::solids::{self, Sections};

/// Where an element stands in the file: list, and positions in it.
#[derive(Clone, Copy)]
pub(super) struct Place(pub &'static str, pub usize, pub usize);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}].elements[{}]", self.0, self.1, self.2)
    }
}

/// An element with its nodes.
pub(super) struct Placed {
    pub kind: Kind,
    /// Positions of its nodes.
    pub nodes: Vec<usize>,
}

impl Placed {
    /// The motions its matrices act on, in their order.
    pub fn motions(&self) -> Vec<Motion> {
        self.nodes.iter().flat_map(|node| Freedom::ALL.map(|freedom| motion(*node, freedom))).collect()
    }
}

/// All elements in the file's order.
pub(super) fn all<'a>(model: &'a Model, index: &'a Index) -> impl Iterator<Item = Result<Placed, ModelError>> + 'a {
    let sections = Sections::new(model);
    let (lines, plates) = (sections.clone(), sections.clone());
    let beams = model.beams.iter().enumerate().flat_map(move |(i, list)| {
        let section = sections.beam(&list.section);
        list.elements.iter().enumerate().map(move |(j, ends)| {
            place(model, index, ends, Place("beams", i, j), |corners| {
                let released = list.releases.iter().flatten().any(|freed| !freed.is_empty());
                let beam = solids::beam(list, section.clone()?, [corners[0], corners[1]])?;
                Ok(Kind::Beam { beam: Box::new(beam), released })
            })
        })
    });
    let trusses = model.trusses.iter().enumerate().flat_map(move |(i, list)| {
        let section = lines.line(&list.section);
        list.elements.iter().enumerate().map(move |(j, ends)| {
            place(model, index, ends, Place("trusses", i, j), |corners| {
                let truss = solids::truss(list, j, section.clone()?, [corners[0], corners[1]])?;
                Ok(Kind::Truss(truss))
            })
        })
    });
    let shells = model.shells.iter().enumerate().flat_map(move |(i, list)| {
        let plate = plates.plate(&list.section);
        list.elements.iter().enumerate().map(move |(j, nodes)| {
            place(model, index, nodes, Place("shells", i, j), |corners| solids::shell(corners, plate.clone()?))
        })
    });
    beams.chain(trusses).chain(shells).chain(points(model, index))
}

/// Springs and masses.
fn points<'a>(model: &'a Model, index: &'a Index) -> impl Iterator<Item = Result<Placed, ModelError>> + 'a {
    let springs = model.springs.iter().enumerate().flat_map(move |(i, list)| {
        let spring = Spring { stiffness: list.stiffness, damping: list.damping };
        list.elements.iter().enumerate().map(move |(j, nodes)| {
            place(model, index, nodes, Place("springs", i, j), |corners| match corners.len() {
                1 | 2 => Ok(Kind::Spring { spring, grounded: corners.len() == 1 }),
                number => Err(format!("a spring has 1 or 2 nodes, not {number}")),
            })
        })
    });
    let masses = model.masses.iter().enumerate().flat_map(move |(i, list)| {
        let mass = Mass { mass: list.mass, inertia: list.inertia };
        list.nodes
            .iter()
            .enumerate()
            .map(move |(j, node)| place(model, index, &[*node], Place("masses", i, j), |_| Ok(Kind::Mass(mass))))
    });
    springs.chain(masses)
}

/// Finds an element's nodes and makes it from their coordinates.
fn place(
    model: &Model,
    index: &Index,
    numbers: &[u32],
    place: Place,
    make: impl FnOnce(&[[f64; 3]]) -> Result<Kind, String>,
) -> Result<Placed, ModelError> {
    let wrong = |why: String| ModelError(format!("bridge: {place} (nodes {numbers:?}): {why}"));
    let node = |number: &u32| index.position(*number).ok_or_else(|| format!("there is no node numbered {number}"));
    let nodes: Vec<usize> = numbers.iter().map(node).collect::<Result<_, _>>().map_err(wrong)?;
    let corners: Vec<[f64; 3]> = nodes.iter().map(|node| coordinates(model, *node)).collect();
    Ok(Placed { kind: make(&corners).map_err(wrong)?, nodes })
}

/// Where a node is.
pub(super) fn coordinates(model: &Model, node: usize) -> [f64; 3] {
    let (_, x, y, z) = model.nodes[node];
    [x, y, z]
}
