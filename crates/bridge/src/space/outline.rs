//! A model in space as points and cells, and its own weight on the degrees of freedom.

use ttb_contract::ModelError;
use ttb_scenario::space::motion;
use ttb_scenario::types::{Freedom, Model};

use super::audit::Audit;
use super::elements::{self, coordinates};
use super::freedoms::{Fate, Freedoms};
use crate::deck::Row;
use crate::outline::{Outline, Weight};

/// Nodes as points; beams, trusses, shells and springs between two nodes as cells.
///
/// # Errors
/// The model cannot be numbered, or an element cannot be made.
pub fn outline(model: &Model) -> Result<Outline, ModelError> {
    let freedoms = Freedoms::new(model)?;
    let mut audit = Audit::new(model, &freedoms);
    let mut cells = Vec::new();
    for element in elements::all(model, &freedoms.index) {
        let element = element?;
        audit.weigh(&element, &element.kind.matrices());
        if element.nodes.len() > 1 {
            cells.push(element.nodes.iter().map(|node| *node as u32).collect());
        }
    }
    let rows = (0..model.nodes.len())
        .map(|node| [Freedom::X, Freedom::Y, Freedom::Z].map(|freedom| displacement(&freedoms, node, freedom)))
        .collect();
    let points = (0..model.nodes.len()).map(|node| coordinates(model, node)).collect();
    Ok(Outline { points, cells, rows, weight: Weight::Loads(audit.load) })
}

/// A node's displacement as weights on degrees of freedom; what is held or resisted by nothing does not move.
fn displacement(freedoms: &Freedoms, node: usize, freedom: Freedom) -> Row {
    let free = |(master, weight)| match freedoms.fates[master as usize] {
        Fate::Free(dof) => Some((dof, weight)),
        _ => None,
    };
    freedoms.masters(motion(node, freedom)).filter_map(free).collect()
}
