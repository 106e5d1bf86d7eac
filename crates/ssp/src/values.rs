//! Bindings → values of the components' variables (SSP 1.0 and 2.0, "ParameterBindings").
//!
//! A binding of a component names its variables. A binding of a system names, relative to the system, the connectors of it and
//! of the systems in it, and the variables of all components in it: `System.Component.variable`. A value for a connector goes
//! where its connections lead, transformed by them. Of two values for one variable the one that is bound further out holds,
//! on one level the one that is bound last. With a mapping only what it names is bound.

use crate::flat::{Bound, Flat, Offer};
use crate::graph::{Graph, Hop, Node};
use crate::parameters::{Binding, Mapping, Value, Values};
use crate::types::Connector;

/// Values of a system and of all in it, from the inside out.
pub(crate) fn bind(graph: &Graph, level: usize, flat: &mut Flat) {
    let here = &graph.levels[level];
    for component in &here.components {
        for binding in &graph.components[*component].0.bindings {
            for (variable, value, hop, offer) in offers(binding, flat) {
                let hops = vec![hop];
                flat.values[*component].push(Bound { variable, value, hops, offer });
            }
        }
    }
    here.systems.iter().for_each(|inner| bind(graph, *inner, flat));
    for binding in &here.system.bindings {
        for (name, value, hop, offer) in offers(binding, flat) {
            let one = One { graph, value: &value, offer };
            one.apply(level, &name, &hop, flat);
        }
    }
}

/// What a binding offers: names, values, what its mapping does to them.
fn offers(binding: &Binding, flat: &mut Flat) -> Vec<(String, Value, Hop, usize)> {
    let Values::Inline(set) = &binding.values else { return Vec::new() };
    let (mut all, mut warnings) = (Vec::new(), Vec::new());
    let mut offer = |name: String, value: &Value, hop: Hop, file: &str, place: &str| {
        flat.offers.push(Offer { name: name.clone(), file: file.into(), place: place.into(), connector: false });
        all.push((name, value.clone(), hop, flat.offers.len() - 1));
    };
    match &binding.mapping {
        Some(Mapping::Inline(entries)) => {
            for entry in entries {
                let fits = |name: &str| entry.source.strip_prefix(&binding.prefix) == Some(name);
                let Some(parameter) = set.parameters.iter().find(|parameter| fits(&parameter.name)) else {
                    let (file, place, source) = (&entry.file, &entry.place, &entry.source);
                    warnings.push(format!("{file}: {place}: the set {} has no parameter {source}", set.name));
                    continue;
                };
                let hop = Hop {
                    unit: None,
                    suppress_unit_conversion: entry.suppress_unit_conversion,
                    transformation: entry.transformation.clone(),
                    place: entry.place.clone(),
                };
                offer(entry.target.clone(), &parameter.value, hop, &entry.file, &entry.place);
            }
        }
        _ => {
            for parameter in &set.parameters {
                let name = format!("{}{}", binding.prefix, parameter.name);
                let hop = Hop { place: parameter.place.clone(), ..Hop::default() };
                offer(name, &parameter.value, hop, &parameter.file, &parameter.place);
            }
        }
    }
    flat.warnings.extend(warnings);
    all
}

/// A value that is bound to a name.
struct One<'a> {
    graph: &'a Graph<'a>,
    value: &'a Value,
    offer: usize,
}

impl One<'_> {
    /// To all that has this name in a system: names need not be unique, since they may contain dots themselves.
    fn apply(&self, level: usize, name: &str, hop: &Hop, flat: &mut Flat) {
        let here = &self.graph.levels[level];
        if let Some(connector) = here.connectors.get(name) {
            flat.offers[self.offer].connector = true;
            let hop = Hop { unit: self.graph.unit(connector), ..hop.clone() };
            self.pass(level, connector, &[hop], flat);
        }
        let below = |element: &str| name.strip_prefix(element).and_then(|rest| rest.strip_prefix('.'));
        for component in &here.components {
            let Some(variable) = below(&self.graph.components[*component].0.name) else { continue };
            let hops = vec![hop.clone()];
            self.push(*component, variable, hops, flat);
        }
        for inner in &here.systems {
            let Some(rest) = below(&self.graph.levels[*inner].system.name) else { continue };
            self.apply(*inner, rest, hop, flat);
        }
    }

    /// From a connector of a system along its connections. A start value of an output concerns nothing inside.
    fn pass(&self, level: usize, connector: &Connector, hops: &[Hop], flat: &mut Flat) {
        let from = Node::System(level, connector.name.clone());
        for edge in self.graph.out_of.get(&from).into_iter().flatten().map(|edge| &self.graph.edges[*edge]) {
            let hops = [hops, std::slice::from_ref(&edge.hop)].concat();
            match &edge.to {
                Node::Component(component, variable) => self.push(*component, variable, hops, flat),
                // Only inwards, so that it ends.
                Node::System(inner, name) if self.graph.levels[level].systems.contains(inner) => {
                    if let Some(next) = self.graph.levels[*inner].connectors.get(name.as_str()) {
                        self.pass(*inner, next, &hops, flat);
                    }
                }
                _ => {}
            }
        }
    }

    fn push(&self, component: usize, variable: &str, hops: Vec<Hop>, flat: &mut Flat) {
        let (variable, value, offer) = (variable.to_string(), self.value.clone(), self.offer);
        flat.values[component].push(Bound { variable, value, hops, offer });
    }
}
