//! Spans of beams and plane frames: from the specification to equations and rows.

use ttb_contract::ModelError;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::{Direction, Point};

use crate::assembled::{Assembled, Monitor};
use crate::deck::{Deck, Row};
use crate::mesh::Mesh;
use crate::rows::sparse;

/// Meshes and assembles; the supports stand on the deck.
///
/// # Errors
/// Anything in the specification that cannot be: the message names it.
pub fn assemble(spec: &BridgeSpec) -> Result<Assembled, ModelError> {
    let mesh = mesh(spec)?;
    let deck = Deck::new(&mesh)?;
    let supports = support_rows(&mesh, &deck, &spec.supports)?;
    let (monitors, points) = monitor_rows(&mesh, &deck, &spec.points)?;
    let equations = mesh.assembly();
    let node_of = mesh.node_of();
    let nodes = mesh.nodes.iter().map(|node| [node.x, 0.0, node.z]).collect();
    let mass = mesh.mass();
    let names = Box::new(move |dof| mesh.describe(dof));
    Ok(Assembled { equations, nodes, node_of, names, supports, monitors, points, mass, digits: None })
}

fn mesh(spec: &BridgeSpec) -> Result<Mesh, ModelError> {
    Ok(match &spec.structure {
        StructureSpec::Beams { spans, continuous } => {
            if let Some(point) = spec.points.iter().find(|p| p.direction == Direction::X) {
                return Err(ModelError(format!("bridge: point {}: beams move only along z", point.name)));
            }
            crate::beams::mesh(spans, *continuous)?
        }
        StructureSpec::Frame(frame) => crate::frame::mesh(frame)?,
        _ => return Err(ModelError("bridge: this structure is not plane".into())),
    })
}

/// −M r of a rigid translation across, which a plane bridge does not know, and down.
///
/// # Errors
/// As [`assemble`].
pub fn inertia(spec: &BridgeSpec) -> Result<[Row; 2], ModelError> {
    let mesh = mesh(spec)?;
    let mut load = vec![0.0; mesh.ndof];
    for element in &mesh.elements {
        let mass = element.frame.mass_matrix();
        for (i, dof) in mesh.element_dofs(element).into_iter().enumerate() {
            // Down is the second motion of a node.
            dof.into_iter().for_each(|dof| load[dof as usize] -= mass[(i, 1)] + mass[(i, 4)]);
        }
    }
    Ok([Row::new(), sparse(&load)])
}

fn support_rows(mesh: &Mesh, deck: &Deck, stations: &[f64]) -> Result<Vec<Row>, ModelError> {
    let row = |(number, &x): (usize, &f64)| {
        let row = deck.displacement(mesh, x, [0.0, 1.0]);
        row.ok_or_else(|| off_deck(&format!("support[{number}]"), x, deck))
    };
    (1..).zip(stations).map(row).collect()
}

fn monitor_rows(mesh: &Mesh, deck: &Deck, points: &[Point]) -> Result<(Vec<Row>, Vec<Monitor>), ModelError> {
    let (mut rows, mut monitors) = (Vec::new(), Vec::new());
    for point in points {
        let name = &point.name;
        let (motion, moment) = match (point.x, &point.node) {
            (Some(x), None) => on_deck(mesh, deck, point, x)?,
            (None, Some(node)) => (at_node(mesh, name, node, point.direction)?, None),
            _ => return Err(ModelError(format!("bridge: point {name} needs either x or node"))),
        };
        rows.push(motion);
        let motion = rows.len() - 1;
        let moment = moment.map(|row| {
            rows.push(row);
            rows.len() - 1
        });
        monitors.push(Monitor { name: name.clone(), motion, moment });
    }
    Ok((rows, monitors))
}

fn on_deck(mesh: &Mesh, deck: &Deck, point: &Point, x: f64) -> Result<(Row, Option<Row>), ModelError> {
    let along = match point.direction {
        Direction::X => [1.0, 0.0],
        Direction::Y => [0.0, 0.0],
        Direction::Z => [0.0, 1.0],
    };
    let motion = deck.displacement(mesh, x, along);
    let motion = motion.ok_or_else(|| off_deck(&format!("point {}", point.name), x, deck))?;
    Ok((motion, deck.moment(mesh, x)))
}

fn at_node(mesh: &Mesh, point: &str, node: &str, direction: Direction) -> Result<Row, ModelError> {
    let found = mesh.nodes.iter().position(|n| n.name == node);
    let found = found.ok_or_else(|| ModelError(format!("bridge: point {point}: there is no node named {node}")))?;
    let dof = match direction {
        Direction::X => mesh.dofs[found][0],
        Direction::Y => None,
        Direction::Z => mesh.dofs[found][1],
    };
    Ok(dof.map(|dof| (dof, 1.0)).into_iter().collect())
}

fn off_deck(what: &str, x: f64, deck: &Deck) -> ModelError {
    let [begin, end] = deck.extent();
    ModelError(format!("bridge: {what} at x = {x} m is off the deck, which reaches from {begin} m to {end} m"))
}
