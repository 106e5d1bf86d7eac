//! A system structure, as far as a co-simulation of FMUs wants to know.

use std::path::PathBuf;

use crate::parameters::{Binding, Enumeration};
pub use crate::source::Source;
use crate::transform::Transformation;
pub use crate::unit::{BaseUnit, Unit};

/// The document every archive has.
pub const STRUCTURE: &str = "SystemStructure.ssd";

/// The content of a SystemStructure.ssd.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Structure {
    /// Name of the structure.
    pub name: String,
    /// One line for people.
    pub description: Option<String>,
    /// Program that wrote it.
    pub tool: Option<String>,
    /// Components and connections.
    pub system: System,
    /// Units the connectors name.
    pub units: Vec<Unit>,
    /// Enumerations that values may name; not written.
    pub enumerations: Vec<Enumeration>,
    /// Start and end of a run, and settings.
    pub experiment: Experiment,
}

/// A system: what it consists of and how that is connected. Only components, their connectors and values, and connections
/// are written: what a document nests is flattened first ([`crate::flatten`]).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct System {
    /// Its name within the system around it.
    pub name: String,
    /// One line for people.
    pub description: Option<String>,
    /// What it shows to the system around it.
    pub connectors: Vec<Connector>,
    /// Its components, in the order of the document.
    pub components: Vec<Component>,
    /// Systems within it.
    pub systems: Vec<System>,
    /// Places where signals of a signal dictionary can be connected.
    pub signals: Vec<SignalReference>,
    /// Names of the signal dictionaries that stand in it.
    pub dictionaries: Vec<String>,
    /// Its connections, in the order of the document.
    pub connections: Vec<Connection>,
    /// Values for what is in it, a later one before an earlier.
    pub bindings: Vec<Binding>,
    /// Where it stands.
    pub place: String,
}

/// A component: a file and the variables of it that others may see.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Component {
    /// Name within the system.
    pub name: String,
    /// Where its file is.
    pub source: Source,
    /// What its file is.
    pub content: FileKind,
    /// Its file, once it was found; not written.
    pub file: Option<PathBuf>,
    /// One line for people.
    pub description: Option<String>,
    /// Variables by their names in the file.
    pub connectors: Vec<Connector>,
    /// Values for its variables, a later one before an earlier.
    pub bindings: Vec<Binding>,
    /// Lower left and upper right corner in a drawing: x1, y1, x2, y2.
    pub geometry: Option<[f64; 4]>,
    /// Where it stands in the document.
    pub place: String,
}

/// What the file of a component is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FileKind {
    /// An FMU.
    #[default]
    Fmu,
    /// Another document of a structure.
    Definition,
    /// Another archive of a structure.
    Package,
}

/// A place where signals of a dictionary can be connected: all references to a signal are one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SignalReference {
    /// Name within the system.
    pub name: String,
    /// Name of the dictionary, which stands in this system or in one around it.
    pub dictionary: String,
    /// The signals.
    pub connectors: Vec<Connector>,
    /// Where it stands in the document.
    pub place: String,
}

/// A variable that can be connected.
#[derive(Clone, Debug, PartialEq)]
pub struct Connector {
    /// Its name, the variable's.
    pub name: String,
    /// Whether values come in or go out.
    pub kind: Kind,
    /// Type; absent where the document leaves it to the component's file.
    pub kind_of_value: Option<Type>,
    /// Where it stands in the document.
    pub place: String,
}

/// Direction of a connector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Comes from another connector.
    Input,
    /// Goes to others.
    Output,
    /// Set before a run.
    Parameter,
    /// Follows from parameters.
    CalculatedParameter,
    /// Either an input or an output.
    InOut,
    /// Sets sizes (SSP 2.0).
    StructuralParameter,
    /// Never changes (SSP 2.0).
    Constant,
    /// An inner variable (SSP 2.0).
    Local,
    /// Not said (SSP 2.0).
    Unspecified,
}

impl Kind {
    /// All of them by their names in a document.
    pub const NAMES: [(&'static str, Self); 9] = [
        ("input", Self::Input),
        ("output", Self::Output),
        ("parameter", Self::Parameter),
        ("calculatedParameter", Self::CalculatedParameter),
        ("inout", Self::InOut),
        ("structuralParameter", Self::StructuralParameter),
        ("constant", Self::Constant),
        ("local", Self::Local),
        ("unspecified", Self::Unspecified),
    ];

    /// Its name in a document.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }

    /// Whether values come in, seen from outside; `None`: either.
    pub fn takes(self) -> Option<bool> {
        match self {
            Self::Input | Self::Parameter | Self::StructuralParameter => Some(true),
            Self::Output | Self::CalculatedParameter | Self::Constant | Self::Local => Some(false),
            Self::InOut | Self::Unspecified => None,
        }
    }
}

/// Type of a connector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Type {
    /// A number, in a unit if one is named.
    Real(Option<String>),
    /// Any other, by its name in a document.
    Other(String),
}

/// A connection of two connectors. Which of them gives the value follows from what they are, not from which is written
/// first.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// Component and connector it starts from; no component: the system's own connector.
    pub start: (Option<String>, String),
    /// Component and connector it ends in.
    pub end: (Option<String>, String),
    /// What happens to the value on its way, after a change of units.
    pub transformation: Option<Transformation>,
    /// Units are left alone even where both are known.
    pub suppress_unit_conversion: bool,
    /// Where it stands in the document.
    pub place: String,
}

/// The default experiment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Experiment {
    /// Start, s.
    pub start: Option<f64>,
    /// End, s.
    pub stop: Option<f64>,
    /// Settings of the tools that know them; when read, also those of the system and of the document.
    pub annotations: Vec<Annotation>,
}

/// An annotation: one element with attributes, and elements below it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Annotation {
    /// Reversed domain name of whom it belongs to.
    pub kind: String,
    /// Prefix of its elements' namespace.
    pub prefix: String,
    /// Their namespace; not read.
    pub namespace: String,
    /// Names of the elements, one in the other.
    pub elements: Vec<String>,
    /// Attributes of the innermost.
    pub attributes: Vec<(String, String)>,
    /// Where it stands in the document.
    pub place: String,
}
