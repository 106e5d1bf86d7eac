//! A structure without systems in systems: components, wires between them, values for them.

use crate::graph::Hop;
use crate::parameters::Value;
use crate::types::Component;

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

/// A value for a variable of a component, if the component has one of this name.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// Name of the variable.
    pub variable: String,
    /// The value as it is bound.
    pub value: Value,
    /// What happens to it on its way.
    pub hops: Vec<Hop>,
    /// Which of the offers it comes from.
    pub offer: usize,
}

/// A value that a binding offers; it may fit nowhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Offer {
    /// Its name after prefix and mapping.
    pub name: String,
    /// The file it stands in, as messages call it.
    pub file: String,
    /// Where in it.
    pub place: String,
    /// Whether a connector of a system has its name.
    pub connector: bool,
}
