//! Systems in systems → components, and the wires between them.
//!
//! A wire goes from an output of one component to an input of another, over as many connectors of systems and signals of
//! dictionaries as there are.

use crate::graph::{Graph, Hop, Node};
use crate::problem::Report;
use crate::types::{Component, Structure};
use crate::values::{Bound, Offer, bind};

/// All components of a structure, and how they are connected.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Flat {
    /// The components; a name is that of all systems around it and its own, joined by dots.
    pub components: Vec<Component>,
    /// From outputs to inputs.
    pub wires: Vec<Wire>,
    /// Inputs that are connected to a connector of a system which nothing drives: component, input, connector.
    pub undriven: Vec<(usize, String, String)>,
    /// Values of each component in the order of the components; the last for a variable holds.
    pub values: Vec<Vec<Bound>>,
    /// All values that bindings offer.
    pub offers: Vec<Offer>,
    /// What is allowed, but rarely meant.
    pub warnings: Vec<String>,
}

/// A connection of two components.
#[derive(Clone, Debug, PartialEq)]
pub struct Wire {
    /// Component and its output.
    pub from: (usize, String),
    /// Component and its input.
    pub to: (usize, String),
    /// What happens on the way.
    pub hops: Vec<Hop>,
    /// Where the last connection stands.
    pub place: String,
}

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
