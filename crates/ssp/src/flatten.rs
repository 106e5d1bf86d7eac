//! Systems in systems → components, and the wires between them.
//!
//! A wire goes from an output of one component to an input of another, over as many connectors of systems and signals of
//! dictionaries as there are.

use crate::flat::{Flat, Wire};
use crate::graph::{Graph, Node};
use crate::problem::Report;
use crate::types::{Component, Structure};
use crate::values::bind;

/// Flattens a structure whose files are loaded; problems go to `report`.
pub fn flatten(structure: &Structure, report: &mut Report) -> Flat {
    let graph = Graph::new(structure, report);
    let mut flat = Flat { values: vec![Vec::new(); graph.components.len()], ..Flat::default() };
    bind(&graph, 0, &mut flat);
    wires(&graph, &mut flat, report);
    let named = |(component, name): (&Component, String)| Component { name, ..component.clone() };
    flat.components = graph.components.into_iter().map(named).collect();
    flat
}

/// From every input of a component back to the output that drives it.
fn wires(graph: &Graph, flat: &mut Flat, report: &mut Report) {
    for edge in &graph.edges {
        let Node::Component(to, input) = &edge.to else { continue };
        let place = &edge.hop.place;
        let mut hops = vec![edge.hop.clone()];
        let mut from = &edge.from;
        while let Some(before) = graph.into.get(from).filter(|_| !matches!(from, Node::Component(..))) {
            let before = &graph.edges[*before];
            hops.push(before.hop.clone());
            from = &before.from;
            if hops.len() > graph.levels.len() + graph.edges.len() {
                return report.problem(place, "is part of a circle of connections");
            }
        }
        hops.reverse();
        match from {
            Node::Component(from, _) if from == to => report.problem(place, "connects a component with itself"),
            Node::Component(from, output) => flat.wires.push(Wire {
                from: (*from, output.clone()),
                to: (*to, input.clone()),
                hops,
                place: place.clone(),
            }),
            Node::System(_, name) | Node::Signal(_, name) => {
                flat.undriven.push((*to, input.clone(), name.clone()));
            }
        }
    }
}
