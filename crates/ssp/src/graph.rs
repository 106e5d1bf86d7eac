//! Systems in systems as a graph: connectors of components, of systems and signals of dictionaries are its nodes,
//! connections its edges, in the direction of the values.
//!
//! Which end of a connection gives the value follows from the kinds of its connectors, as seen from the system in which the
//! connection stands: an input of that system gives, an input of an element takes. No node takes values from two edges.

use std::collections::HashMap;

use crate::problem::Report;
use crate::transform::Transformation;
use crate::types::{BaseUnit, Component, Connection, Connector, SignalReference, Structure, System, Type};

/// One connection, or one entry of a mapping, on the way of a value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hop {
    /// Unit at its end, if the document says one.
    pub unit: Option<BaseUnit>,
    /// Units are left alone.
    pub suppress_unit_conversion: bool,
    /// After a change of units.
    pub transformation: Option<Transformation>,
    /// Where it stands.
    pub place: String,
}

/// Something that connections end in: whose it is, by number, and its name.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Node {
    /// A component's connector.
    Component(usize, String),
    /// A system's connector.
    System(usize, String),
    /// A signal of a dictionary.
    Signal(usize, String),
}

/// A connection, in the direction of the values.
pub(crate) struct Edge {
    pub from: Node,
    pub to: Node,
    pub hop: Hop,
}

/// A system and what is under it, by number.
pub(crate) struct Level<'a> {
    pub system: &'a System,
    /// Components in it.
    pub components: Vec<usize>,
    /// Systems in it.
    pub systems: Vec<usize>,
    /// Its own connectors.
    pub connectors: Connectors<'a>,
    elements: HashMap<&'a str, Element<'a>>,
    parent: Option<usize>,
    /// Numbers of its signal dictionaries.
    dictionaries: HashMap<&'a str, usize>,
}

type Connectors<'a> = HashMap<&'a str, &'a Connector>;

/// What has connectors within a system.
enum Element<'a> {
    Component(usize),
    System(usize),
    Signals(&'a SignalReference, Connectors<'a>),
}

/// A structure as a graph.
pub(crate) struct Graph<'a> {
    pub levels: Vec<Level<'a>>,
    /// Components and their names: those of all systems around them and their own, joined by dots.
    pub components: Vec<(&'a Component, String)>,
    pub edges: Vec<Edge>,
    /// The edge that leads to a node.
    pub into: HashMap<Node, usize>,
    /// Edges from a node.
    pub out_of: HashMap<Node, Vec<usize>>,
    connectors: Vec<Connectors<'a>>,
    units: HashMap<&'a str, BaseUnit>,
    dictionaries: usize,
}

fn by_name(connectors: &[Connector]) -> Connectors<'_> {
    connectors.iter().map(|connector| (connector.name.as_str(), connector)).collect()
}

impl<'a> Graph<'a> {
    /// Of a structure whose files are loaded.
    pub fn new(structure: &'a Structure, report: &mut Report) -> Self {
        let units = structure.units.iter().map(|unit| (unit.name.as_str(), unit.base)).collect();
        let mut graph = Self {
            levels: Vec::new(),
            components: Vec::new(),
            edges: Vec::new(),
            into: HashMap::new(),
            out_of: HashMap::new(),
            connectors: Vec::new(),
            units,
            dictionaries: 0,
        };
        graph.level(&structure.system, None, "", report);
        for level in 0..graph.levels.len() {
            let system = graph.levels[level].system;
            system.connections.iter().for_each(|connection| graph.connect(level, connection, report));
        }
        graph
    }

    /// Numbers a system and all in it.
    fn level(&mut self, system: &'a System, parent: Option<usize>, path: &str, report: &mut Report) -> usize {
        let number = self.levels.len();
        let mut dictionaries = HashMap::new();
        for name in &system.dictionaries {
            dictionaries.insert(name.as_str(), self.dictionaries);
            self.dictionaries += 1;
        }
        let mut elements = HashMap::new();
        let mut components = Vec::new();
        for component in &system.components {
            elements.insert(component.name.as_str(), Element::Component(self.components.len()));
            components.push(self.components.len());
            self.components.push((component, format!("{path}{}", component.name)));
            self.connectors.push(by_name(&component.connectors));
        }
        for signals in &system.signals {
            elements.insert(signals.name.as_str(), Element::Signals(signals, by_name(&signals.connectors)));
        }
        let (systems, connectors) = (Vec::new(), by_name(&system.connectors));
        self.levels.push(Level { system, components, systems, connectors, elements, parent, dictionaries });
        for signals in &system.signals {
            if self.dictionary(number, &signals.dictionary).is_none() {
                report.problem(&signals.place, format!("there is no signal dictionary {}", signals.dictionary));
            }
        }
        for inner in &system.systems {
            let name = inner.name.as_str();
            let inner = self.level(inner, Some(number), &format!("{path}{name}."), report);
            let level = &mut self.levels[number];
            level.systems.push(inner);
            level.elements.insert(name, Element::System(inner));
        }
        number
    }

    /// A dictionary's number, in a system or in those around it.
    fn dictionary(&self, level: usize, name: &str) -> Option<usize> {
        let level = &self.levels[level];
        level.dictionaries.get(name).copied().or_else(|| self.dictionary(level.parent?, name))
    }

    /// What an end of a connection in a system is: the node, its connector, whether it takes values there.
    fn end(
        &self,
        level: usize,
        element: Option<&str>,
        name: &str,
    ) -> Result<(Node, &'a Connector, Option<bool>), String> {
        let here = &self.levels[level];
        let Some(element) = element else {
            let connector = here.connectors.get(name).ok_or_else(|| format!("the system has no connector {name}"))?;
            // Seen from inside, an input of the system gives.
            return Ok((Node::System(level, name.into()), connector, connector.kind.takes().map(|takes| !takes)));
        };
        let missing = |what: &str| format!("the {what} {element} has no connector {name}");
        let (node, connector) = match here.elements.get(element) {
            None => return Err(format!("there is no component {element}")),
            Some(Element::Component(number)) => {
                let connector = self.connectors[*number].get(name).ok_or_else(|| missing("component"))?;
                (Node::Component(*number, name.into()), connector)
            }
            Some(Element::System(number)) => {
                let connector = self.levels[*number].connectors.get(name).ok_or_else(|| missing("system"))?;
                (Node::System(*number, name.into()), connector)
            }
            Some(Element::Signals(signals, connectors)) => {
                let connector = connectors.get(name).ok_or_else(|| missing("signal dictionary reference"))?;
                let number = self.dictionary(level, &signals.dictionary);
                let number = number.ok_or_else(|| format!("there is no signal dictionary {}", signals.dictionary))?;
                (Node::Signal(number, name.into()), connector)
            }
        };
        Ok((node, connector, connector.kind.takes()))
    }

    fn connect(&mut self, level: usize, connection: &Connection, report: &mut Report) {
        let place = &connection.place;
        let [start, end] = [&connection.start, &connection.end].map(|(element, name)| {
            let end = self.end(level, element.as_deref(), name);
            end.map_err(|why| report.problem(place, why)).ok()
        });
        let (Some((a, of_a, a_takes)), Some((b, of_b, b_takes))) = (start, end) else { return };
        let (from, to, target) = match (a_takes, b_takes) {
            (Some(false) | None, Some(true) | None) => (a, b, of_b),
            (Some(true), Some(false) | None) | (None, Some(false)) => (b, a, of_a),
            (Some(true), Some(true)) => {
                return report.problem(place, format!("{} is no output but an {}", of_a.name, of_a.kind.name()));
            }
            (Some(false), Some(false)) => {
                return report.problem(place, format!("{} is no input but an {}", of_b.name, of_b.kind.name()));
            }
        };
        if let Some(other) = self.into.get(&to) {
            let other = self.edges[*other].hop.place.rsplit('/').next().unwrap_or_default();
            return report.problem(place, format!("{} is driven already, by {other}", target.name));
        }
        let hop = Hop {
            unit: self.unit(target),
            suppress_unit_conversion: connection.suppress_unit_conversion,
            transformation: connection.transformation.clone(),
            place: place.clone(),
        };
        self.into.insert(to.clone(), self.edges.len());
        self.out_of.entry(from.clone()).or_default().push(self.edges.len());
        self.edges.push(Edge { from, to, hop });
    }

    /// The unit that a connector declares.
    pub fn unit(&self, connector: &Connector) -> Option<BaseUnit> {
        match &connector.kind_of_value {
            Some(Type::Real(Some(unit))) => self.units.get(unit.as_str()).copied(),
            _ => None,
        }
    }
}
